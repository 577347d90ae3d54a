/** What is shown once. */
export interface Secret {
  readonly title: string;
  readonly what: string;
  readonly text: string;
}

export function loginSecret(name: string, code: string, hours: number): Secret {
  const time =
    hours < 1 ? `${Math.round(hours * 60)} minutes` : hours < 48 ? `${hours} hours` : `${hours / 24} days`;
  return {
    title: `Login link for ${name}`,
    what: `Send it to ${name}, and to nobody else: whoever opens it first is signed in as ${name}. It works once, within ${time}.`,
    text: `${location.origin}/login#${code}`,
  };
}

export function tokenSecret(token: string): Secret {
  return {
    title: 'New API token',
    what: 'A program calls with it: “Authorization: Bearer …”, or WAYPOST_TOKEN for the commands. It is good until it is revoked.',
    text: token,
  };
}
