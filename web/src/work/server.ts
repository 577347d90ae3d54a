// The requests of the work view, except answers: lease a query, renew and release the lease, take an answer back.
import { api, unwrap } from '../api/client';
import type { Assignment, Kind, LeaseRequest, Me, Outlook } from '../api/types';

/** Which queries this tab asks for. */
export interface Wanted {
  readonly run: string | null; // only this run's queries
  readonly kinds: readonly Kind[];
}

/** The proof that this tab holds a lease. */
export interface LeaseProof {
  readonly assignment: number;
  readonly token: string;
}

export interface WorkServer {
  lease(request: LeaseRequest, signal: AbortSignal): Promise<Assignment | null>;
  renew(lease: LeaseProof, active: boolean): Promise<unknown>;
  release(lease: LeaseProof, reason: string, skip: boolean): Promise<unknown>;
  /** Say that the tab closes: release all its current and future leases, except the assignments in `keep`. */
  leave(tab: string, keep: number[]): Promise<unknown>;
  retract(lease: LeaseProof, tab: string): Promise<Assignment>;
  me(): Promise<Me>;
  /** Say what the learners do, and how many questions are open. */
  outlook(run: string | null): Promise<Outlook>;
}

/** Return a request for the next query; `wait` is in seconds. */
export function leaseRequest(wanted: Wanted, tab: string, wait: number, ahead = false): LeaseRequest {
  return { wait, kinds: [...wanted.kinds], run: wanted.run, defer: 0, ahead, tab };
}

export function proofOf(assignment: Assignment): LeaseProof {
  return { assignment: assignment.id, token: assignment.token };
}

const path = ({ assignment }: LeaseProof) => ({ path: { assignment } });

export const restServer: WorkServer = {
  async lease(body, signal) {
    return (await unwrap(api.POST('/api/v1/assignments', { body, signal }))) ?? null;
  },
  renew(lease, active) {
    const body = { token: lease.token, active };
    return unwrap(api.POST('/api/v1/assignments/{assignment}/renew', { params: path(lease), body }));
  },
  release(lease, reason, skip) {
    const body = { token: lease.token, reason, skip };
    const options = { params: path(lease), body, keepalive: true }; // sent even while the tab closes
    return unwrap(api.POST('/api/v1/assignments/{assignment}/release', options));
  },
  leave(tab, keep) {
    return unwrap(api.POST('/api/v1/assignments/leave', { body: { tab, keep }, keepalive: true }));
  },
  retract(lease, tab) {
    const body = { token: lease.token, tab };
    return unwrap(api.POST('/api/v1/assignments/{assignment}/retract', { params: path(lease), body }));
  },
  me: () => unwrap(api.GET('/api/v1/me')),
  outlook: (run) => unwrap(api.GET('/api/v1/outlook', { params: { query: run === null ? {} : { run } } })),
};
