// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Refused, Unreachable } from '../../api/client';
import { KINDS, type LeaseRequest, type Receipt } from '../../api/types';
import { add, attempted, load, save, without, type Outbox, type PendingAnswer } from './outbox';
import { AnswerSender, type SendAnswer } from './sender';

const pending = (assignment: number): PendingAnswer => ({
  assignment,
  token: 't',
  key: `k${assignment}`,
  attempts: 0,
  answer: { kind: 'inspect_full', verdict: 'pass' },
});
const receipt: Receipt = {
  query: 1,
  answer: 1,
  units: 1,
  seconds: 2,
  active_seconds: 2,
  next: null,
  next_problem: null,
};

const fillStorage = () =>
  vi.spyOn(sessionStorage, 'setItem').mockImplementation(() => {
    throw new DOMException('The storage is full.', 'QuotaExceededError');
  });

describe('the outbox', () => {
  beforeEach(() => sessionStorage.clear());

  it('keeps answers in order, one per assignment', () => {
    const two = add(add([], pending(1)), pending(2));
    expect(add(two, pending(1)).map((kept) => kept.assignment)).toEqual([2, 1]);
    expect(without(two, 1)).toEqual([pending(2)]);
    expect(attempted(two, 2).map((kept) => kept.attempts)).toEqual([0, 1]);
  });

  it('survives a reload, and anything else in its place', () => {
    save(sessionStorage, [pending(1)]);
    expect(load(sessionStorage)).toEqual([pending(1)]);
    save(sessionStorage, []);
    expect(load(sessionStorage)).toEqual([]);
    for (const broken of ['{', '7', '[{"assignment": "x"}, null]']) {
      sessionStorage.setItem('waypost:outbox', broken);
      expect(load(sessionStorage)).toEqual([]);
    }
  });
});

describe('the sender', () => {
  const answer = vi.fn<SendAnswer>();
  const next: LeaseRequest = { wait: 0, kinds: [...KINDS], run: null, defer: 0, ahead: false, tab: 'tab' };
  const listener = { stored: vi.fn(), refused: vi.fn() };
  let outbox: Outbox = [];
  let isKept = true;
  const newAnswerSender = (): AnswerSender => {
    const sender = new AnswerSender(answer, sessionStorage, (now, kept) => ([outbox, isKept] = [now, kept]));
    sender.listen(listener);
    return sender;
  };

  beforeEach(() => {
    vi.useFakeTimers();
    vi.resetAllMocks();
    sessionStorage.clear();
  });
  afterEach(() => {
    vi.restoreAllMocks();
    vi.useRealTimers();
  });

  it('asks for the next query with the answer, and drops the answer from the outbox with the receipt', async () => {
    answer.mockResolvedValue(receipt);
    expect(await newAnswerSender().send(pending(1), next)).toBe(receipt);
    expect(answer).toHaveBeenCalledWith(pending(1), next);
    expect(outbox).toEqual([]);
    expect(load(sessionStorage)).toEqual([]);
  });

  it('keeps an answer through an outage and sends it until it is stored', async () => {
    answer
      .mockRejectedValueOnce(new Unreachable())
      .mockRejectedValueOnce(new Unreachable())
      .mockResolvedValue(receipt);
    expect(await newAnswerSender().send(pending(1), next)).toBeNull();
    expect(load(sessionStorage)).toHaveLength(1);
    await vi.advanceTimersByTimeAsync(500);
    expect(outbox).toHaveLength(1);
    await vi.advanceTimersByTimeAsync(1000);
    expect(outbox).toEqual([]);
    expect(answer.mock.calls.map(([sent]) => sent.key)).toEqual(['k1', 'k1', 'k1']);
  });

  it('loses nothing in an outage of twenty seconds, and sends the answers of that time in order', async () => {
    const backAt = Date.now() + 20_000;
    const stored: number[] = [];
    answer.mockImplementation((sent) => {
      if (Date.now() < backAt) return Promise.reject(new Unreachable());
      stored.push(sent.assignment);
      return Promise.resolve(receipt);
    });
    const sender = newAnswerSender();
    for (const assignment of [1, 2, 3]) {
      await sender.send(pending(assignment), next);
      await vi.advanceTimersByTimeAsync(3_000);
    }
    expect(outbox).toHaveLength(3);
    await vi.advanceTimersByTimeAsync(11_000 + 8_000);
    expect(stored).toEqual([1, 2, 3]);
    expect(outbox).toEqual([]);
  });

  it('sends answers from before a reload, and returns the query that came with the last receipt', async () => {
    save(sessionStorage, [pending(1), pending(2)]);
    const leased = { id: 9 } as unknown as NonNullable<Receipt['next']>;
    answer.mockResolvedValueOnce(receipt).mockResolvedValueOnce({ ...receipt, next: leased });
    expect(await newAnswerSender().flush(next)).toBe(leased);
    expect(answer.mock.calls.map(([sent, wanted]) => [sent.assignment, wanted])).toEqual([
      [1, null],
      [2, next],
    ]);
    expect(outbox).toEqual([]);
  });

  it('stops at the first answer that cannot be sent, so that the order is kept', async () => {
    save(sessionStorage, [pending(1), pending(2)]);
    answer.mockRejectedValue(new Unreachable());
    expect(await newAnswerSender().flush(next)).toBeNull();
    expect(answer).toHaveBeenCalledTimes(1);
    expect(outbox).toHaveLength(2);
  });

  it('tells the listener when an answer is refused, and does not send it again', async () => {
    const late = new Refused(409, { type: '/problems/lease-expired', detail: 'Too late.' });
    answer.mockRejectedValue(late);
    expect(await newAnswerSender().send(pending(1), next)).toBeNull();
    expect(listener.refused).toHaveBeenCalledWith(late, 1);
    expect(outbox).toEqual([]);
  });

  it('sends an answer that the full storage cannot keep, and says that it is not kept until it is stored', async () => {
    fillStorage();
    let store: (stored: Receipt) => void = () => undefined;
    answer.mockReturnValue(new Promise((resolve) => (store = resolve)));
    const sent = newAnswerSender().send(pending(1), next);
    expect(answer).toHaveBeenCalledWith(pending(1), next);
    expect([outbox.length, isKept]).toEqual([1, false]);
    store(receipt);
    expect(await sent).toBe(receipt);
    expect([outbox.length, isKept]).toEqual([0, true]);
  });

  it('sends an answer again from memory, and keeps it as soon as the storage has room', async () => {
    const storage = fillStorage();
    answer.mockRejectedValue(new Unreachable());
    await newAnswerSender().send(pending(1), next);
    expect([outbox.length, isKept]).toEqual([1, false]);
    storage.mockRestore();
    await vi.advanceTimersByTimeAsync(500);
    expect([load(sessionStorage).length, isKept]).toEqual([1, true]);
    answer.mockResolvedValue(receipt);
    await vi.advanceTimersByTimeAsync(1000);
    expect(outbox).toEqual([]);
  });

  it('keeps an answer while nobody is signed in', async () => {
    answer.mockRejectedValue(new Refused(401, undefined));
    await newAnswerSender().send(pending(1), next);
    expect(outbox).toHaveLength(1);
    expect(listener.refused).not.toHaveBeenCalled();
  });
});
