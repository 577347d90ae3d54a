/** Pictures of states by their hash: loaded ahead of the player, and kept while their query is on the screen. */

export function addressOf(hash: string): string {
  return `/api/v1/frames/${hash}`;
}

const AHEAD = 24; // frames: more than two seconds of playing
const KEPT = 400;
const loaded = new Map<string, HTMLImageElement>();

/** Have the browser fetch and decode what is shown next. What is there already costs nothing. */
export function preload(hashes: readonly (string | null)[], at: number): void {
  for (const hash of hashes.slice(at, at + AHEAD)) {
    if (hash !== null) load(hash);
  }
}

function load(hash: string): void {
  const known = loaded.get(hash);
  if (known !== undefined) {
    loaded.delete(hash);
    loaded.set(hash, known); // the one used last goes last
    return;
  }
  const image = new Image();
  image.src = addressOf(hash);
  image.decode().catch(() => loaded.delete(hash)); // tried again when it is needed
  loaded.set(hash, image);
  const [oldest] = loaded.keys();
  if (loaded.size > KEPT && oldest !== undefined) loaded.delete(oldest);
}
