// Where the focus goes when a view opens. Without this, it stays on the link in the header, or nowhere.

/** Focus the heading of the view, or its main part if it has no heading. */
export function land(view: Element): void {
  const place = view.querySelector<HTMLElement>('main h1') ?? view.querySelector<HTMLElement>('main');
  if (place === null) return;
  if (!place.hasAttribute('tabindex')) place.tabIndex = -1;
  place.focus({ preventScroll: true });
}

/** Focus the heading of a view once it is loaded, unless the focus is moved before. The returned function gives up. */
export function landWhenLoaded(view: Element): () => void {
  const before = document.activeElement;
  if (before !== null && view.contains(before) && before.matches('a[aria-current]')) return () => undefined;
  const observer = new MutationObserver(attempt);

  function attempt(): void {
    const now = document.activeElement;
    const isMoved = now !== before && now !== document.body && now !== null;
    const isLoaded = view.querySelector('main:not([aria-busy])') !== null;
    if (!isMoved && !isLoaded) return;
    observer.disconnect();
    if (!isMoved) land(view);
  }

  observer.observe(view, { childList: true, subtree: true });
  attempt();
  return () => observer.disconnect();
}
