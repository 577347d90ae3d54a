// The play socket of a query: moves go to the learner, states come back.
import type { PlayMoves, PlayStage, PlayStates, PlayTake } from '../api/types';
import { refusalWords } from '../api/refusals';
import { delay, pause } from '../api/retry';

export interface SocketEvents {
  /** The learner's environment is connected, or it is not. */
  stage(present: boolean): void;
  states(news: PlayStates): void;
  /** The connection is lost; the next attempt follows automatically. */
  lost(): void;
  /** The server refuses the connection and says why. Status 409: the lease has ended. */
  refused(words: string, status: number): void;
}

type OpenSocket = () => WebSocket;

const REFUSED = 4400; // the close codes from here on are 4000 + the HTTP status of the refusal
const PASSING = new Set([4408, 4429]); // after these, and after 4500 and above, connect again

/** The socket of one query. When the connection is lost, it is opened again. */
export class PlaySocket {
  readonly #open: OpenSocket;
  readonly #hello: PlayTake;
  readonly #events: SocketEvents;
  readonly #over = new AbortController();
  #socket: WebSocket | null = null;
  #attempts = 0;

  constructor(open: OpenSocket, hello: PlayTake, events: SocketEvents) {
    this.#open = open;
    this.#hello = hello;
    this.#events = events;
    this.#connect();
  }

  send(moves: PlayMoves): void {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(moves));
  }

  close(): void {
    this.#over.abort();
    this.#socket?.close();
  }

  #connect(): void {
    const socket = (this.#socket = this.#open());
    socket.onopen = () => socket.send(JSON.stringify(this.#hello));
    socket.onmessage = (event: MessageEvent<string>) =>
      this.#hear(JSON.parse(event.data) as PlayStage | PlayStates);
    socket.onclose = (event) => void this.#closed(event);
  }

  #hear(message: PlayStage | PlayStates): void {
    if (this.#over.signal.aborted) return;
    this.#attempts = 0;
    if (message.type === 'stage') this.#events.stage(message.present);
    else this.#events.states(message);
  }

  async #closed({ code, reason }: CloseEvent): Promise<void> {
    if (this.#over.signal.aborted) return;
    if (code >= REFUSED && code < 4500 && !PASSING.has(code)) {
      const { name = '', words = reason } = /^(?<name>[a-z-]+): (?<words>.*)$/.exec(reason)?.groups ?? {};
      this.#events.refused(refusalWords(name) ?? words, code - 4000);
      return;
    }
    this.#events.lost();
    await pause(delay(++this.#attempts), this.#over.signal);
    // eslint-disable-next-line @typescript-eslint/no-unnecessary-condition -- it may be aborted during the pause
    if (!this.#over.signal.aborted) this.#connect();
  }
}

export function openPlaySocket(query: number): WebSocket {
  const address = new URL(`/api/v1/queries/${query}/play`, location.href);
  address.protocol = address.protocol.replace('http', 'ws');
  return new WebSocket(address);
}
