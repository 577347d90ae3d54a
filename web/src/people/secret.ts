// The texts of a new login link or token.
/** A text that is shown once. */
export interface Secret {
  readonly title: string;
  readonly use: string;
  readonly text: string;
}

export function loginSecret(name: string, code: string, hours: number): Secret {
  const time =
    hours < 1 ? `${Math.round(hours * 60)} minutes` : hours < 48 ? `${hours} hours` : `${hours / 24} days`;
  return {
    title: `Login link for ${name}`,
    use: `Send it only to ${name}: the first person who opens it is signed in as ${name}. It works once, within ${time}.`,
    text: `${location.origin}/login#${code}`,
  };
}

export function tokenSecret(token: string): Secret {
  return {
    title: 'New API token',
    use: 'Programs send it as “Authorization: Bearer …”. The waypost commands read it from WAYPOST_TOKEN. It is valid until you revoke it.',
    text: token,
  };
}
