// Pictures of states, by their hash. They are loaded before the player needs them.

export function addressOf(hash: string): string {
  return `/api/v1/frames/${hash}`;
}

const AHEAD = 24; // frames: more than two seconds of playing
const KEPT = 400;
const loaded = new Map<string, HTMLImageElement>();

/** Load the pictures of the next frames, unless they are loaded already. */
export function preload(hashes: readonly (string | null)[], at: number): void {
  for (const hash of hashes.slice(at, at + AHEAD)) {
    if (hash !== null) load(hash);
  }
}

function load(hash: string): void {
  const known = loaded.get(hash);
  if (known !== undefined) {
    loaded.delete(hash);
    loaded.set(hash, known); // the most recently used is last
    return;
  }
  const image = new Image();
  image.src = addressOf(hash);
  image.decode().catch(() => loaded.delete(hash)); // the next use loads it again
  loaded.set(hash, image);
  const [oldest] = loaded.keys();
  if (loaded.size > KEPT && oldest !== undefined) loaded.delete(oldest);
}
