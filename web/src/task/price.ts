import type { Answerable, Prices } from '../api/types';

/** What an answer to this query will cost, in units; the server's own reckoning is what counts. */
export function priceOf(ask: Answerable, prices: Prices): number {
  const actions = ask.segments.reduce((sum, segment) => sum + segment.actions.length, 0);
  switch (ask.kind) {
    case 'inspect_full':
      return prices.inspect_full;
    case 'inspect_lo':
      return prices.inspect_lo;
    case 'label_hi':
      return ask.segments.length * prices.subgoal;
    case 'label_lo':
      return actions * prices.action + prices.termination;
    case 'label_full':
      return actions * prices.action;
  }
}
