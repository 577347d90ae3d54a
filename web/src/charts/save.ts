// Charts as files: SVG and PNG as they are on the screen, and their numbers as CSV.
import { toCsv } from './csv';
import type { Series } from './chart';

/** The styles that are written into a saved SVG, which has no style sheet. */
const STYLES = [
  'fill',
  'fill-opacity',
  'stroke',
  'stroke-width',
  'stroke-dasharray',
  'stroke-linejoin',
  'paint-order',
  'font-family',
  'font-size',
  'font-weight',
  'text-anchor',
] as const;
const NAMESPACE = 'http://www.w3.org/2000/svg';
const HEAD = 44; // pixels above the chart, for its title
const MARGIN = 12;
const PIXELS = 2; // per pixel of the screen

export interface Heading {
  readonly title: string;
  readonly about: string;
}

/** Return a drawn chart as an SVG document that looks the same without a style sheet. */
export function svgDocument(drawn: SVGSVGElement, { title, about }: Heading): string {
  const { width, height } = sizeOf(drawn);
  const copy = drawn.cloneNode(true) as SVGSVGElement;
  const originals = [drawn, ...drawn.querySelectorAll('*')];
  [copy, ...copy.querySelectorAll('*')].forEach((element, index) => {
    const original = originals[index];
    if (original !== undefined) inline(element, getComputedStyle(original));
  });
  for (const passing of copy.querySelectorAll('[data-passing]')) passing.remove();
  const sheet = document.createElementNS(NAMESPACE, 'svg');
  const [wide, high] = [width + 2 * MARGIN, height + HEAD + MARGIN];
  set(sheet, { width: wide, height: high, viewBox: `0 0 ${wide} ${high}` });
  const style = getComputedStyle(drawn);
  const words = { x: MARGIN + 4, 'font-family': style.fontFamily };
  sheet.append(
    made('rect', { width: wide, height: high, fill: style.backgroundColor }),
    made('text', { ...words, y: 20, 'font-size': 14, 'font-weight': 650, fill: style.color }, title),
    made('text', { ...words, y: 37, 'font-size': 12, fill: style.color }, about),
  );
  set(copy, { x: MARGIN, y: HEAD, width, height });
  sheet.append(copy);
  // eslint-disable-next-line waypost/untranslated -- XML
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(sheet)}\n`;
}

export function saveSvg(drawn: SVGSVGElement, heading: Heading): void {
  saveAs(new Blob([svgDocument(drawn, heading)], { type: 'image/svg+xml' }), nameOf(heading, 'svg'));
}

/** Save the same picture as a PNG, with two pixels per pixel of the screen. */
export async function savePng(drawn: SVGSVGElement, heading: Heading): Promise<void> {
  const blob = new Blob([svgDocument(drawn, heading)], { type: 'image/svg+xml' });
  const address = URL.createObjectURL(blob);
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.naturalWidth * PIXELS, image.naturalHeight * PIXELS];
    canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
    const png = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
    if (png !== null) saveAs(png, nameOf(heading, 'png'));
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** Save the values as CSV: a row per series and value, with the range if there is one. */
export function saveCsv(series: readonly Series[], xName: string, heading: Heading): void {
  const rows = series.flatMap((one) =>
    one.x.map((x, row) => [one.label, x, one.y[row] ?? null, ...ranged(one, row)]),
  );
  const text = toCsv([['series', xName, 'value', 'low', 'high'], ...rows]);
  saveAs(new Blob([text], { type: 'text/csv' }), nameOf(heading, 'csv'));
}

function ranged(series: Series, row: number): (number | null)[] {
  return series.filled === 'soft' ? [series.low?.[row] ?? null, series.high?.[row] ?? null] : [null, null];
}

function inline(element: Element, style: CSSStyleDeclaration): void {
  element.removeAttribute('class');
  element.removeAttribute('style');
  for (const name of STYLES) element.setAttribute(name, style.getPropertyValue(name));
  if (element.childElementCount === 0 && element.textContent)
    element.textContent = legal(element.textContent);
}

function sizeOf(drawn: SVGSVGElement): { width: number; height: number } {
  const { width, height } = drawn.getBoundingClientRect();
  return { width: Math.round(width), height: Math.round(height) };
}

function made(name: string, attributes: Record<string, string | number>, text = ''): SVGElement {
  const element = document.createElementNS(NAMESPACE, name);
  set(element, attributes);
  element.textContent = legal(text);
  return element;
}

function set(element: Element, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
}

/** Return a text without the characters that XML does not allow. */
function legal(text: string): string {
  // eslint-disable-next-line no-control-regex -- control characters are what it removes
  return text.toWellFormed().replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, '\ufffd');
}

function nameOf({ title, about }: Heading, ending: string): string {
  const words = `${about} ${title}`.toLowerCase().replace(/[^\p{L}\p{N}]+/gu, '-');
  return `${words.replace(/^-|-$/g, '').slice(0, 80) || 'chart'}.${ending}`;
}

function saveAs(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
