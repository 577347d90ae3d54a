// A maze in words, for people who do not see the canvas.
import type { Tape } from '../../player/tape';
import { count } from '../../ui/format';
import { describeCell, parseCell, type Maze } from './geometry';

/** Return the picture in words: where the segments begin and end that the query asks about, and where the agent is now. */
export function describeMaze(maze: Maze, tape: Tape, at: number): string {
  const place = (frame: number): string => {
    const cell = parseCell(tape.frames[frame]);
    return cell === null ? 'nowhere' : describeCell(maze, cell);
  };
  const asked = tape.stretches.filter((stretch) => stretch.asked);
  const [first, last] = [asked[0], asked.at(-1)];
  if (first === undefined || last === undefined) return `A maze of rooms. The agent is ${place(at)}.`;
  const named = asked.length === 1 && first.subgoal !== null ? ` for subgoal ${first.subgoal}` : '';
  const way = `It begins ${place(first.first)} and ends ${place(last.last)}`;
  return `A maze of rooms. The trajectory${named}: ${count(asked.length, 'segment')}. ${way}. Now the agent is ${place(at)}.`;
}
