// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { PlayMoves } from '../api/types';
import { PlaySocket } from './socket';

const hello = { type: 'take', assignment: 3, token: 'secret' } as const;
const moves: PlayMoves = { type: 'moves', number: 1, segments: [], known: 1 };

/** A socket whose other end is the test. */
class Wire {
  readyState: number = WebSocket.CONNECTING;
  sent: unknown[] = [];
  onopen = (): void => undefined;
  onmessage = (_: { data: string }): void => undefined;
  onclose = (_: { code: number; reason: string }): void => undefined;

  send(text: string): void {
    this.sent.push(JSON.parse(text));
  }

  accept(): void {
    this.readyState = WebSocket.OPEN;
    this.onopen();
  }

  say(message: unknown): void {
    this.onmessage({ data: JSON.stringify(message) });
  }

  close(code = 1006, reason = ''): void {
    this.readyState = WebSocket.CLOSED;
    this.onclose({ code, reason });
  }
}

let wires: Wire[];
let heard: unknown[];
let socket: PlaySocket;
const last = (): Wire => {
  const wire = wires.at(-1);
  if (wire === undefined) throw new Error('no socket was opened');
  return wire;
};

beforeEach(() => {
  vi.useFakeTimers();
  [wires, heard] = [[], []];
  const open = (): WebSocket => {
    wires.push(new Wire());
    return last() as unknown as WebSocket;
  };
  socket = new PlaySocket(open, hello, {
    stage: (present) => heard.push(present),
    states: (news) => heard.push(news.number),
    lost: () => heard.push('lost'),
    refused: (words, status) => heard.push(words, status),
  });
});
afterEach(() => {
  socket.close();
  vi.useRealTimers();
});

describe('the play socket', () => {
  it('says who we are first, then carries moves there and states back', () => {
    socket.send(moves); // too early: nobody is there
    last().accept();
    last().say({ type: 'stage', present: true });
    socket.send(moves);
    last().say({ type: 'states', number: 1, known: 1, states: [], ended: false, succeeded: false });
    expect(last().sent).toEqual([hello, moves]);
    expect(heard).toEqual([true, 1]);
  });

  it.each([1006, 1012, 4503, 4429])('is opened again when it is closed with %i', async (code) => {
    last().accept();
    last().close(code);
    expect(heard).toEqual(['lost']);
    await vi.advanceTimersByTimeAsync(600);
    expect(wires).toHaveLength(2);
    last().accept();
    expect(last().sent).toEqual([hello]);
  });

  it('tries less and less often while there is no server, and at once when the network is back', async () => {
    last().close();
    for (const wait of [500, 1_000, 2_000]) {
      const before = wires.length;
      await vi.advanceTimersByTimeAsync(wait - 1);
      expect(wires).toHaveLength(before);
      await vi.advanceTimersByTimeAsync(1);
      expect(wires).toHaveLength(before + 1);
      last().close();
    }
    const before = wires.length;
    window.dispatchEvent(new Event('online'));
    await vi.advanceTimersByTimeAsync(0);
    expect(wires).toHaveLength(before + 1);
  });

  it.each([4401, 4403, 4404, 4409, 4422])('is not opened again after a refusal: %i', async (code) => {
    last().close(code, 'displaced: A newer connection has replaced this one.');
    await vi.advanceTimersByTimeAsync(60_000);
    expect(heard).toEqual(['It is open in another tab or browser.', code - 4000]);
    expect(wires).toHaveLength(1);
  });

  it('keeps the words of a refusal that the page has none for', async () => {
    last().close(4422, 'unprocessable: segments.0: is: not valid');
    await vi.advanceTimersByTimeAsync(0);
    expect(heard).toEqual(['segments.0: is: not valid', 422]);
  });

  it('is silent after we left', async () => {
    last().accept();
    socket.close();
    last().say({ type: 'stage', present: true });
    await vi.advanceTimersByTimeAsync(60_000);
    expect([heard, wires.length]).toEqual([[], 1]);
  });
});
