// Draws a maze and the trajectory through it.
import { numbered, tagOf } from '../../keys/tags';
import type { Label, Scene } from '../../player/scene';
import type { Stretch } from '../../player/tape';
import { isDoor, isLava, parseCell, type Cell, type Maze } from './geometry';
import type { Place } from './hit';
import { AGENT, around, endMark, labelRect, wayOf, type Rect } from './marks';
import type { Palette } from './palette';
import type { Stroke } from './stroke';
import { placeTags } from './tags';
import { lanesOf, type Lane, type Point } from './trails';

export interface Picture {
  readonly scene: Scene;
  readonly maze: Maze;
  readonly palette: Palette;
  readonly size: number; // CSS pixels
  readonly places: readonly Place[]; // where a subgoal of the current segment can be chosen
  readonly stroke: Stroke; // what the annotator is drawing
}

const LEAST_PLACE = 11; // CSS pixels: with its edge, the box is a target of 24
const LEAST_TEXT = 10; // CSS pixels: smaller letters cannot be read, so on a phone the tags are larger than a third

type Brush = CanvasRenderingContext2D;

/** Draw everything. It takes a few hundred strokes, much less than the time of a frame. */
export function drawMaze(brush: Brush, picture: Picture): void {
  brush.clearRect(0, 0, picture.size, picture.size);
  drawCells(brush, picture);
  drawTarget(brush, picture);
  const lanes = lanesOf(picture.scene.tape.frames.map(parseCell));
  for (const stretch of inFront(picture.scene)) drawTrail(brush, picture, stretch, lanes);
  for (const place of picture.places) drawPlace(brush, picture, place);
  for (const label of picture.scene.labels) drawLabel(brush, picture, label);
  drawTags(brush, picture);
  drawStroke(brush, picture);
  drawAgent(brush, picture);
  drawEnd(brush, picture);
}

function drawCells(brush: Brush, picture: Picture): void {
  const { maze, palette, size } = picture;
  const unit = size / maze.rows.length;
  maze.rows.forEach((cells, row) => {
    for (let column = 0; column < cells.length; column++) {
      const cell: Cell = [row, column];
      const edges = [column, row, column + 1, row + 1].map((edge) => Math.round(edge * unit));
      const [left = 0, top = 0, right = 0, bottom = 0] = edges;
      const lava = isLava(maze, cell);
      brush.fillStyle = lava ? palette.map.lava : isDoor(maze, cell) ? palette.map.door : palette.map.floor;
      brush.fillRect(left, top, right - left, bottom - top);
      if (lava) continue;
      if (isDoor(maze, cell)) drawFrame(brush, picture, cell);
      brush.strokeStyle = palette.map.grid;
      brush.lineWidth = 1;
      brush.strokeRect(left + 0.5, top + 0.5, right - left - 1, bottom - top - 1);
    }
  });
}

/** Draw the two posts of a door, on the sides where the wall goes on. */
function drawFrame(brush: Brush, picture: Picture, [row, column]: Cell): void {
  const { maze, palette } = picture;
  const unit = unitOf(picture);
  const post = unit * 0.14;
  const [x, y] = [column * unit, row * unit];
  brush.fillStyle = palette.map['door-frame'];
  if (isLava(maze, [row, column - 1]) && isLava(maze, [row, column + 1])) {
    for (const left of [x, x + unit - post]) brush.fillRect(left, y, post, unit);
  } else {
    for (const top of [y, y + unit - post]) brush.fillRect(x, top, unit, post);
  }
}

function drawTarget(brush: Brush, picture: Picture): void {
  const { maze, palette } = picture;
  const unit = unitOf(picture);
  const [x, y] = centre(picture, maze.goal);
  brush.strokeStyle = palette.map.target;
  brush.lineWidth = unit * 0.1;
  for (const radius of [0.38, 0.2]) {
    brush.beginPath();
    brush.arc(x, y, unit * radius, 0, 2 * Math.PI);
    brush.stroke();
  }
}

/** Draw the path of a segment: thick up to the current frame, thin after it. Segments other than the current one fade. */
function drawTrail(brush: Brush, picture: Picture, stretch: Stretch, lanes: readonly (Lane | null)[]): void {
  const { scene } = picture;
  const unit = unitOf(picture);
  brush.strokeStyle = brush.fillStyle = colorOf(picture, stretch);
  brush.lineCap = brush.lineJoin = 'round';
  const seen = Math.min(stretch.last, Math.max(stretch.first, scene.at));
  const [past, ahead] = strengthOf(scene, stretch);
  brush.globalAlpha = past;
  strokeLanes(brush, unit, lanes.slice(Math.max(0, stretch.first - 1), seen), stretch.first > 0, unit * 0.13);
  brush.globalAlpha = ahead;
  strokeLanes(brush, unit, lanes.slice(Math.max(0, seen - 1), stretch.last), seen > 0, unit * 0.06);
  for (const lane of lanes.slice(stretch.first, stretch.last)) {
    if (lane === null) continue;
    const [row, column] = [(lane.from[0] + lane.to[0]) / 2, (lane.from[1] + lane.to[1]) / 2];
    fillTriangle(brush, [column * unit, row * unit], lane.way, unit * 0.17);
  }
  brush.globalAlpha = 1;
}

/** Return how strongly a segment is drawn up to the current frame, and after it. The current one stands out, if any. */
function strengthOf(scene: Scene, stretch: Stretch): readonly [past: number, ahead: number] {
  if (stretch.failed) return [0.75, 0.65];
  if (!stretch.asked) return [0.35, 0.3];
  return stretch.index === scene.current || scene.current === null ? [1, 0.85] : [0.5, 0.6];
}

/** Stroke a part of the way. If `joined`, the first lane was drawn before, and the part begins where it ends. */
function strokeLanes(
  brush: Brush,
  unit: number,
  lanes: readonly (Lane | null)[],
  joined: boolean,
  width: number,
): void {
  const points = lanes.flatMap((lane, place): Point[] => {
    if (lane === null) return [];
    return joined && place === 0 ? [lane.to] : [lane.from, lane.to];
  });
  if (points.length < 2) return;
  brush.lineWidth = width;
  brush.beginPath();
  for (const [row, column] of points) brush.lineTo(column * unit, row * unit);
  brush.stroke();
}

function fillTriangle(brush: Brush, [x, y]: readonly [number, number], [dy, dx]: Cell, size: number): void {
  brush.beginPath();
  brush.moveTo(x + dx * size, y + dy * size);
  brush.lineTo(x - dx * size * 0.7 - dy * size, y - dy * size * 0.7 + dx * size);
  brush.lineTo(x - dx * size * 0.7 + dy * size, y - dy * size * 0.7 - dx * size);
  brush.closePath();
  brush.fill();
}

/** Draw where the trajectory ended, smaller where the agent is. */
function drawEnd(brush: Brush, picture: Picture): void {
  const { maze, palette, scene } = picture;
  const last = scene.tape.frames.length - 1;
  const cell = cellAt(picture, last);
  const mark = endMark(scene, maze);
  if (cell === null || mark === null) return;
  const unit = unitOf(picture);
  const [x, y] = centre(picture, cell);
  const isHere = scene.at === last;
  brush.beginPath();
  if (mark === 'cross') {
    const arm = unit * (isHere ? 0.12 : 0.22);
    for (const side of [-1, 1]) {
      brush.moveTo(x - arm, y - arm * side);
      brush.lineTo(x + arm, y + arm * side);
    }
    brush.strokeStyle = isHere ? palette.map['agent-edge'] : palette.map.burnt;
  } else {
    brush.arc(x, y, unit * 0.22, 0, 2 * Math.PI);
    brush.strokeStyle = palette.map.agent;
  }
  brush.lineWidth = unit * 0.09;
  brush.stroke();
}

/** Return the stretches with the current one last, so that no other covers its trail and its marker. */
function inFront({ tape, current }: Scene): Stretch[] {
  return tape.stretches.toSorted((a, b) => Number(a.index === current) - Number(b.index === current));
}

/** Draw where subgoals were chosen, beside their cells; the current one in front. */
function drawTags(brush: Brush, picture: Picture): void {
  const { scene, maze } = picture;
  const unit = unitOf(picture);
  const letters = Math.max(Math.round(unit * 0.34), LEAST_TEXT);
  brush.font = fontOf(letters);
  const tagged = scene.tape.stretches.flatMap((stretch) => {
    const cell = cellAt(picture, stretch.first);
    if (cell === null || stretch.subgoal === null) return [];
    const tag = tagOf(stretch.subgoal, scene.vocabulary.subgoals);
    const text = numbered(stretch.index + 1, tag) + (stretch.failed ? '✗' : '');
    const width = Math.max(unit * 0.56, brush.measureText(text).width + letters * 0.5);
    return [{ stretch, text, cell, size: [(letters * 1.4) / unit, width / unit] as const }];
  });
  const labels = scene.labels.flatMap((label) => {
    const cell = cellAt(picture, label.frame);
    return cell === null ? [] : [labelRect(cell, label)];
  });
  const others = [...labels, ...picture.places.map((place) => placeRect(picture, place))];
  const rects = placeTags(tagged, { agent: cellAt(picture, scene.at), others, cells: maze.rows.length });
  const drawn = tagged.map((tag, index) => ({ ...tag, rect: rects[index] }));
  const isCurrent = ({ stretch }: { stretch: Stretch }): boolean => stretch.index === scene.current;
  for (const { rect, ...tag } of drawn.toSorted((a, b) => Number(isCurrent(a)) - Number(isCurrent(b)))) {
    if (rect !== undefined) drawTag(brush, picture, tag, rect);
  }
}

/** Draw where a subgoal was chosen: its number and tag. */
function drawTag(
  brush: Brush,
  picture: Picture,
  { stretch, text }: { stretch: Stretch; text: string },
  rect: Rect,
): void {
  const { palette, scene } = picture;
  const unit = unitOf(picture);
  const [left, top] = [rect.left * unit, rect.top * unit];
  const [width, height] = [(rect.right - rect.left) * unit, (rect.bottom - rect.top) * unit];
  brush.globalAlpha = stretch.asked || stretch.failed ? 1 : 0.55;
  brush.fillStyle = colorOf(picture, stretch);
  brush.beginPath();
  brush.roundRect(left, top, width, height, unit * 0.14);
  brush.fill();
  if (scene.current === stretch.index) {
    brush.strokeStyle = palette.map.agent;
    brush.lineWidth = unit * 0.09;
    brush.stroke();
  }
  brush.fillStyle = palette.map['marker-text'];
  brush.textAlign = 'center';
  brush.textBaseline = 'middle';
  brush.fillText(text, left + width / 2, top + height / 2 + unit * 0.02);
  brush.globalAlpha = 1;
}

/** Draw a label: an arrow, a diamond for the target, a square where the segment should have ended. */
function drawLabel(brush: Brush, picture: Picture, label: Label): void {
  const cell = cellAt(picture, label.frame);
  if (cell === null) return;
  const { palette } = picture;
  const unit = unitOf(picture);
  const corners = cornersOf(label, labelRect(cell, label));
  brush.beginPath();
  for (const [row, column] of corners) brush.lineTo(column * unit, row * unit);
  brush.closePath();
  brush.lineJoin = 'miter';
  brush.strokeStyle = palette.map['label-edge'];
  brush.lineWidth = unit * 0.12; // half of it is outside
  brush.stroke();
  brush.fillStyle = palette.map.label;
  brush.fill();
}

/** Return the corners of a label's shape in its rectangle. */
function cornersOf(label: Label, { top, left, bottom, right }: Rect): Point[] {
  const [row, column] = [(top + bottom) / 2, (left + right) / 2];
  const all: Point[] = [[top, left], [top, right], [bottom, right], [bottom, left]]; // prettier-ignore
  const tips: Point[] = [[top, column], [row, right], [bottom, column], [row, left]]; // prettier-ignore
  const way = wayOf(label);
  if (way === null) return label.name === null ? all : tips;
  const ahead = ([y, x]: Point): number => (y - row) * way[0] + (x - column) * way[1];
  return [...all.filter((corner) => ahead(corner) < 0), ...tips.filter((tip) => ahead(tip) > 0)];
}

/** Draw where a subgoal can be chosen: its tag in a box, filled if it is the label of the current segment. */
function drawPlace(brush: Brush, picture: Picture, place: Place): void {
  const { palette, scene } = picture;
  const { subgoal } = place;
  const unit = unitOf(picture);
  const { top, left, bottom, right } = placeRect(picture, place);
  const first = scene.tape.stretches[scene.current ?? -1]?.first;
  const isChosen = scene.labels.some((label) => label.frame === first && label.name === subgoal);
  const color = palette.subgoals[scene.vocabulary.subgoals.indexOf(subgoal) % palette.subgoals.length] ?? '';
  brush.beginPath();
  brush.roundRect(left * unit, top * unit, (right - left) * unit, (bottom - top) * unit, unit * 0.2);
  brush.fillStyle = isChosen ? color : palette.map.floor;
  brush.fill();
  brush.strokeStyle = color;
  brush.lineWidth = Math.max(unit * 0.09, 2);
  brush.stroke();
  brush.font = fontOf(Math.max(Math.round(unit * 0.45), LEAST_TEXT + 2));
  brush.fillStyle = isChosen ? palette.map['marker-text'] : color;
  brush.textAlign = 'center';
  brush.textBaseline = 'middle';
  const [x, y] = centre(picture, place.cell);
  brush.fillText(tagOf(subgoal, scene.vocabulary.subgoals), x, y + unit * 0.02);
}

function placeRect(picture: Picture, { cell: [row, column] }: Place): Rect {
  const side = 2 * Math.max(0.42, LEAST_PLACE / unitOf(picture));
  return around([row + 0.5, column + 0.5], [side, side]);
}

/** Draw the way that the annotator is drawing, with an arrow at its tip. */
function drawStroke(brush: Brush, picture: Picture): void {
  const { palette, stroke } = picture;
  const [before, tip] = stroke.slice(-2);
  if (before === undefined || tip === undefined) return;
  const unit = unitOf(picture);
  brush.lineCap = brush.lineJoin = 'round';
  for (const [color, width] of [
    [palette.map['label-edge'], 0.36],
    [palette.map.label, 0.22],
  ] as const) {
    brush.strokeStyle = brush.fillStyle = color;
    brush.lineWidth = unit * width;
    brush.beginPath();
    for (const cell of stroke) brush.lineTo(...centre(picture, cell));
    brush.stroke();
    fillTriangle(brush, centre(picture, tip), [tip[0] - before[0], tip[1] - before[1]], unit * (width + 0.1));
  }
}

function drawAgent(brush: Brush, picture: Picture): void {
  const cell = cellAt(picture, picture.scene.at);
  if (cell === null) return;
  const { palette } = picture;
  const unit = unitOf(picture);
  for (const [color, radius] of [
    [palette.map['agent-edge'], AGENT],
    [palette.map.agent, AGENT - 0.07],
  ] as const) {
    brush.beginPath();
    brush.arc(...centre(picture, cell), unit * radius, 0, 2 * Math.PI);
    brush.fillStyle = color;
    brush.fill();
  }
}

function colorOf({ scene, palette }: Picture, stretch: Stretch): string {
  const index = stretch.subgoal === null ? 0 : scene.vocabulary.subgoals.indexOf(stretch.subgoal);
  return palette.subgoals[Math.max(0, index) % palette.subgoals.length] ?? palette.map.agent;
}

function cellAt({ scene }: Picture, frame: number): Cell | null {
  return parseCell(scene.tape.frames[frame]);
}

function centre(picture: Picture, [row, column]: Cell): [x: number, y: number] {
  const unit = unitOf(picture);
  return [(column + 0.5) * unit, (row + 0.5) * unit];
}

function fontOf(pixels: number): string {
  // eslint-disable-next-line waypost/untranslated -- a font
  return `700 ${pixels}px system-ui, sans-serif`;
}

function unitOf({ maze, size }: Picture): number {
  return size / maze.rows.length;
}
