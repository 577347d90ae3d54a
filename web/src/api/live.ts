// Server-sent events: the changes of one run, or of any run.
const EVENTS = ['asked', 'answered', 'retracted', 'used', 'cancelled', 'episode', 'run'] as const;
export type RunEvent = (typeof EVENTS)[number];

export interface Live {
  /** Called with each event; with null after a gap in the connection, when events may have been missed. */
  changed(event: RunEvent | null): void;
  connected(isConnected: boolean): void;
}

/** Report every change of a run until the returned function is called. A lost connection is opened again. */
export function watch(run: string, live: Live): () => void {
  return stream(`/api/v1/runs/${encodeURIComponent(run)}/events`, (source) => {
    source.onopen = () => {
      live.connected(true);
      live.changed(null);
    };
    source.addEventListener('error', () => live.connected(false));
    for (const event of EVENTS) source.addEventListener(event, () => live.changed(event));
  });
}

/** Report that some run changed, at most once a second, until the returned function is called. */
export function watchAll(changed: () => void): () => void {
  return stream('/api/v1/events', (source) => {
    source.onopen = changed;
    source.addEventListener('changed', changed);
  });
}

const AGAIN_MS = 5_000;

/** Keep a stream open. A browser stops reconnecting when a proxy answers with an error; then open a new stream. */
function stream(address: string, listen: (source: EventSource) => void): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let source: EventSource;
  function open(): void {
    source = new EventSource(address);
    source.addEventListener('error', () => {
      if (source.readyState === EventSource.CLOSED) timer = setTimeout(open, AGAIN_MS);
    });
    listen(source);
  }
  open();
  return () => {
    clearTimeout(timer);
    source.close();
  };
}

/** Return a function that calls at most once per `milliseconds`. Calls during the wait are combined into one call after it. */
export function throttled(call: () => Promise<unknown>, milliseconds: number): () => void {
  let [busy, again] = [false, false];

  async function fire(): Promise<void> {
    [busy, again] = [true, false];
    await Promise.all([call(), new Promise((resolve) => setTimeout(resolve, milliseconds))]);
    busy = false;
    // eslint-disable-next-line @typescript-eslint/no-unnecessary-condition -- it may be set during the wait
    if (again) void fire();
  }
  return () => {
    if (busy) again = true;
    else void fire();
  };
}
