// The colors of subgoals: which of the eight in tokens.css a subgoal has.

/** How many colors there are; a ninth subgoal has the color of the first. */
export const SUBGOAL_COLORS = 8;

/** Return the number of a subgoal's color: its place in the vocabulary, modulo eight; 0 if it has none. */
export function subgoalColor(subgoal: string | null, subgoals: readonly string[]): number {
  return subgoal === null ? 0 : Math.max(0, subgoals.indexOf(subgoal)) % SUBGOAL_COLORS;
}
