// The tags of subgoals, which stand for them on pictures, in lists and on strips: the keys that choose them.
import { keyOfSubgoal } from './registry';

/** Return the tag of a subgoal: the key that chooses it; without a key, its number. No two subgoals have the same. */
export function tagOf(subgoal: string, subgoals: readonly string[]): string {
  const index = subgoals.indexOf(subgoal);
  return keyOfSubgoal(index, subgoals)?.toUpperCase() ?? String(index + 1);
}

/** Return the tag of a segment: its number, and the tag of its subgoal. A dot separates two digits. */
export function numbered(number: number, tag: string): string {
  return `${number}${/^\d/.test(tag) ? '·' : ''}${tag}`;
}
