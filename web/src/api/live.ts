const EVENTS = ['asked', 'answered', 'retracted', 'used', 'cancelled', 'episode', 'run'] as const;
export type RunEvent = (typeof EVENTS)[number];

export interface Live {
  /** Something happened, or, with null, may have while nobody listened. */
  changed(event: RunEvent | null): void;
  connected(isConnected: boolean): void;
}

/** Hear of every change of a run until the returned function is called. A lost connection is taken up again by itself. */
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

/** Hear that something changed in some run, at most once a second, until the returned function is called. */
export function watchAll(changed: () => void): () => void {
  return stream('/api/v1/events', (source) => {
    source.onopen = changed;
    source.addEventListener('changed', changed);
  });
}

const AGAIN_MS = 5_000;

/** Keep a stream open: a browser gives up for good when something between it and the server answers with an error. */
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

/** Call at most once per `milliseconds`: at once, and again afterwards if more came meanwhile. */
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
