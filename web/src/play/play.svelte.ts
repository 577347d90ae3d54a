// The state of one demonstration on the screen, and what every key does.
import { readable } from '../api/names';
import type { AnswerOf, AskOf, PlayMoves, PlayStates, Price, Vocabulary } from '../api/types';
import { bindingsFor, type Command } from '../keys/registry';
import { t } from '../language/language';
import { MOVES } from '../player/commands';
import * as players from '../player/player';
import type { Pointing, Scene } from '../player/scene';
import { lastFrame, stops, stretchAt, type Tape } from '../player/tape';
import * as demos from './demonstration';
import type { Demonstration, Move } from './demonstration';
import type { PlayDrafts } from './drafts';

export interface PlayOptions {
  readonly draft: string; // the key of its draft
  readonly drafts: PlayDrafts;
  readonly ask: AskOf<'hier_demo'>;
  readonly vocabulary: Vocabulary;
  readonly price: Price;
  readonly withReplay: boolean; // whether the answer says what was seen
  readonly still: boolean; // reduced motion: nothing plays by itself
}

export interface PlayEvents {
  tell(moves: PlayMoves): void; // to the learner's environment
  submit(answer: AnswerOf<'hier_demo'>): void;
  skip(): void;
  undo(): void;
}

type Stage = 'connecting' | 'here' | 'away' | 'lost' | 'refused';

/** One demonstration on the screen: its moves, the states that the learner's environment returned, and the keys. */
export class Play {
  demonstration: Demonstration;
  stage: Stage = $state('connecting');
  refusal = $state(''); // why the server refuses the connection
  hint = $state(''); // why a key did nothing
  doubtful = $state(false); // whether to ask before sending, because the task is not accomplished
  player = $state.raw(players.player(0, 0)); // over what the learner did before, and the demonstration
  readonly bindings;
  readonly tape: Tape = $derived.by(() => demos.tapeOf(this.demonstration, this.ask));
  readonly parts = $derived.by(() => demos.partsOf(this.demonstration));
  readonly steps = $derived.by(() => demos.countActions(this.parts));
  readonly cost = $derived.by(() => demos.costOf(this.demonstration, this.#options.price));
  readonly scene: Scene = $derived.by(() => this.#scene());
  readonly pointing: Pointing = $derived.by(() => this.#pointing());

  readonly #options: PlayOptions;
  readonly #events: PlayEvents;
  #number = 0;
  #underway: number | null = null; // the message whose states have not arrived yet
  #heard = false; // whether the first state has arrived with its picture
  #outdated = false; // whether moves were undone since the last message
  #firstShowing = false;

  constructor(options: PlayOptions, events: PlayEvents) {
    const { ask, draft, drafts, vocabulary } = options;
    this.#options = options;
    this.#events = events;
    this.bindings = bindingsFor(ask.flat ? 'flat_demo' : this.playsOn ? 'play_on' : 'hier_demo', vocabulary);
    this.demonstration = $state.raw(demos.begin(ask, drafts.of(draft, vocabulary)));
    this.player = this.#firstLook();
  }

  get ask(): AskOf<'hier_demo'> {
    return this.#options.ask;
  }

  /** Whether it begins where the learner failed. */
  get playsOn(): boolean {
    return demos.playsOn(this.ask);
  }

  /** Whether an earlier state is shown than the one in which the next move is made. */
  get looksBack(): boolean {
    return this.player.at < lastFrame(this.tape);
  }

  /** Whether there is nothing to do but to send it, although the task may not be accomplished. */
  get complete(): boolean {
    return demos.isComplete(this.demonstration, this.ask);
  }

  /** Whether there is no move to make: the episode has ended, or all asked segments are played. */
  get over(): boolean {
    return this.demonstration.ended || this.complete;
  }

  /** Whether a segment has a step, so that its subgoal is fixed. */
  get underway(): boolean {
    return (this.current?.actions.length ?? 0) > 0;
  }

  /** Milliseconds per frame while playing. */
  get pace(): number {
    return 1000 / players.framesPerSecond(this.player, this.#firstShowing);
  }

  tick(frames: number): void {
    this.player = players.advance(this.player, frames);
    if (!this.player.playing) this.#firstShowing = false;
  }

  seek(frame: number): void {
    this.#look(players.seek(this.player, frame));
  }

  /** The segment that is being played, if any. */
  get current(): demos.Part | null {
    const last = this.parts.at(-1);
    return last && !last.reached ? last : null;
  }

  run(command: Command): void {
    this.hint = '';
    const { subgoals, actions } = this.#options.vocabulary;
    const [name, index = ''] = command.split(':');
    const look = MOVES[command];
    if (look) this.#look(look(this.player, stops(this.tape)));
    else if (name === 'choose') this.#make({ does: 'choose', subgoal: subgoals[Number(index)] ?? '' });
    else if (name === 'act') this.#make({ does: 'act', action: actions[Number(index)] ?? '' });
    else if (command === 'reached') this.#reached();
    else if (command === 'send') this.#send();
    else if (command === 'clear') this.#takeBack();
    else if (command === 'start-over') this.#make({ does: 'restart' });
    else if (command === 'skip' || command === 'undo') this.#events[command]();
  }

  /** Send the demonstration, accomplished or not. */
  sendAnyway(): void {
    const answer = demos.answerOf(this.demonstration, this.#options.withReplay);
    if (answer !== null) this.#events.submit(answer);
  }

  // --- from the connection

  present(isHere: boolean): void {
    this.stage = isHere ? 'here' : 'away';
    this.#underway = null; // another environment has not received the message
    this.#catchUp();
  }

  lost(): void {
    this.stage = 'lost';
  }

  refused(words: string): void {
    this.stage = 'refused';
    this.refusal = words;
  }

  states(news: PlayStates): void {
    if (news.number !== this.#underway) return;
    this.#underway = null;
    if (!this.#outdated) {
      this.#heard = true;
      this.#keep(demos.learn(this.demonstration, news));
    }
    this.#catchUp();
  }

  // --- from the annotator

  #make(move: Move): void {
    if (this.stage !== 'here' && move.does === 'act') {
      this.hint = t('The learner’s environment is not connected, so a step cannot be carried out now.');
      return;
    }
    const obstacle = demos.obstacle(this.demonstration, this.ask, move);
    if (obstacle !== null) {
      this.hint = obstacle;
      return;
    }
    this.#outdated ||= move.does === 'restart';
    this.#keep(demos.make(this.demonstration, move));
    this.#catchUp();
  }

  #takeBack(): void {
    if (this.demonstration.moves.length === 0) {
      this.hint = t('No step is played yet.');
      return;
    }
    this.#outdated = true;
    this.#keep(demos.takeBack(this.demonstration));
    this.#catchUp();
  }

  #reached(): void {
    if (this.over || this.ask.flat) this.#send();
    else this.#make({ does: 'reach' });
  }

  #send(): void {
    if (this.steps === 0) this.hint = t('No step is played yet.');
    else if (demos.isBehind(this.demonstration))
      this.hint = t('The last steps are not carried out yet. Wait for the learner’s environment.');
    else if (this.demonstration.succeeded || this.complete) this.sendAnyway();
    else this.doubtful = true;
  }

  #keep(demonstration: Demonstration): void {
    this.demonstration = demonstration;
    this.#showNow();
    this.#options.drafts.keep(this.#options.draft, demonstration.moves);
  }

  /** Send the environment the steps that it has not carried out: one message at a time, always with the newest moves. */
  #catchUp(): void {
    if (this.stage !== 'here' || this.#underway !== null) return;
    if (this.#heard && !demos.isBehind(this.demonstration)) return;
    this.#underway = ++this.#number;
    this.#outdated = false;
    this.#events.tell({
      type: 'moves',
      number: this.#number,
      segments: demos.segmentsOf(this.demonstration),
      known: this.#heard ? this.demonstration.states.length : 0,
    });
  }

  #look(player: players.Player): void {
    this.#firstShowing = false;
    this.player = player;
  }

  /** Show the state in which the next move is made, unless what the learner did is still shown for the first time. */
  #showNow(): void {
    const last = lastFrame(this.tape);
    const isUnmoved = last === this.tape.start && this.demonstration.moves.length === 0;
    this.player = isUnmoved
      ? { ...this.player, last, at: Math.min(this.player.at, last) }
      : players.seek({ ...this.player, last }, last);
  }

  /** Return the player at the beginning: it shows how the learner failed, immediately and fast. */
  #firstLook(): players.Player {
    const { stretches } = this.tape;
    const failed = stretches.find((stretch) => stretch.failed)?.first ?? 0;
    const begin = players.player(failed, lastFrame(this.tape));
    if (!this.playsOn || this.#options.still || this.demonstration.moves.length > 0)
      return players.seek(begin, begin.last);
    this.#firstShowing = true;
    return players.toggle(begin);
  }

  /** Before the first step of a segment, pointing chooses its subgoal. With a subgoal, it carries out an action. */
  #pointing(): Pointing {
    const { subgoals, actions } = this.#options.vocabulary;
    const mayChoose = !this.ask.flat && !this.over && !this.underway && !this.looksBack;
    const choose = (name: string): void => this.run(`choose:${subgoals.indexOf(name)}`);
    const mayAct = !this.over && !this.looksBack && (this.ask.flat || this.current !== null);
    const act = (name: string): void => this.run(`act:${actions.indexOf(name)}`);
    const show = this.playsOn ? (frame: number): void => this.seek(frame) : null;
    return {
      show,
      pick: show,
      choose: mayChoose ? choose : null,
      act: mayAct ? act : null,
      pending: demos.pendingOf(this.demonstration),
      labeling: null,
    };
  }

  #scene(): Scene {
    const { current, tape, ask, looksBack } = this;
    const { at } = this.player;
    const chosen = !looksBack && current?.subgoal && current.actions.length === 0 ? current.subgoal : null;
    const playing = current === null ? null : ask.context.length + this.parts.length - 1;
    return {
      instance: this.ask.instance,
      tape,
      vocabulary: this.#options.vocabulary,
      at,
      current: looksBack ? (stretchAt(tape, at)?.index ?? null) : playing,
      labels: chosen === null ? [] : [{ frame: at, name: chosen }],
    };
  }
}

/** Return a sentence that says what to do next. */
export function nextStep(play: Play): string {
  const { current, ask, steps } = play;
  if (play.player.at < play.tape.start)
    return t('This is what the learner did. Your moves begin where it failed.');
  if (play.looksBack) return t('You are looking back. The next move continues from your last state.');
  if (ask.flat)
    return steps === 0
      ? t('Carry out the task, step by step.')
      : t('Continue until the task is accomplished.');
  if (play.complete) return t('Send the demonstration, or undo a move.');
  if (current === null && steps === 0 && play.playsOn) return t('Choose the subgoal to play on to.');
  if (current === null) return steps === 0 ? t('Choose the first subgoal.') : t('Choose the next subgoal.');
  const subgoal = readable(current.subgoal ?? '');
  return current.actions.length === 0
    ? t(`Move toward “${subgoal}”.`)
    : t(`Press “Reached” when “${subgoal}” is reached.`);
}
