import { expect, it } from 'vitest';
import { wordsOfEnding } from './words';

it('says how each time it was handed out ended', () => {
  const past = {
    id: 1,
    annotator: 'ann',
    leased_at: 0,
    expires_at: 1,
    ended_at: 1,
    reason: null,
    answer: null,
  };
  const answer = {
    id: 1,
    at: 0,
    units: 1,
    seconds: 1,
    content: { kind: 'inspect_full', verdict: 'fail' },
  } as const;
  expect(wordsOfEnding({ ...past, state: 'skipped', reason: 'too dark' })).toBe('skipped: too dark');
  expect(wordsOfEnding({ ...past, state: 'expired' })).toBe('lease expired');
  expect(wordsOfEnding({ ...past, state: 'answered', answer: { ...answer, fate: 'retracted' } })).toBe(
    'answered (✗ fail), then taken back',
  );
  expect(wordsOfEnding({ ...past, state: 'expired', answer: { ...answer, fate: 'late' } })).toBe(
    'answered after the lease expired (✗ fail), not charged',
  );
});
