// A demonstration as a worked example: its moves in order, and what was seen after each. Pure.
import { readable } from '../api/names';
import type { DemoForm, Practice, Vocabulary } from '../api/types';
import type { Command } from '../keys/registry';
import { t } from '../language/language';
import * as demos from '../play/demonstration';
import type { Demonstration, Move } from '../play/demonstration';
import type { Scene } from '../player/scene';
import { landmarksAt, lastFrame } from '../player/tape';

export type Worked = Practice['demonstrations'][number];

/** A row of the example: what the learner did before, the same key or several moves, or sending. */
export interface Row {
  readonly does: 'fail' | 'choose' | 'act' | 'reach' | 'send';
  readonly subgoal: string | null; // null in a flat demonstration, and where it is sent
  readonly actions: readonly string[]; // of `act`
  readonly last: number; // the moment when it is done
}

/** Return how a demonstration is asked for; the keys that play it depend on it. */
export function formOf({ flat, context }: Worked['ask']): DemoForm {
  if (flat) return 'flat_demo';
  return context.length > 0 ? 'play_on' : 'hier_demo';
}

/**
 * Return the rows of an example. A moment is a number of moves: nothing is done in moment 0, and in the moment after all
 * moves the demonstration is sent.
 */
export function rowsOf({ ask, answer }: Worked): Row[] {
  const failed = ask.context.at(-1)?.subgoal ?? null;
  const rows: Row[] = demos.playsOn(ask) ? [{ does: 'fail', subgoal: failed, actions: [], last: 0 }] : [];
  let moment = 0;
  for (const [place, { subgoal, actions }] of answer.segments.entries()) {
    if (subgoal !== null) rows.push({ does: 'choose', subgoal, actions: [], last: ++moment });
    rows.push({ does: 'act', subgoal, actions, last: (moment += actions.length) });
    const endsEpisode = place === answer.segments.length - 1 && !demos.playsOn(ask);
    if (!endsEpisode) rows.push({ does: 'reach', subgoal, actions: [], last: ++moment });
  }
  return [...rows, { does: 'send', subgoal: null, actions: [], last: moment + 1 }];
}

/** Return the index of the row that a moment belongs to. */
export function rowAt(rows: readonly Row[], moment: number): number {
  return rows.findIndex((row) => moment <= row.last);
}

/** Return what was on the screen in a moment. */
export function sceneAt(worked: Worked, vocabulary: Vocabulary, moment: number): Scene {
  const { ask } = worked;
  const demonstration = seenUntil(worked, moment);
  const tape = demos.tapeOf(demonstration, ask);
  const at = lastFrame(tape);
  const parts = demos.partsOf(demonstration);
  const part = parts.at(-1);
  const isChosen = part?.subgoal != null && part.actions.length === 0;
  return {
    instance: ask.instance,
    tape,
    vocabulary,
    at,
    current: part === undefined || part.reached ? null : ask.context.length + parts.length - 1,
    labels: isChosen ? [{ frame: at, name: part.subgoal }] : [],
  };
}

function seenUntil(worked: Worked, moment: number): Demonstration {
  const { ask, answer } = worked;
  const all = rowsOf(worked).flatMap(movesOf);
  const moves = all.slice(0, moment);
  const done = moves.filter((move) => move.does === 'act').length;
  const states = answer.replay?.states.slice(0, done + 1) ?? [];
  const isOver = moment >= all.length && !demos.playsOn(ask);
  return {
    moves,
    states,
    pictures: states.map((_, state) => answer.replay?.frames[state] ?? null),
    landmarks: states.map((_, state) => landmarksAt(answer.replay ?? {}, state)),
    ended: isOver,
    succeeded: isOver,
  };
}

function movesOf({ does, subgoal, actions }: Row): Move[] {
  if (does === 'choose') return [{ does, subgoal: subgoal ?? '' }];
  if (does === 'reach') return [{ does }];
  return actions.map((action) => ({ does: 'act', action }));
}

/** Return the commands of a row's keys, in order, each with how often it comes one after another. */
export function commandsOf(
  { does, subgoal, actions }: Row,
  form: DemoForm,
  vocabulary: Vocabulary,
): [Command, number][] {
  if (does === 'choose') return [[`choose:${vocabulary.subgoals.indexOf(subgoal ?? '')}`, 1]];
  if (does === 'reach') return [['reached', 1]];
  if (does === 'send') return [[form === 'flat_demo' ? 'send' : 'reached', 1]]; // when all is done, this key sends
  const pressed: [Command, number][] = [];
  for (const action of actions) {
    const command: Command = `act:${vocabulary.actions.indexOf(action)}`;
    const last = pressed.at(-1);
    if (last?.[0] === command) last[1] += 1;
    else pressed.push([command, 1]);
  }
  return pressed;
}

/** Return how such a demonstration is given. */
export function howToPlay(form: DemoForm): string {
  if (form === 'flat_demo') return t('Do the task as it should be done, step by step.');
  return form === 'play_on'
    ? t('Choose a subgoal, and move on from where the learner failed, until the subgoal is reached.')
    : t('Choose a subgoal, move until it is reached, and choose the next one, until the task is done.');
}

/** Return why a row's move is made then. */
export function whyNow(rows: readonly Row[], place: number): string {
  const { does, subgoal } = rows[place] ?? { does: 'send', subgoal: null };
  const name = readable(subgoal ?? '');
  const isFirst = rows.findIndex((row) => row.does === does) === place;
  switch (does) {
    case 'fail':
      return t(`The learner tried “${name}” and did not reach it. Your moves begin here.`);
    case 'choose':
      return isFirst
        ? t('First choose the subgoal. The steps that follow lead to it.')
        : t('Choose the next subgoal before you move on.');
    case 'act':
      return subgoal === null
        ? t('Each key is one step.')
        : t(`Move toward “${name}”. Each key is one step.`);
    case 'reach':
      return t(`Say so in the first state where “${name}” is reached: the learner imitates this, too.`);
    case 'send':
      return rows[0]?.does === 'fail'
        ? t('One segment is enough. Send it.')
        : t('The task is accomplished. Send the demonstration.');
  }
}
