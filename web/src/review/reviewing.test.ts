import { expect, it, vi } from 'vitest';

type Get = (
  path: string,
  asked: { params: { path: { query?: number }; query?: { before?: number } } },
) => unknown;
const get = vi.fn<Get>();
vi.mock('../api/client', () => ({
  api: { GET: get },
  unwrap: (value: unknown) => value,
  isAborted: () => false,
  wordsOf: String,
}));

it('a late reload of an answer does not replace the next one', async () => {
  const { Reviewing } = await import('./reviewing.svelte');
  const late: (() => void)[] = [];
  let isLate = false;
  get.mockImplementation((path, { params }) => {
    if (path.endsWith('/review')) {
      const id = (params.query?.before ?? null) === null ? 8 : 7;
      return Promise.resolve({ rows: [{ query: { id } }], total: 2, oldest: 7, newest: 8 });
    }
    const details = { id: params.path.query };
    return isLate ? new Promise((resolve) => late.push(() => resolve(details))) : Promise.resolve(details);
  });
  const reviewing = new Reviewing('a run');
  await reviewing.open({}, null);
  expect(reviewing.shown?.query.id).toBe(8);
  isLate = true;
  const moved = reviewing.next({});
  const reload = reviewing.refresh(); // of the answer that is still on the screen
  isLate = false;
  await moved;
  expect(reviewing.shown?.query.id).toBe(7);
  late.forEach((come) => come());
  await reload;
  expect(reviewing.shown?.query.id).toBe(7);
});
