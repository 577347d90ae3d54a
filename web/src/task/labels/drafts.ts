// Drafts: the labels of the queries that were on the screen last, kept until the web app is reloaded.
import type { Labels } from './labels';

const KEPT = 12;
const drafts = new Map<number, Labels>();

/** Return the labels that a query had when it was last on the screen. */
export function draftOf(query: number): Labels | undefined {
  return drafts.get(query);
}

export function keepDraft(query: number, labels: Labels): void {
  drafts.delete(query);
  drafts.set(query, labels);
  const [oldest] = drafts.keys();
  if (drafts.size > KEPT && oldest !== undefined) drafts.delete(oldest);
}
