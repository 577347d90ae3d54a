// What the page says, in its own language, when the server refuses what a person wants.
//
// The server's own English words are left to refusals that no form of the page can cause: they answer programs
// (`idempotency-key-reused`, `out-of-scope`, `not-json`, webhooks, imports, deletion, pictures), or mean that page and
// server disagree about an answer or an address. Those are faults, and whoever mends them needs the exact words. Statuses
// that may pass (408, 429, 5xx) never come here: the page says that the server cannot be reached.
import { locale, t } from '../language/language';
import type { components } from './schema';
import { nameOfRole } from './states';

type Problem = Partial<components['schemas']['Problem']>;

/** Return the words for a refusal, by its stable name and its particulars. Undefined where the page has none. */
export function refusalWords(name: string, problem: Problem = {}): string | undefined {
  if (name === 'forbidden') return forbiddenWords(problem);
  if (name === 'budget-too-low') return budgetWords(problem);
  if (name === 'unprocessable') return fieldWords(problem);
  const words = { ...signInWords(), ...answerWords(), ...changeWords() };
  return Object.hasOwn(words, name) ? words[name] : undefined;
}

type Words = Readonly<Record<string, string>>;

function signInWords(): Words {
  return {
    unauthenticated: t('You are not signed in, or no longer. Open a new login link.'),
    'login-used': t('Each login link works once. Ask for a new one.'),
    'login-expired': t('It was not used in time.'),
    deactivated: t('Ask an administrator of this server.'),
    'sign-in-stale': t('It was not begun in this browser, or it took longer than ten minutes.'),
    'sign-in-failed': t(
      'Try again. If it fails again, tell an administrator, who finds the reason in the audit log.',
    ),
    'no-account': t('Ask an administrator of this server for one.'),
    'no-role': t('Ask an administrator of this server for one.'),
    'cross-site': t('The server takes this page for another site. Tell the person who runs the server.'),
  };
}

function answerWords(): Words {
  return {
    'not-yours': t('Somebody else has this question.'),
    'wrong-token': t('Another tab has this question.'),
    'not-found': t('It does not exist, or it was deleted.'),
    'lease-expired': t('The question went back to the queue before.'),
    'lease-ended': t('The question was answered, skipped or given back before.'),
    'query-cancelled': t('The run has ended, and its open questions with it.'),
    'different-content': t('It has another answer already.'),
    'answer-retracted': t('The answer was taken back or sent back before.'),
    'answer-used': t('The learner has already used this answer, so it stays.'),
    'budget-exhausted': t('The run has too few units left to pay for another answer to this question.'),
    'not-playable': t('It is answered, or nobody asks it any more.'),
    displaced: t('It is open in another tab or browser.'),
    'body-too-large': t('It is too long.'),
  };
}

function changeWords(): Words {
  return {
    'run-finished': t('The run is finished, so this is no longer possible.'),
    'cannot-send-back': t(
      'This answer is to a gold query or a second one. The learner does not get it, so it stays.',
    ),
    'not-answered': t('The query has no answer at present.'),
    'name-taken': t('Somebody has this name already. Choose another one.'),
    'not-active': t('The account is deactivated. Reactivate it first.'),
    'user-erased': t('The personal data of this account were deleted. Add a new account instead.'),
    'last-administrator': t('This is the only administrator. First make somebody else one.'),
  };
}

function forbiddenWords({ roles, owner }: Problem): string {
  if (roles) {
    const names = new Intl.ListFormat(locale, { type: 'disjunction' }).format(roles.map(nameOfRole));
    return t(`This needs the role ${names}.`);
  }
  if (owner) return t(`This run belongs to ${owner}. Only its owner and administrators may change it.`);
  return t('Your role does not allow this.');
}

function budgetWords({ spent, reserved }: Problem): string | undefined {
  if (typeof spent !== 'number' || typeof reserved !== 'number') return undefined;
  const [paid, kept, least] = [spent, reserved, spent + reserved].map((units) =>
    units.toLocaleString(locale),
  );
  return t(
    `${paid} units are spent and ${kept} are reserved for open queries, so the budget must be at least ${least}. Finish the run to release what is reserved.`,
  );
}

/** Return what is wrong with a field of a form, by the name that it has on the page. */
function fieldWords({ errors }: Problem): string | undefined {
  const { loc, type } = errors?.[0] ?? {};
  const fields = fieldNames();
  const place = Array.isArray(loc) ? loc.join('.') : '';
  if (!Object.hasOwn(fields, place)) return undefined;
  const field = fields[place];
  if (type === 'string_too_short') return t(`“${field}” is empty.`);
  if (type === 'string_too_long') return t(`“${field}” is too long.`);
  if (type === 'string_pattern_mismatch') return t(`“${field}” has a character that is not allowed.`);
  return t(`“${field}” cannot have this value.`);
}

function fieldNames(): Words {
  return {
    'body.name': t('Name'),
    'body.priority': t('Priority'),
    'body.budget': t('Budget'),
    'body.gold_rate': t("Share of each annotator's queries, percent"),
    'body.second_answers': t('Queries answered twice, percent'),
    'body.text': t('Comment'),
    'body.label': t('What it is for'),
    'query.text': t('Find a query'),
    'query.episode': t('Episode'),
    'query.annotator': t('Annotator'),
    'query.actor': t('Who'),
  };
}
