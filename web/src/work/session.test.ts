// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { AnswerSender, type SendAnswer } from './answers/sender';
import { Refused, Unreachable } from '../api/client';
import { KINDS, type Assignment, type LeaseRequest, type Me, type Receipt } from '../api/types';
import type { LeaseProof, WorkServer } from './server';
import { WorkSession } from './session.svelte';

const receipt = (next: Assignment | null): Receipt => ({
  query: 1,
  answer: 1,
  units: 1,
  seconds: 2,
  active_seconds: 2,
  next,
  next_problem: null,
});
const LATE = new Refused(409, { type: '/problems/lease-expired', detail: 'Too late.' });
const PASS = { kind: 'inspect_full', verdict: 'pass' } as const;

function assignment(id: number, episode = id): Assignment {
  const query = { id, run: 'r', priority: 0, ask: { kind: 'inspect_full', episode } };
  return { id, token: `t${id}`, lease_seconds: 60, query } as unknown as Assignment;
}

/** A server that leases the given assignments, in order. */
class FakeServer implements WorkServer {
  offered: Assignment[] = [];
  later: Assignment[] = []; // leased ahead only
  readonly released: number[] = [];
  readonly renew = vi.fn<WorkServer['renew']>(() => Promise.resolve());
  readonly retract = vi.fn<WorkServer['retract']>();

  requested: LeaseRequest | null = null;

  lease(request: LeaseRequest): Promise<Assignment | null> {
    this.requested = request;
    const found = (request.ahead ? this.later : this.offered).shift();
    if (found !== undefined) return Promise.resolve(found);
    return request.wait === 0 ? Promise.resolve(null) : new Promise(() => undefined);
  }

  release(lease: LeaseProof): Promise<unknown> {
    this.released.push(lease.assignment);
    return Promise.resolve();
  }

  readonly leave = vi.fn<WorkServer['leave']>(() => Promise.resolve());

  readonly outlook = vi.fn<WorkServer['outlook']>(() => Promise.reject(new Unreachable()));

  readonly me = vi.fn<WorkServer['me']>(() => Promise.reject(new Unreachable()));
}

describe('a session', () => {
  const answer = vi.fn<SendAnswer>();
  const prepare = vi.fn();
  let active = false;
  let server: FakeServer;
  let session: WorkSession;
  const shown = (): number | undefined => session.assignment?.id;
  const settled = (): Promise<unknown> => vi.advanceTimersByTimeAsync(0);

  async function started(offered: Assignment[], later: Assignment[] = []): Promise<void> {
    [server.offered, server.later] = [offered, later];
    session.start();
    await settled();
  }

  beforeEach(() => {
    vi.useFakeTimers();
    vi.resetAllMocks();
    sessionStorage.clear();
    active = false;
    server = new FakeServer();
    server.renew.mockImplementation(() => Promise.resolve());
    server.me.mockRejectedValue(new Unreachable());
    const sender = new AnswerSender(answer, sessionStorage, () => undefined);
    session = new WorkSession(server, sender, { run: null, kinds: KINDS }, () => active, prepare);
  });
  afterEach(() => {
    session.stop();
    vi.restoreAllMocks();
    vi.useRealTimers();
  });

  it('shows the query leased ahead before the answer is stored', async () => {
    answer.mockReturnValue(new Promise(() => undefined));
    await started([assignment(1)], [assignment(2)]);
    expect(prepare).toHaveBeenCalledWith(expect.objectContaining({ id: 2 }));
    session.submit(PASS);
    expect([shown(), session.phase]).toEqual([2, 'task']);
    expect(answer.mock.calls[0]?.[1]).toMatchObject({ wait: 0, ahead: true });
  });

  it('counts an answer that was stored while the numbers were loading', async () => {
    const today = (answers: number): Me => ({ answers_today: answers }) as Me;
    let arrive = (_: Me): void => undefined;
    server.me
      .mockReturnValueOnce(new Promise((resolve) => (arrive = resolve)))
      .mockResolvedValueOnce(today(1));
    answer.mockResolvedValue(receipt(null));
    await started([assignment(1)]);
    session.submit(PASS);
    await settled();
    arrive(today(0));
    await settled();
    expect(session.me?.answers_today).toBe(1);
  });

  it('shows the query that comes with the receipt if none is leased ahead', async () => {
    answer.mockResolvedValue(receipt(assignment(2)));
    await started([assignment(1)]);
    session.submit(PASS);
    expect(session.phase).toBe('sending');
    await settled();
    expect(shown()).toBe(2);
    expect(answer.mock.calls[0]?.[1]).toMatchObject({ wait: 0.25, ahead: false });
  });

  it('shows queries of the episode on the screen before others that were leased earlier', async () => {
    server.retract.mockResolvedValue(assignment(1, 1));
    answer.mockResolvedValueOnce(receipt(assignment(3, 5))).mockResolvedValueOnce(receipt(assignment(4, 1)));
    await started([assignment(1, 1)], [assignment(2, 1)]);
    session.submit(PASS);
    await settled(); // 2 on the screen, 3 of another episode ahead
    await session.undo(); // 1 on the screen, 2 and 3 ahead
    session.submit(PASS);
    await settled(); // 2 on the screen, 3 and 4 ahead
    answer.mockReturnValue(new Promise(() => undefined));
    session.submit(PASS);
    expect(shown()).toBe(4);
    session.submit(PASS);
    expect(shown()).toBe(3);
  });

  it('leases two queries ahead, so that fast answers do not wait for the server', async () => {
    answer.mockReturnValue(new Promise(() => undefined));
    await started([assignment(1)], [assignment(2), assignment(3), assignment(4)]);
    session.submit(PASS);
    session.submit(PASS);
    expect([shown(), session.phase]).toEqual([3, 'task']);
    expect(server.later).toEqual([assignment(4)]);
  });

  it('leases ahead with one request at a time, and again when a receipt brought no query', async () => {
    const lease = vi.spyOn(server, 'lease');
    answer.mockResolvedValue(receipt(null));
    await started([assignment(1)], [assignment(2)]);
    const waits = (): unknown[] => lease.mock.calls.map(([request]) => [request.wait, request.ahead]);
    expect(waits()).toEqual([
      [0, false],
      [20, true],
      [0, true], // there is no third query, and one ahead is enough to go on
    ]);
    session.submit(PASS);
    expect(lease).toHaveBeenCalledTimes(3); // the answer asks for another
    await settled();
    expect(waits().slice(3)).toEqual([[20, true]]);
  });

  it('keeps at most two queries ahead, and releases the third', async () => {
    answer.mockResolvedValue(receipt(assignment(3)));
    server.retract.mockResolvedValue(assignment(1));
    await started([assignment(1)], [assignment(2)]);
    session.submit(PASS);
    await settled(); // 2 on the screen, 3 ahead
    await session.undo();
    expect(shown()).toBe(1);
    expect(server.released).toEqual([]);
    answer.mockResolvedValue(receipt(assignment(4)));
    session.submit(PASS);
    await settled(); // 2 on the screen, 3 and 4 ahead
    await session.undo();
    expect(server.released).toEqual([4]);
    session.submit(PASS);
    expect(shown()).toBe(2);
  });

  it('takes back the last answer, also one that was stored only after an outage, and none before it', async () => {
    answer.mockResolvedValueOnce(receipt(null)).mockRejectedValueOnce(new Unreachable());
    server.retract.mockImplementation((lease) => Promise.resolve(assignment(lease.assignment)));
    await started([assignment(1)], [assignment(2), assignment(3)]);
    session.submit(PASS);
    await settled();
    session.submit(PASS);
    await session.undo();
    expect(server.retract).not.toHaveBeenCalled();
    expect(session.notice?.text).toContain('Your last answer is not saved yet');
    expect(shown()).toBe(3);
    answer.mockResolvedValue(receipt(null));
    await vi.advanceTimersByTimeAsync(60_000);
    await session.undo();
    expect(shown()).toBe(2);
  });

  it('takes back the answer before one that the server refused', async () => {
    answer.mockResolvedValueOnce(receipt(null)).mockRejectedValueOnce(LATE);
    server.retract.mockImplementation((lease) => Promise.resolve(assignment(lease.assignment)));
    await started([assignment(1)], [assignment(2), assignment(3)]);
    session.submit(PASS);
    await settled();
    session.submit(PASS);
    await settled();
    await session.undo();
    expect(shown()).toBe(1);
  });

  it('goes on to the next query while the storage is full', async () => {
    vi.spyOn(sessionStorage, 'setItem').mockImplementation(() => {
      throw new DOMException('The storage is full.', 'QuotaExceededError');
    });
    answer.mockResolvedValue(receipt(assignment(2)));
    await started([assignment(1)]);
    session.submit(PASS);
    await settled();
    expect(answer).toHaveBeenCalledOnce();
    expect([shown(), session.phase]).toEqual([2, 'task']);
  });

  it('says when the tab closes, and which answers it still sends', async () => {
    await started([assignment(1)], [assignment(2)]);
    answer.mockReturnValue(new Promise(() => undefined));
    session.submit(PASS);
    session.leave();
    expect(server.leave).toHaveBeenCalledExactlyOnceWith(server.requested?.tab, [1]);
    expect(shown()).toBeUndefined();
  });

  it('comes back as another tab', async () => {
    await started([assignment(1)]);
    session.leave();
    const before = server.requested?.tab;
    session.resume();
    await settled();
    expect(server.requested?.tab).not.toBe(before);
  });

  it('releases a query that comes after it was stopped', async () => {
    let arrive: (found: Assignment) => void = () => undefined;
    await started([assignment(1)]);
    answer.mockReturnValue(new Promise((resolve) => (arrive = (next) => resolve(receipt(next)))));
    session.submit(PASS);
    session.stop();
    arrive(assignment(2));
    await settled();
    expect(server.released).toContain(2);
  });

  it('renews the leases ahead, and reports activity only for the query on the screen', async () => {
    await started([assignment(1)], [assignment(2)]);
    active = true;
    await vi.advanceTimersByTimeAsync(20_000);
    const beats = server.renew.mock.calls.map(([lease, isActive]) => [lease.assignment, isActive]);
    expect(beats.toSorted()).toEqual([
      [1, true],
      [2, false],
    ]);
  });

  it('shows none of its queries again after a sleep past their leases', async () => {
    await started([assignment(1)], [assignment(2)]);
    server.renew.mockRejectedValue(LATE);
    server.offered = [assignment(7)];
    await vi.advanceTimersByTimeAsync(20_000);
    expect(shown()).toBe(7);
    expect(session.notice?.text).toContain('went back to the queue');
  });

  it('checks the lease of the next query after an answer that came too late', async () => {
    await started([assignment(1)], [assignment(2)]);
    answer.mockRejectedValue(LATE);
    server.renew.mockRejectedValue(LATE);
    server.offered = [assignment(7)];
    session.submit(PASS);
    await settled();
    expect(shown()).toBe(7);
  });

  it('skips to the query that is leased ahead', async () => {
    await started([assignment(1)], [assignment(2)]);
    await session.skip('dark');
    expect([shown(), server.released]).toEqual([2, [1]]);
    expect(session.notice?.text).toContain('Skipped');
  });

  it('continues with the queries it has while the server is away', async () => {
    await started([assignment(1)], [assignment(2)]);
    answer.mockRejectedValue(new Unreachable());
    session.submit(PASS);
    await settled();
    expect(shown()).toBe(2);
    server.lease = () => Promise.reject(new Unreachable());
    session.submit(PASS);
    await settled();
    expect(session.phase).toBe('offline');
  });
});
