// The client of the server's REST API, and the two ways in which a request fails.
import createClient from 'openapi-fetch';
import { t } from '../language/language';
import { refusalWords } from './refusals';
import type { components, paths } from './schema';

type Problem = components['schemas']['Problem'];

/** The server refused the request. `name` is the stable name of the problem, such as `lease-expired`. */
export class Refused extends Error {
  readonly status: number;
  override readonly name: string;

  constructor(status: number, problem: Partial<Problem> | undefined) {
    const name = problem?.type?.split('/').at(-1) ?? 'refused';
    super(refusalWords(name, problem) ?? problem?.detail ?? t(`The server answered with status ${status}.`));
    this.status = status;
    this.name = name;
  }
}

/** The server could not be reached, or failed in a way that may not last. */
export class Unreachable extends Error {}

export const api = createClient<paths>({ baseUrl: '/' });

interface Reply<T> {
  data?: T;
  error?: unknown;
  response: Response;
}

/** Return the body of a successful reply; throw `Refused` or `Unreachable` otherwise. */
export async function unwrap<T>(call: Promise<Reply<T>>): Promise<T> {
  const reply = await reached(call);
  if (reply.response.ok) return reply.data as T;
  const { status } = reply.response;
  const problem = typeof reply.error === 'object' ? (reply.error as Partial<Problem>) : undefined;
  if (isPassing(status)) throw new Unreachable(problem?.detail ?? `Status ${status}`);
  throw new Refused(status, problem);
}

async function reached<T>(call: Promise<Reply<T>>): Promise<Reply<T>> {
  try {
    return await call;
  } catch (error) {
    if (error instanceof DOMException && error.name === 'AbortError') throw error;
    throw new Unreachable(error instanceof Error ? error.message : String(error));
  }
}

/** Return whether the same request may succeed later: after a timeout, a rate limit or a server error. */
function isPassing(status: number): boolean {
  return status === 408 || status === 429 || status >= 500;
}

export function isAborted(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'AbortError';
}

/** For views that reload their data automatically. */
export function tryingAgain(): string {
  return t('The server cannot be reached. The web app tries again automatically.');
}

/** Return what to tell the person about an error. `refusals.ts` says which refusals are in English. */
export function wordsOf(error: unknown, unreachable?: string): string {
  if (error instanceof Unreachable) return unreachable ?? t('The server cannot be reached.');
  return error instanceof Error ? error.message : String(error);
}
