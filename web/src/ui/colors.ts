/** The color a custom property has here and now, light or dark; for canvases, which know no custom properties. */
export function readColor(element: Element, name: string): string {
  const probe = element.appendChild(document.createElement('span'));
  probe.style.color = `var(--${name})`;
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color;
}
