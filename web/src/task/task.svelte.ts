// The state of one query on the screen, and what every key does.
import type { Answer, Answerable, Vocabulary } from '../api/types';
import { bindingsFor, type Command } from '../keys/registry';
import { t } from '../language/language';
import { answerOf, choose, chooseAll, EDITS, hintOf, moveTo, newLabels, type Labels } from './labels/labels';
import type { HiLabels } from './labels/hi';
import { pickState, type LoLabels } from './labels/lo';
import { MOVES } from '../player/commands';
import * as players from '../player/player';
import { askedFrames, buildTape, lastFrame, stops, stretchAt } from '../player/tape';
import type { Choice, Label, Pointing, Scene } from '../player/scene';
import { draftOf, keepDraft } from './labels/drafts';

export interface TaskOptions {
  readonly ask: Answerable;
  readonly vocabulary: Vocabulary;
  readonly draft: number | null; // the id under which the labels are kept; null: not kept
  readonly speed: number;
  readonly still: boolean; // reduced motion: nothing plays by itself
}

export interface TaskEvents {
  submit(answer: Answer): void;
  skip(): void;
  undo(): void;
}

/** One query on the screen: its player and its labels, and what every key does to both. */
export class Task {
  readonly ask;
  readonly tape;
  readonly stops;
  readonly bindings;
  player = $state.raw(players.player(0, 0));
  labels: Labels | null = $state.raw(null);
  hint = $state(''); // why a key did nothing
  readonly answer: Answer | null = $derived.by(() => answerOf(this.labels));
  readonly scene: Scene = $derived.by(() => this.#scene());
  readonly pointing: Pointing = $derived.by(() => this.#pointing());

  /** Whether the state shown needs an action. */
  readonly #asksForAction: boolean = $derived.by(() => {
    const state = this.#frames.indexOf(this.player.at);
    return this.labels !== null && this.labels.kind !== 'label_hi' && state in this.labels.actions;
  });
  readonly #options: TaskOptions;
  readonly #events: TaskEvents;
  readonly #frames: readonly number[]; // frame of each asked state
  #firstShowing = false;

  constructor(options: TaskOptions, events: TaskEvents) {
    const { ask, vocabulary, draft } = options;
    this.#options = options;
    this.#events = events;
    this.ask = ask;
    this.tape = buildTape(ask.context, ask.segments);
    this.stops = stops(this.tape);
    this.bindings = bindingsFor(ask.kind, vocabulary);
    this.#frames = askedFrames(this.tape);
    this.labels = (draft === null ? undefined : draftOf(draft)) ?? newLabels(ask);
    this.player = this.#firstLook();
    this.#showCursor();
  }

  /** Milliseconds per frame while playing. */
  get pace(): number {
    return 1000 / players.framesPerSecond(this.player, this.#firstShowing);
  }

  tick(frames: number): void {
    this.player = players.advance(this.player, frames);
    if (this.player.playing) return;
    this.#firstShowing = false;
    this.#showCursor();
  }

  /** Show a frame. With action labels, its state is then the next one to label. */
  seek(frame: number): void {
    this.#move(players.seek(this.player, frame));
  }

  /** Show a frame that was pointed at. In Label_HI, its segment is then the next one to label. */
  pick(frame: number): void {
    const stretch = stretchAt(this.tape, frame);
    if (this.ask.kind === 'label_hi' && stretch?.asked) this.moveTo(stretch.index - this.ask.context.length);
    const state = this.#frames.indexOf(frame);
    if (this.labels !== null && this.labels.kind !== 'label_hi' && state !== -1) this.pickState(state);
    this.seek(frame);
  }

  /** Move to a state. A state after the first unlabeled one is marked as the first wrong step. */
  pickState(state: number): void {
    this.#edit((labels) => (labels.kind === 'label_hi' ? labels : pickState(labels, state)));
  }

  moveTo(index: number): void {
    this.#edit((labels) => moveTo(labels, index));
  }

  run(command: Command): void {
    this.hint = '';
    const move = MOVES[command];
    const edit = EDITS[command];
    if (move) this.#move(move(this.player, this.stops));
    else if (command === 'pass' || command === 'fail') this.#judge(command);
    else if (command === 'skip' || command === 'undo') this.#events[command]();
    else if (command === 'accept' && this.answer) this.#events.submit(this.answer);
    else if (command.startsWith('choose:')) this.#choose(Number(command.slice('choose:'.length)));
    else if (edit) this.#edit(edit, hintOf(command));
    if (command === 'accept-rest') this.#submitAll();
  }

  #judge(verdict: 'pass' | 'fail'): void {
    const { kind } = this.ask;
    if (kind === 'inspect_full' || kind === 'inspect_lo') this.#events.submit({ kind, verdict });
  }

  #choose(index: number): void {
    this.#edit((labels) => choose(labels, index, this.#options.vocabulary), hintOf('choose'));
  }

  #pointing(): Pointing {
    const of = this.labels === null ? null : this.labels.kind === 'label_hi' ? 'subgoals' : 'actions';
    const { subgoals, actions } = this.#options.vocabulary;
    const act = (name: string): void => {
      this.seek(this.player.at); // while it plays, the state shown is not the next one to label
      this.run(`choose:${actions.indexOf(name)}`);
    };
    return {
      show: (frame) => this.seek(frame),
      pick: (frame) => this.pick(frame),
      choose: of === 'subgoals' ? (name) => this.run(`choose:${subgoals.indexOf(name)}`) : null,
      act: this.#asksForAction ? act : null,
      pending: [],
      labeling: of && { of, draw: (choices, end) => this.#draw(choices, end) },
    };
  }

  /** Label the states or segments of a drawn way in one edit, which can be undone at once. */
  #draw(choices: readonly Choice[], end: number | null): void {
    this.hint = '';
    const asked = this.tape.stretches.filter((stretch) => stretch.asked).map((stretch) => stretch.first);
    const places = this.ask.kind === 'label_hi' ? asked : this.#frames;
    const named = choices.map(({ frame, name }) => [places.indexOf(frame), name] as const);
    const next = end === null ? null : places.indexOf(end);
    this.#edit((labels) => chooseAll(labels, named, next), hintOf('draw'));
  }

  #submitAll(): void {
    if (this.answer) this.#events.submit(this.answer);
    else this.hint = t('A label is missing here, and the learner made no choice to keep. Choose one.');
  }

  #edit(change: (labels: Labels) => Labels, hint = ''): void {
    if (this.labels === null) return;
    const next = change(this.labels);
    if (next === this.labels) this.hint = hint;
    this.labels = next;
    if (this.#options.draft !== null) keepDraft(this.#options.draft, next);
    this.#showCursor();
  }

  #move(next: players.Player): void {
    this.#firstShowing = false;
    this.player = next;
    if (next.playing || this.labels === null || this.labels.kind === 'label_hi') return;
    this.labels = moveTo(
      this.labels,
      Math.max(
        0,
        this.#frames.findLastIndex((frame) => frame <= next.at),
      ),
    );
  }

  /** Return the player at the beginning. An inspection plays immediately and fast; labeling begins at the first state. */
  #firstLook(): players.Player {
    const { speed, still } = this.#options;
    const begin = players.player(this.tape.start, lastFrame(this.tape), speed);
    if (this.labels !== null) return begin;
    if (still) return players.seek(begin, begin.last);
    this.#firstShowing = true;
    return players.toggle(begin);
  }

  /** If the query needs labels, show the frame of the label under the cursor. */
  #showCursor(): void {
    if (this.labels === null) return;
    const { cursor, kind } = this.labels;
    const asked = this.tape.stretches.filter((stretch) => stretch.asked);
    const frame = kind === 'label_hi' ? asked[cursor]?.first : this.#frames[cursor];
    this.player = players.seek(this.player, frame ?? this.player.at);
  }

  #scene(): Scene {
    const { ask, labels, tape } = this;
    const { at } = this.player;
    const isHi = labels?.kind === 'label_hi';
    const current = isHi ? ask.context.length + labels.cursor : (stretchAt(tape, at)?.index ?? null);
    return {
      instance: ask.instance,
      tape,
      vocabulary: this.#options.vocabulary,
      at,
      current,
      labels: labels === null ? [] : isHi ? this.#subgoalMarks(labels) : this.#actionMarks(labels),
    };
  }

  #subgoalMarks(labels: HiLabels): Label[] {
    const asked = this.tape.stretches.filter((stretch) => stretch.asked);
    const marks = labels.subgoals.map((name, index) => ({ frame: asked[index]?.first ?? 0, name }));
    return marks.filter((mark) => mark.name !== null);
  }

  #actionMarks(labels: LoLabels): Label[] {
    const marks = labels.actions.map((name, state) => ({ frame: this.#frames[state] ?? 0, name }));
    const said = marks.filter((mark) => mark.name !== null);
    const end = typeof labels.end === 'number' ? this.#frames[labels.end] : undefined;
    return end === undefined ? said : [...said, { frame: end, name: null }];
  }
}
