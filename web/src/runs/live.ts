const EVENTS = ['asked', 'answered', 'retracted', 'used', 'cancelled', 'episode', 'run'] as const;
export type RunEvent = (typeof EVENTS)[number];

export interface Live {
  /** Something happened, or, with null, may have while nobody listened. */
  changed(event: RunEvent | null): void;
  connected(isConnected: boolean): void;
}

/** Hear of every change of a run until the returned function is called. A lost connection is taken up again by itself. */
export function watch(run: string, live: Live): () => void {
  const source = new EventSource(`/api/v1/runs/${encodeURIComponent(run)}/events`);
  source.onopen = () => {
    live.connected(true);
    live.changed(null);
  };
  source.onerror = () => live.connected(false);
  for (const event of EVENTS) source.addEventListener(event, () => live.changed(event));
  return () => source.close();
}

/** Hear that something changed in some run, at most once a second, until the returned function is called. */
export function watchAll(changed: () => void): () => void {
  const source = new EventSource('/api/v1/events');
  source.onopen = changed;
  source.addEventListener('changed', changed);
  return () => source.close();
}

/** Call at most once per `milliseconds`: at once, and again afterwards if more came meanwhile. */
export function throttled(call: () => Promise<void>, milliseconds: number): () => void {
  let [busy, again] = [false, false];

  async function fire(): Promise<void> {
    [busy, again] = [true, false];
    await Promise.all([call(), new Promise((resolve) => setTimeout(resolve, milliseconds))]);
    busy = false;
    if (again) void fire();
  }
  return () => {
    if (busy) again = true;
    else void fire();
  };
}
