// @vitest-environment happy-dom
import { beforeEach, describe, expect, it } from 'vitest';
import type { Answer, AskOf, PlayMoves, Price, Segment, Vocabulary } from '../api/types';
import { PlayDrafts } from './drafts';
import { Play } from './play.svelte';

const ask = {
  kind: 'hier_demo',
  state: 0,
  context: [],
  flat: false,
  max_segments: 3,
  max_actions: 20,
} as unknown as AskOf<'hier_demo'>;
const vocabulary: Vocabulary = {
  domain: 'corridor',
  renderer: 'corridor',
  subgoals: ['door', 'target'],
  actions: ['left', 'right'],
};
const price: Price = { fixed: 0, per_action: 1, per_segment: 2 };
const GOAL = 3;

const boxAt = (state: number) => ({ left: state / 4, top: 0, right: (state + 1) / 4, bottom: 1 });

/** A demonstration, and a learner's environment that is a line of cells and replies when told to. */
class Scenario {
  told: PlayMoves[] = [];
  sent: Answer[] = [];
  readonly play: Play;

  constructor(more: Partial<AskOf<'hier_demo'>> = {}, still = true) {
    this.play = new Play(
      {
        draft: 'run/1',
        drafts: new PlayDrafts(sessionStorage),
        ask: { ...ask, ...more },
        vocabulary,
        price,
        withReplay: false,
        still,
      },
      {
        tell: (moves) => this.told.push(moves),
        submit: (answer) => this.sent.push(answer),
        skip: () => undefined,
        undo: () => undefined,
      },
    );
  }

  press(...commands: Parameters<Play['run']>[0][]): void {
    for (const command of commands) this.play.run(command);
  }

  /** The environment carries out the message it was told first. */
  reply(): void {
    const moves = this.told.shift();
    if (moves === undefined) throw new Error('nothing was asked');
    const states = [0];
    for (const action of moves.segments.flatMap((segment) => segment.actions)) {
      const at = states.at(-1) ?? 0;
      if (at < GOAL) states.push(at + (action === 'right' ? 1 : -1));
    }
    const succeeded = states.at(-1) === GOAL;
    const { number, known } = moves;
    this.play.states({
      type: 'states',
      number,
      known,
      states: states.slice(known),
      frames: states.slice(known).map((state) => `picture of ${state}`),
      landmarks: [{ door: { left: 0, top: 0, right: 0.25, bottom: 1 } }],
      action_landmarks: states.slice(known).map((state) => ({ right: boxAt(state + 1) })),
      ended: succeeded,
      succeeded,
    });
  }

  /** A learner that is there and replies at once. */
  here(): this {
    this.play.present(true);
    while (this.told.length > 0) this.reply();
    return this;
  }

  walk(...commands: Parameters<Play['run']>[0][]): void {
    for (const command of commands) {
      this.press(command);
      while (this.told.length > 0) this.reply();
    }
  }
}

const SUCCESS = ['choose:0', 'act:1', 'reached', 'choose:1', 'act:1', 'act:1'] as const;

beforeEach(() => sessionStorage.clear());

describe('playing', () => {
  it('sends the demonstration with one key once the task is accomplished', () => {
    const scenario = new Scenario().here();
    scenario.walk(...SUCCESS);
    expect(scenario.play.cost).toBe(3 + 2 * 2);
    scenario.press('reached');
    expect(scenario.sent).toEqual([
      {
        kind: 'hier_demo',
        segments: [
          { subgoal: 'door', actions: ['right'] },
          { subgoal: 'target', actions: ['right', 'right'] },
        ],
        replay: null,
      },
    ]);
  });

  it('has a picture of every state, the first one too, where the learner sends them', () => {
    const scenario = new Scenario().here();
    scenario.walk('choose:0', 'act:1', 'act:1', 'clear');
    expect(scenario.play.scene.tape.pictures).toEqual(['picture of 0', 'picture of 1']);
  });

  it('has the landmarks of every state, and keeps them with the states', () => {
    const scenario = new Scenario().here();
    scenario.walk('choose:0', 'act:1', 'act:1', 'clear');
    const door = { left: 0, top: 0, right: 0.25, bottom: 1 };
    expect(scenario.play.scene.tape.landmarks).toEqual([
      { subgoals: { door }, actions: { right: boxAt(1) } },
      { subgoals: { door }, actions: { right: boxAt(2) } },
    ]);
  });

  it('carries out an action that is pointed at, once there is a subgoal to move toward', () => {
    const scenario = new Scenario().here();
    expect(scenario.play.pointing.act).toBeNull();
    scenario.walk('choose:0');
    scenario.play.pointing.act?.('right');
    scenario.reply();
    expect(scenario.play.demonstration.states).toEqual([0, 1]);
    scenario.walk('reached');
    expect(scenario.play.pointing.act).toBeNull();
  });

  it('takes a subgoal that is pointed at, until the first step', () => {
    const scenario = new Scenario().here();
    scenario.play.pointing.choose?.('target');
    expect(scenario.play.scene.labels).toEqual([{ frame: 0, name: 'target' }]);
    scenario.play.pointing.choose?.('door');
    expect(scenario.play.current?.subgoal).toBe('door');
    scenario.walk('act:1');
    expect(scenario.play.pointing.choose).toBeNull();
    expect(scenario.play.scene.labels).toEqual([]);
    scenario.walk('reached');
    expect(scenario.play.pointing.choose).not.toBeNull();
    expect(new Scenario({ flat: true }).here().play.pointing.choose).toBeNull();
  });

  it('asks before a demonstration is sent that does not succeed', () => {
    const scenario = new Scenario().here();
    scenario.walk('choose:0', 'act:1', 'send');
    expect([scenario.sent, scenario.play.doubtful]).toEqual([[], true]);
    scenario.play.sendAnyway();
    expect(scenario.sent).toHaveLength(1);
  });

  it('sends nothing while there is nothing, or while steps are not carried out', () => {
    const scenario = new Scenario().here();
    scenario.press('send');
    expect(scenario.play.hint).not.toBe('');
    scenario.press('choose:0', 'act:1', 'send');
    expect(scenario.play.hint).toContain('not carried out');
    expect([scenario.sent, scenario.play.doubtful]).toEqual([[], false]);
  });

  it('says why a key does nothing', () => {
    const scenario = new Scenario().here();
    scenario.press('act:1');
    expect(scenario.play.hint).toBe('Choose a subgoal first.');
    scenario.press('choose:0');
    expect(scenario.play.hint).toBe('');
  });

  it('has a flat demonstration sent with the key that says it is done', () => {
    const scenario = new Scenario({ flat: true }).here();
    scenario.walk('act:1', 'act:1', 'act:1', 'send');
    expect(scenario.sent).toEqual([
      {
        kind: 'hier_demo',
        segments: [{ subgoal: null, actions: ['right', 'right', 'right'] }],
        replay: null,
      },
    ]);
  });
});

describe('playing on from where the learner failed', () => {
  const walked = (subgoal: string, states: number[], actions: string[]): Segment => ({
    subgoal,
    states,
    actions,
    frames: [],
    landmarks: [],
    action_landmarks: [],
  });
  const context = [
    walked('door', [2, 1], ['left']),
    walked('target', [1, 0, 1, 0], ['left', 'right', 'left']),
  ];
  const on = { context, max_segments: 1, max_actions: 5 };

  it('first shows how it failed, and begins at the first move', () => {
    const { play } = new Scenario(on, false).here();
    expect([play.player.at, play.player.playing, play.looksBack]).toEqual([1, true, true]);
    expect(play.pointing.choose).toBeNull();
    play.tick(2);
    expect([play.scene.at, play.scene.current]).toEqual([3, 1]);
    play.run('choose:0');
    expect([play.player.at, play.player.playing, play.looksBack]).toEqual([4, false, false]);
    expect(play.scene.labels).toEqual([{ frame: 4, name: 'door' }]);
  });

  it('plays nothing by itself where motion is reduced', () => {
    const { play } = new Scenario(on).here();
    expect([play.player.at, play.player.playing]).toEqual([4, false]);
  });

  it('lets one look back at any time, and steps go on where the demonstration is', () => {
    const scenario = new Scenario(on).here();
    scenario.walk('choose:1', 'act:1', 'previous-stop', 'back');
    expect([scenario.play.scene.at, scenario.play.looksBack]).toEqual([3, true]);
    expect(scenario.play.demonstration.states).toEqual([0, 1]);
    scenario.walk('act:1');
    expect([scenario.play.scene.at, scenario.play.looksBack]).toEqual([6, false]);
    scenario.play.pointing.show?.(0);
    expect(scenario.play.scene).toMatchObject({ at: 0, current: 0, labels: [] });
  });

  it('takes back moves, but nothing that the learner did', () => {
    const scenario = new Scenario(on).here();
    scenario.walk('choose:0', 'act:1', 'clear', 'clear', 'clear');
    expect(scenario.play.hint).toBe('No step is played yet.');
    expect([scenario.play.tape.frames, scenario.play.scene.at]).toEqual([[2, 1, 0, 1, 0], 4]);
    scenario.walk('choose:0', 'act:1', 'start-over');
    expect([scenario.play.tape.frames, scenario.play.scene.at]).toEqual([[2, 1, 0, 1, 0], 4]);
  });

  it('goes back to the failed state where steps alone are played and taken back', () => {
    const scenario = new Scenario({ ...on, flat: true }).here();
    scenario.walk('act:1', 'clear');
    expect([scenario.play.scene.at, scenario.play.looksBack]).toEqual([4, false]);
  });

  it('sends one segment without a question, although the task is not accomplished', () => {
    const scenario = new Scenario(on).here();
    scenario.walk('choose:0', 'act:1', 'reached');
    expect([scenario.play.complete, scenario.play.pointing.choose]).toEqual([true, null]);
    scenario.press('act:1');
    expect(scenario.play.hint).not.toBe('');
    scenario.press('reached');
    expect(scenario.play.doubtful).toBe(false);
    expect(scenario.sent).toEqual([
      { kind: 'hier_demo', segments: [{ subgoal: 'door', actions: ['right'] }], replay: null },
    ]);
  });

  it('asks before a segment is sent that did not reach its subgoal', () => {
    const scenario = new Scenario(on).here();
    scenario.walk('choose:0', 'act:1', 'send');
    expect([scenario.sent, scenario.play.doubtful]).toEqual([[], true]);
  });
});

describe('the learner’s environment', () => {
  it('is told one thing at a time, and always the newest', () => {
    const scenario = new Scenario().here();
    scenario.press('choose:0', 'act:1', 'act:1', 'act:0');
    expect(scenario.told.map((moves) => moves.segments[0]?.actions)).toEqual([['right']]);
    scenario.reply();
    expect(scenario.told.map((moves) => [moves.segments[0]?.actions, moves.known])).toEqual([
      [['right', 'right', 'left'], 2],
    ]);
    scenario.reply();
    expect(scenario.play.demonstration.states).toEqual([0, 1, 2, 1]);
  });

  it('brings the first picture even if a move is undone before any reply', () => {
    const scenario = new Scenario();
    scenario.play.present(true);
    scenario.press('choose:0', 'act:1', 'clear');
    while (scenario.told.length > 0) scenario.reply();
    scenario.walk('act:1');
    expect(scenario.play.demonstration.pictures).toEqual(['picture of 0', 'picture of 1']);
  });

  it('is ignored if it replies to moves that were undone meanwhile', () => {
    const scenario = new Scenario().here();
    scenario.press('choose:0', 'act:1', 'clear', 'act:0');
    scenario.reply();
    expect(scenario.play.demonstration.states).toEqual([0]);
    scenario.reply();
    expect(scenario.play.demonstration.states).toEqual([0, -1]);
  });

  it('may be away: no steps are made, the moves are kept, and playing continues when it is back', () => {
    const scenario = new Scenario().here();
    scenario.walk('choose:0', 'act:1');
    scenario.press('act:1');
    scenario.play.present(false);
    scenario.press('act:1');
    expect(scenario.play.hint).toContain('not connected');
    expect(scenario.play.steps).toBe(2);
    scenario.told = []; // the environment that received it is gone
    scenario.here();
    expect(scenario.play.demonstration.states).toEqual([0, 1, 2]);
  });

  it('has everything again after a reload, a lost connection and a lease that ran out', () => {
    new Scenario().here().walk('choose:0', 'act:1', 'act:1', 'clear');
    const reloaded = new Scenario();
    expect(reloaded.play.steps).toBe(1);
    reloaded.here();
    expect(reloaded.play.demonstration.states).toEqual([0, 1]);
    reloaded.play.lost();
    reloaded.here();
    reloaded.walk('act:1', 'act:1', 'reached');
    expect(reloaded.sent).toHaveLength(1);
  });
});

describe('a draft', () => {
  it('is of one query, and dropped where it does not fit the run', () => {
    const drafts = new PlayDrafts(sessionStorage);
    drafts.keep('run/1', [{ does: 'choose', subgoal: 'door' }]);
    expect(drafts.of('run/2', vocabulary)).toEqual([]);
    expect(drafts.of('run/1', vocabulary)).toHaveLength(1);
    expect(drafts.of('run/1', { ...vocabulary, subgoals: ['other'] })).toEqual([]);
  });

  it('is nothing where the storage holds nonsense', () => {
    for (const nonsense of [
      '{',
      '7',
      '[7]',
      '[["run/1",7]]',
      '[["run/1",[7]]]',
      '[["run/1",[{"does":"fly"}]]]',
    ]) {
      sessionStorage.setItem('waypost:demonstrations', nonsense);
      expect(new PlayDrafts(sessionStorage).of('run/1', vocabulary)).toEqual([]);
    }
  });

  it('is kept of the six newest', () => {
    const drafts = new PlayDrafts(sessionStorage);
    for (let query = 0; query < 8; query++) drafts.keep(`run/${query}`, [{ does: 'reach' }]);
    const kept = [...Array(8).keys()].filter((query) => drafts.of(`run/${query}`, vocabulary).length > 0);
    expect(kept).toEqual([2, 3, 4, 5, 6, 7]);
  });
});
