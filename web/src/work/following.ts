// What whoever waits is told about the learners follows the events of the server.
import { throttled, watch, watchAll } from '../api/live';

const AT_ONCE_MS = 1_000;
const SOMETIMES_MS = 5_000; // answers may come many times a second, and say little to whoever waits

/**
 * Call `refresh` when the run has changed, or any run if none is chosen, until the returned function is called.
 * A pause, a resumption and the end of the chosen run are told at once.
 */
export function follow(run: string | null, refresh: () => Promise<unknown>): () => void {
  const atOnce = throttled(refresh, AT_ONCE_MS);
  const sometimes = throttled(refresh, SOMETIMES_MS);
  if (run === null) return watchAll(sometimes);
  return watch(run, {
    changed: (event) => (event === null || event === 'run' ? atOnce() : sometimes()),
    connected: () => undefined,
  });
}
