import { describe, expect, it, vi } from 'vitest';
import { throttled } from './live';

describe('live updates', () => {
  it('refresh at once, then at most once in a while, and miss nothing', async () => {
    vi.useFakeTimers();
    const load = vi.fn(() => Promise.resolve());
    const changed = throttled(load, 1000);
    for (let event = 0; event < 9; event++) changed();
    expect(load).toHaveBeenCalledTimes(1);
    await vi.advanceTimersByTimeAsync(1000);
    expect(load).toHaveBeenCalledTimes(2);
    await vi.advanceTimersByTimeAsync(5000);
    expect(load).toHaveBeenCalledTimes(2);
    changed();
    expect(load).toHaveBeenCalledTimes(3);
    vi.useRealTimers();
  });
});
