// The player: its position, speed and moves on a tape. Pure: a function that changes the player returns a new one.
/** The state of the player. */
export interface Player {
  readonly at: number; // frame
  readonly first: number; // where playing starts again
  readonly last: number;
  readonly playing: boolean;
  readonly speed: number; // index into SPEEDS
}

export const SPEEDS = [0.5, 1, 2, 4] as const;
const FRAMES_PER_SECOND = 10;
/** The first showing takes at most this long. */
const FIRST_SHOWING_SECONDS = 1.6;

export function player(first: number, last: number, speed = 1): Player {
  return { at: first, first, last, playing: false, speed };
}

export function seek(p: Player, frame: number): Player {
  return { ...p, at: clamp(frame, 0, p.last), playing: false };
}

export function step(p: Player, by: number): Player {
  return seek(p, p.at + by);
}

export function toggle(p: Player): Player {
  if (p.playing) return { ...p, playing: false };
  return { ...p, playing: p.last > p.first, at: p.at >= p.last ? p.first : p.at };
}

export function advance(p: Player, frames: number): Player {
  const at = Math.min(p.last, p.at + frames);
  return { ...p, at, playing: p.playing && at < p.last };
}

export function changeSpeed(p: Player, by: number): Player {
  return { ...p, speed: clamp(p.speed + by, 0, SPEEDS.length - 1) };
}

/** Go to the next (`by` = 1) or previous (`by` = -1) of the sorted `stops`. */
export function jump(p: Player, stops: readonly number[], by: 1 | -1): Player {
  const target =
    by === 1 ? stops.find((stop) => stop > p.at) : stops.toReversed().find((stop) => stop < p.at);
  return seek(p, target ?? (by === 1 ? p.last : 0));
}

export function speedOf(p: Player): number {
  return SPEEDS[p.speed] ?? 1;
}

export function framesPerSecond(p: Player, firstShowing: boolean): number {
  const usual = FRAMES_PER_SECOND * speedOf(p);
  return firstShowing ? Math.max(usual, (p.last - p.first) / FIRST_SHOWING_SECONDS) : usual;
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
