// Heartbeats: a lease is renewed while the tab is visible.
import { Refused } from '../api/client';

export interface Heartbeat {
  stop(): void;
  now(): void; // renew at once, to find out whether the lease still holds
}
export const NO_HEARTBEAT: Heartbeat = { stop: () => undefined, now: () => undefined };

/** Renew a lease every third of its length while the tab is visible. When the server refuses, call `lost` once. */
export function beat(leaseSeconds: number, renew: () => Promise<unknown>, lost: () => void): Heartbeat {
  let stopped = false;

  async function once(): Promise<void> {
    if (document.hidden || stopped) return;
    try {
      await renew();
    } catch (error) {
      // eslint-disable-next-line @typescript-eslint/no-unnecessary-condition -- it may be set during the request
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
