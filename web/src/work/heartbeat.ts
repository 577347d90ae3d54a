import { Refused } from '../api/client';

const SIGNS = ['keydown', 'pointerdown', 'pointermove', 'wheel'] as const;

/** Whether the annotator has done anything since it was last asked. The server's clock does the counting. */
class Activity {
  #active = false;

  constructor() {
    for (const sign of SIGNS) {
      window.addEventListener(sign, () => (this.#active = true), { capture: true, passive: true });
    }
  }

  take(): boolean {
    const active = this.#active;
    this.#active = false;
    return active;
  }
}

export const activity = new Activity();

/** A lease that is kept up. */
export interface Heartbeat {
  stop(): void;
  now(): void; // see at once whether the lease is still ours
}
export const NO_HEARTBEAT: Heartbeat = { stop: () => undefined, now: () => undefined };

/** Keep a lease while the page is visible. `lost` is called, once, when it cannot be kept. */
export function beat(leaseSeconds: number, renew: () => Promise<unknown>, lost: () => void): Heartbeat {
  let stopped = false;

  async function once(): Promise<void> {
    if (document.hidden || stopped) return;
    try {
      await renew();
    } catch (error) {
      if (!(error instanceof Refused) || stopped) return;
      stop();
      lost();
    }
  }
  function stop(): void {
    stopped = true;
    clearInterval(timer);
    document.removeEventListener('visibilitychange', onVisible);
  }
  function onVisible(): void {
    void once();
  }

  const timer = setInterval(() => void once(), (leaseSeconds * 1000) / 3);
  document.addEventListener('visibilitychange', onVisible);
  return { stop, now: onVisible };
}

/** Resolves when the page can be seen, or when the signal is aborted. */
export function visible(signal: AbortSignal): Promise<void> {
  if (!document.hidden) return Promise.resolve();
  return new Promise((resolve) => {
    const done = (): void => {
      document.removeEventListener('visibilitychange', done);
      resolve();
    };
    document.addEventListener('visibilitychange', done);
    signal.addEventListener('abort', done, { once: true });
  });
}

/** Resolves after a while, earlier when the network is back or the signal is aborted. */
export function pause(milliseconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const done = (): void => {
      clearTimeout(timer);
      window.removeEventListener('online', done);
      resolve();
    };
    const timer = setTimeout(done, milliseconds);
    window.addEventListener('online', done);
    signal.addEventListener('abort', done, { once: true });
  });
}
