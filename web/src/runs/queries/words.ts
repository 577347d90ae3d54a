// Answers, leases and ledger entries in words.
import { reasonsToSkip } from '../../api/states';
import type { Answer, LedgerEntry, PastAssignment } from '../../api/types';
import { t } from '../../language/language';
import { count } from '../../ui/format';

/** Return an answer in a few words. */
export function wordsOfAnswer(answer: Answer | null): string {
  if (answer === null) return '';
  switch (answer.kind) {
    case 'inspect_full':
    case 'inspect_lo':
      return answer.verdict === 'pass' ? t('✓ pass') : t('✗ fail');
    case 'label_hi':
      return count(answer.subgoals.length, ['# subgoal', '# subgoals']);
    case 'label_lo':
    case 'label_full':
      return count(answer.actions.filter((action) => action !== null).length, ['# action', '# actions']);
    case 'hier_demo':
      return count(answer.segments.length, ['# segment', '# segments']);
  }
}

/** Return in words how a lease ended. */
export function wordsOfEnding(assignment: PastAssignment): string {
  const { answer, reason, state } = assignment;
  if (answer !== null) {
    const said = wordsOfAnswer(answer.content);
    if (answer.fate === 'late') return t(`answered after the lease expired (${said}), not charged`);
    return answer.fate === 'retracted' ? t(`answered (${said}), then taken back`) : t(`answered: ${said}`);
  }
  switch (state) {
    case 'live':
      return t('leased now');
    case 'skipped':
      return reason ? t(`skipped: ${reasonsToSkip().get(reason) ?? reason}`) : t('skipped');
    case 'released':
      return reason ? t(`released: ${reason}`) : t('released');
    case 'expired':
      return t('lease expired');
    default:
      return state;
  }
}

/** Return a number as text, with a true minus sign. */
export function signed(value: number, format: (value: number) => string): string {
  return value < 0 ? `−${format(-value)}` : format(value);
}

export function nameOfEntry(entry: LedgerEntry['entry']): string {
  return entry === 'charge' ? t('charge') : t('↩ refund');
}
