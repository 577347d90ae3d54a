// Scrolling inside a list.

/**
 * Scroll a list so that a row and some pixels around it are visible. Only the list scrolls: if the page did, too, the
 * picture would move away from a finger that draws on it.
 */
export function showRow(list: HTMLElement, row: Element | undefined, around: number): void {
  if (row === undefined) return;
  const [outer, inner] = [list.getBoundingClientRect(), row.getBoundingClientRect()];
  const [above, below] = [outer.top - inner.top + around, inner.bottom - outer.bottom + around];
  if (above > 0) list.scrollTop -= above;
  else if (below > 0) list.scrollTop += below;
}
