import type { Answer, Answerable, Assignment } from '../api/types';
import { bindingsFor, type Command } from '../keys/registry';
import * as hi from '../labels/hi';
import * as lo from '../labels/lo';
import * as players from '../player/player';
import { askedFrames, buildTape, lastFrame, stops, stretchAt } from '../player/tape';
import type { Label, Scene } from '../render/scene';

export interface TaskEvents {
  submit(answer: Answer): void;
  skip(): void;
  undo(): void;
  help(): void;
}

type Labels = hi.HiLabels | lo.LoLabels;

/** What was labeled before an answer was taken back or a query set aside, by query. */
const drafts = new Map<number, Labels>();

/** One query on the screen: where its player stands, what is labeled, and what every key does to both. */
export class Task {
  readonly ask: Answerable;
  readonly tape;
  readonly bindings;
  readonly stops: readonly number[];
  player = $state.raw(players.player(0, 0));
  labels: Labels | null = $state.raw(null);
  hint = $state(''); // why a key did nothing
  readonly scene: Scene = $derived.by(() => this.#scene());
  readonly answer: Answer | null = $derived.by(() => answerOf(this.labels));

  readonly #query: number;
  readonly #vocabulary;
  readonly #frames: readonly number[]; // frame of each labeled state
  readonly #events: TaskEvents;
  #firstShowing = false;

  constructor(assignment: Assignment, ask: Answerable, speed: number, still: boolean, events: TaskEvents) {
    this.ask = ask;
    this.tape = buildTape(ask.context, ask.segments);
    this.stops = stops(this.tape);
    this.bindings = bindingsFor(ask.kind, assignment.run.vocabulary);
    this.#query = assignment.query.id;
    this.#vocabulary = assignment.run.vocabulary;
    this.#frames = askedFrames(this.tape);
    this.#events = events;
    this.labels = drafts.get(this.#query) ?? newLabels(ask);
    this.player = players.player(this.tape.start, lastFrame(this.tape), speed);
    if (this.labels !== null) this.#showCursor();
    else if (still) this.player = players.seek(this.player, this.player.last);
    else {
      this.player = players.toggle(this.player);
      this.#firstShowing = true;
    }
  }

  /** Milliseconds per frame while playing. */
  get pace(): number {
    return 1000 / players.framesPerSecond(this.player, this.#firstShowing);
  }

  tick(frames: number): void {
    this.player = players.advance(this.player, frames);
    if (!this.player.playing) {
      this.#firstShowing = false;
      if (this.labels !== null) this.#showCursor();
    }
  }

  /** Look at a frame; for action labels that is also the state to label next. */
  seek(frame: number): void {
    this.#move(players.seek(this.player, frame));
  }

  moveTo(index: number): void {
    this.#edit((labels) => (labels.kind === 'label_hi' ? hi.moveTo(labels, index) : lo.moveTo(labels, index)));
  }

  firstWrong(state: number): void {
    this.#edit((labels) => (labels.kind === 'label_hi' ? labels : lo.markFirstWrong(labels, state)));
  }

  run(command: Command): void {
    this.hint = '';
    const { labels, player } = this;
    if (command.startsWith('choose:')) return this.#choose(Number(command.slice('choose:'.length)));
    switch (command) {
      case 'pass':
      case 'fail':
        if (this.ask.kind === 'inspect_full' || this.ask.kind === 'inspect_lo') {
          this.#submit({ kind: this.ask.kind, verdict: command });
        }
        return;
      case 'accept':
        return this.answer === null ? this.#accept() : this.#submit(this.answer);
      case 'accept-rest':
        this.#edit((now) => (now.kind === 'label_hi' ? hi.acceptRemaining(now) : lo.acceptRest(now)));
        if (this.answer !== null) this.#submit(this.answer);
        else this.hint = 'The learner has no choice here to keep: say where the segment should have ended.';
        return;
      case 'done':
        return this.#edit((now) => (now.kind === 'label_hi' ? now : lo.setDone(now)));
      case 'not-done':
        return this.#edit((now) => (now.kind === 'label_hi' ? now : lo.setNotDone(now)), '“Not done” is for the last state; label the others with an action.');
      case 'first-wrong':
        if (labels?.kind !== 'label_hi' && labels) this.firstWrong(labels.cursor);
        return;
      case 'clear':
        return this.#edit((now) => (now.kind === 'label_hi' ? hi.clearLast(now) : lo.clearLast(now)));
      case 'previous-segment':
      case 'next-segment':
        return this.moveTo((labels?.cursor ?? 0) + (command === 'next-segment' ? 1 : -1));
      case 'skip':
      case 'undo':
      case 'help':
        return this.#events[command]();
      case 'play':
        this.#firstShowing = false;
        return this.#move(players.toggle(player));
      case 'back':
        return this.#move(players.step(player, -1));
      case 'forward':
        return this.#move(players.step(player, 1));
      case 'back-5':
        return this.#move(players.step(player, -5));
      case 'forward-5':
        return this.#move(players.step(player, 5));
      case 'start':
        return this.#move(players.seek(player, player.first));
      case 'end':
        return this.#move(players.seek(player, player.last));
      case 'previous-stop':
        return this.#move(players.jump(player, this.stops, -1));
      case 'next-stop':
        return this.#move(players.jump(player, this.stops, 1));
      case 'slower':
      case 'faster':
        this.player = players.changeSpeed(player, command === 'faster' ? 1 : -1);
        return;
    }
  }

  #choose(index: number): void {
    this.#edit((labels) => {
      if (labels.kind === 'label_hi') {
        const subgoal = this.#vocabulary.subgoals[index];
        return subgoal === undefined ? labels : hi.setSubgoal(labels, subgoal);
      }
      const action = this.#vocabulary.actions[index];
      return action === undefined ? labels : lo.setAction(labels, action);
    }, 'The last state takes no action: say whether the segment is done here.');
  }

  #accept(): void {
    const hint = 'The learner has no choice here to keep.';
    this.#edit((labels) => (labels.kind === 'label_hi' ? hi.acceptSubgoal(labels) : lo.acceptState(labels)), hint);
  }

  #submit(answer: Answer): void {
    this.#events.submit(answer);
  }

  #edit(change: (labels: Labels) => Labels, hint = ''): void {
    if (this.labels === null) return;
    const next = change(this.labels);
    if (next === this.labels) this.hint = hint;
    this.labels = next;
    drafts.set(this.#query, next);
    this.#showCursor();
  }

  #move(next: players.Player): void {
    this.player = next;
    if (next.playing || this.labels === null || this.labels.kind === 'label_hi') return;
    const state = this.#frames.findLastIndex((frame) => frame <= next.at);
    this.labels = lo.moveTo(this.labels, state);
  }

  #showCursor(): void {
    const { labels } = this;
    if (labels === null) return;
    const asked = this.tape.stretches.filter((stretch) => stretch.asked);
    const frame = labels.kind === 'label_hi' ? asked[labels.cursor]?.first : this.#frames[labels.cursor];
    this.player = players.seek(this.player, frame ?? this.player.at);
  }

  #scene(): Scene {
    const { labels, tape } = this;
    const asked = tape.stretches.find((stretch) => stretch.asked)?.index ?? 0;
    const at = this.player.at;
    const current = labels?.kind === 'label_hi' ? asked + labels.cursor : (stretchAt(tape, at)?.index ?? null);
    const marks = labels === null || labels.kind === 'label_hi' ? [] : this.#marks(labels);
    return { instance: this.ask.instance, tape, vocabulary: this.#vocabulary, at, current, labels: marks };
  }

  #marks(labels: lo.LoLabels): Label[] {
    const marks = labels.actions.map((action, state) => ({ frame: this.#frames[state] ?? 0, action }));
    const said = marks.filter((mark) => mark.action !== null);
    const end = typeof labels.end === 'number' ? this.#frames[labels.end] : undefined;
    return end === undefined ? said : [...said, { frame: end, action: null }];
  }
}

export function forgetDrafts(): void {
  drafts.clear();
}

function newLabels(ask: Answerable): Labels | null {
  switch (ask.kind) {
    case 'label_hi':
      return hi.hiLabels(ask);
    case 'label_lo':
    case 'label_full':
      return lo.loLabels(ask);
    default:
      return null;
  }
}

function answerOf(labels: Labels | null): Answer | null {
  if (labels === null) return null;
  return labels.kind === 'label_hi' ? hi.hiAnswer(labels) : lo.loAnswer(labels);
}
