// The texts of a new login link or token.
import { t } from '../language/language';
import { count } from '../ui/format';

/** A text that is shown once. */
export interface Secret {
  readonly title: string;
  readonly use: string;
  readonly text: string;
}

export function loginSecret(name: string, code: string, hours: number): Secret {
  const time = timeOf(hours);
  return {
    title: t(`Login link for ${name}`),
    use: t(
      `Send it only to ${name}: the first person who opens it is signed in as ${name}. It works once, within ${time}.`,
    ),
    text: `${location.origin}/login#${code}`,
  };
}

export function tokenSecret(token: string): Secret {
  return {
    title: t('New API token'),
    use: t(
      'Programs send it as “Authorization: Bearer …”. The waypost commands read it from WAYPOST_TOKEN. It is valid until you revoke it.',
    ),
    text: token,
  };
}

/** Return the time within which a login link works. */
export function timeOf(hours: number): string {
  if (hours < 1) return count(Math.round(hours * 60), ['# minute', '# minutes']);
  return hours < 48 ? count(hours, ['# hour', '# hours']) : count(hours / 24, ['# day', '# days']);
}
