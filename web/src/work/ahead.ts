// The queries that are leased besides the one on the screen, so that the next one appears at once.
import type { Assignment } from '../api/types';
import { beat, type Heartbeat } from './heartbeat';
import { proofOf, type WorkServer } from './server';

const MOST = 2;

interface Kept {
  readonly assignment: Assignment;
  readonly heartbeat: Heartbeat;
}

/** Keeps leased queries in the order in which they will be shown, and renews their leases. */
export class LeasedAhead {
  readonly #server: WorkServer;
  readonly #prepare: (assignment: Assignment) => void; // load the pictures of a query
  #kept: readonly Kept[] = [];

  constructor(server: WorkServer, prepare: (assignment: Assignment) => void) {
    this.#server = server;
    this.#prepare = prepare;
  }

  get size(): number {
    return this.#kept.length;
  }

  get isFull(): boolean {
    return this.#kept.length >= MOST;
  }

  /** Keep a query. Those of the episode on the screen come first; the rest is in the server's order. */
  add(assignment: Assignment, shown: Assignment | null): void {
    this.#prepare(assignment);
    const isOther = (one: Assignment): number => Number(!followsUp(one, shown));
    this.#keep(
      [...this.#assignments(), assignment].toSorted(
        (a, b) => isOther(a) - isOther(b) || b.query.priority - a.query.priority || a.query.id - b.query.id,
      ),
    );
  }

  /** Keep a query that was on the screen, before all others. */
  putFirst(assignment: Assignment): void {
    this.#keep([assignment, ...this.#assignments()]);
  }

  /** Return the first query, which is not kept any more. */
  take(): Assignment | undefined {
    const [first, ...rest] = this.#kept;
    first?.heartbeat.stop();
    this.#kept = rest;
    return first?.assignment;
  }

  /** Keep no query and renew no lease any more. */
  stop(): void {
    this.#keep([]);
  }

  #assignments(): Assignment[] {
    return this.#kept.map((one) => one.assignment);
  }

  /** Keep these queries, in this order, and give back those over the limit. */
  #keep(assignments: readonly Assignment[]): void {
    for (const one of this.#kept) one.heartbeat.stop();
    this.#kept = assignments.slice(0, MOST).map((assignment) => ({
      assignment,
      heartbeat: beat(
        assignment.lease_seconds,
        () => this.#server.renew(proofOf(assignment), false),
        () => (this.#kept = this.#kept.filter((one) => one.assignment !== assignment)),
      ),
    }));
    for (const assignment of assignments.slice(MOST)) void giveBack(this.#server, assignment);
  }
}

/** Release the lease of a query. If the server cannot be reached, the lease expires. */
export async function giveBack(server: WorkServer, assignment: Assignment): Promise<void> {
  try {
    await server.release(proofOf(assignment), '', false);
  } catch {
    // The lease expires.
  }
}

/** Return whether a query is about the episode on the screen. */
function followsUp({ query }: Assignment, shown: Assignment | null): boolean {
  return shown !== null && query.run === shown.query.run && query.ask.episode === shown.query.ask.episode;
}
