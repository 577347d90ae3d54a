// A maze in words, for people who do not see the canvas.
import { t } from '../../language/language';
import type { Tape } from '../../player/tape';
import { count } from '../../ui/format';
import { describeCell, parseCell, type Maze } from './geometry';

/** Return the picture in words: where the segments begin and end that the query asks about, and where the agent is now. */
export function describeMaze(maze: Maze, tape: Tape, at: number): string {
  const place = (frame: number): string => {
    const cell = parseCell(tape.frames[frame]);
    return cell === null ? t('nowhere') : describeCell(maze, cell);
  };
  const asked = tape.stretches.filter((stretch) => stretch.asked);
  const [first, last] = [asked[0], asked.at(-1)];
  if (first === undefined || last === undefined) return t(`A maze of rooms. The agent is ${place(at)}.`);
  const segments = count(asked.length, ['# segment', '# segments']);
  const [begin, end, now] = [place(first.first), place(last.last), place(at)];
  return asked.length === 1 && first.subgoal !== null
    ? t(
        `A maze of rooms. The trajectory for subgoal ${first.subgoal}: ${segments}. It begins ${begin} and ends ${end}. Now the agent is ${now}.`,
      )
    : t(
        `A maze of rooms. The trajectory: ${segments}. It begins ${begin} and ends ${end}. Now the agent is ${now}.`,
      );
}
