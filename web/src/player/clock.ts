/** Call `tick` with the frames that are due, as they come due, until the returned function is called. */
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
