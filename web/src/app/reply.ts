// The reply of an OpenID provider: the parameters with which it sends the browser back to the login page. Pure.
import type { components } from '../api/schema';

type Reply = components['schemas']['SignInReply'];

/** Return the reply in the parameters of an address; null if it is none. */
export function replyOf(parameters: URLSearchParams): Reply | null {
  const [state, code] = [parameters.get('state'), parameters.get('code')];
  if (state === null || (code === null && !parameters.has('error'))) return null;
  return { state, code, issuer: parameters.get('iss') };
}
