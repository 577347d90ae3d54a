/** What a CSS color comes to here and now, light or dark; for canvases, which know no custom properties. */
export function readColor(element: Element, expression: string): string {
  const probe = element.appendChild(document.createElement('span'));
  probe.style.color = expression;
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color;
}
