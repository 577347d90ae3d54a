import { Refused } from '../api/client';

/** Keep a lease while the page is visible. `lost` is called when it cannot be kept. Returns how to stop. */
export function beat(leaseSeconds: number, renew: () => Promise<unknown>, lost: () => void): () => void {
  let stopped = false;

  async function once(): Promise<void> {
    if (document.hidden || stopped) return;
    try {
      await renew();
    } catch (error) {
      if (error instanceof Refused && !stopped) lost();
    }
  }
  function onVisible(): void {
    void once();
  }

  const timer = setInterval(() => void once(), (leaseSeconds * 1000) / 3);
  document.addEventListener('visibilitychange', onVisible);
  return () => {
    stopped = true;
    clearInterval(timer);
    document.removeEventListener('visibilitychange', onVisible);
  };
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
