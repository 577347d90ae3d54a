// The clock of the player.
/** Call `tick` with the number of frames that are due, until the returned function is called. */
export function playing(pace: () => number, tick: (frames: number) => void): () => void {
  let shownAt = performance.now();
  let request = requestAnimationFrame(next);
  function next(now: number): void {
    const frames = Math.floor((now - shownAt) / pace());
    if (frames > 0) {
      shownAt += frames * pace();
      tick(frames);
    }
    request = requestAnimationFrame(next);
  }
  return () => cancelAnimationFrame(request);
}
