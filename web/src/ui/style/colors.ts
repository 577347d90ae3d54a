// Reads the colors of the style sheet, for canvases.
/** Return the computed value of a CSS color in the current theme. Canvases do not understand custom properties. */
export function readColor(element: Element, expression: string): string {
  const sample = element.appendChild(document.createElement('span'));
  sample.style.color = expression;
  const { color } = getComputedStyle(sample);
  sample.remove();
  return color;
}
