// Answers, leases and ledger entries in words.
import type { Answer, LedgerEntry, PastAssignment } from '../../api/types';
import { count } from '../../ui/format';

/** Return an answer in a few words. */
export function wordsOfAnswer(answer: Answer | null): string {
  if (answer === null) return '';
  switch (answer.kind) {
    case 'inspect_full':
    case 'inspect_lo':
      return answer.verdict === 'pass' ? '✓ pass' : '✗ fail';
    case 'label_hi':
      return count(answer.subgoals.length, 'subgoal');
    case 'label_lo':
    case 'label_full':
      return count(answer.actions.filter((action) => action !== null).length, 'action');
    case 'hier_demo':
      return count(answer.segments.length, 'segment');
  }
}

/** Return in words how a lease ended. */
export function wordsOfEnding(assignment: PastAssignment): string {
  const { answer, reason, state } = assignment;
  if (answer !== null) {
    const said = wordsOfAnswer(answer.content);
    if (answer.fate === 'late') return `answered after the lease expired (${said}), not charged`;
    return answer.fate === 'retracted' ? `answered (${said}), then taken back` : `answered: ${said}`;
  }
  switch (state) {
    case 'live':
      return 'leased now';
    case 'skipped':
      return reason ? `skipped: ${reason}` : 'skipped';
    case 'released':
      return reason ? `released: ${reason}` : 'released';
    case 'expired':
      return 'lease expired';
    default:
      return state;
  }
}

/** Return a number as text, with a true minus sign. */
export function signed(value: number, format: (value: number) => string): string {
  return value < 0 ? `−${format(-value)}` : format(value);
}

export const ENTRIES: Readonly<Record<LedgerEntry['entry'], string>> = {
  charge: 'charge',
  refund: '↩ refund',
};
