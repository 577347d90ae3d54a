import type { Labels } from './labels';

const KEPT = 12;
const drafts = new Map<number, Labels>();

/** What was labeled before an answer was taken back or a query set aside, by query. */
export function draftOf(query: number): Labels | undefined {
  return drafts.get(query);
}

export function keepDraft(query: number, labels: Labels): void {
  drafts.delete(query);
  drafts.set(query, labels);
  const [oldest] = drafts.keys();
  if (drafts.size > KEPT && oldest !== undefined) drafts.delete(oldest);
}
