// Draws a maze and the trajectory through it.
import { initial } from '../../api/names';
import type { Label, Scene } from '../../player/scene';
import type { Stretch } from '../../player/tape';
import { direction, isDoor, isLava, MOVES, parseCell, trailOffset, type Cell, type Maze } from './geometry';
import type { Palette } from './palette';

export interface Picture {
  readonly scene: Scene;
  readonly maze: Maze;
  readonly palette: Palette;
  readonly size: number; // CSS pixels
}

type Brush = CanvasRenderingContext2D;

/** Draw everything. It takes a few hundred strokes, much less than the time of a frame. */
export function drawMaze(brush: Brush, picture: Picture): void {
  brush.clearRect(0, 0, picture.size, picture.size);
  drawCells(brush, picture);
  drawTarget(brush, picture);
  for (const stretch of picture.scene.tape.stretches) drawTrail(brush, picture, stretch);
  for (const label of picture.scene.labels) drawLabel(brush, picture, label);
  drawAgent(brush, picture);
  drawEnd(brush, picture);
  for (const stretch of inFront(picture.scene)) drawMarker(brush, picture, stretch);
}

function drawCells(brush: Brush, { maze, palette, size }: Picture): void {
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
      brush.strokeStyle = palette.map.grid;
      brush.lineWidth = 1;
      brush.strokeRect(left + 0.5, top + 0.5, right - left - 1, bottom - top - 1);
    }
  });
}

function drawTarget(brush: Brush, picture: Picture): void {
  const { maze, palette } = picture;
  const unit = unitOf(picture);
  const [x, y] = centre(picture, maze.goal, 0);
  brush.strokeStyle = palette.map.target;
  brush.lineWidth = unit * 0.1;
  for (const radius of [0.38, 0.2]) {
    brush.beginPath();
    brush.arc(x, y, unit * radius, 0, 2 * Math.PI);
    brush.stroke();
  }
}

/** Draw the path of a segment: thick up to the current frame, thin after it, faint if the query does not ask about it. */
function drawTrail(brush: Brush, picture: Picture, stretch: Stretch): void {
  const { scene } = picture;
  const unit = unitOf(picture);
  brush.strokeStyle = brush.fillStyle = colorOf(picture, stretch);
  brush.lineCap = brush.lineJoin = 'round';
  const seen = Math.min(stretch.last, Math.max(stretch.first, scene.at));
  brush.globalAlpha = stretch.asked ? 1 : 0.4;
  strokeFrames(brush, picture, stretch, stretch.first, seen, unit * 0.17);
  brush.globalAlpha = stretch.asked ? 0.75 : 0.3;
  strokeFrames(brush, picture, stretch, seen, stretch.last, unit * 0.07);
  for (let frame = stretch.first; frame < stretch.last; frame++)
    drawArrowhead(brush, picture, stretch, frame);
  brush.globalAlpha = 1;
}

function strokeFrames(
  brush: Brush,
  picture: Picture,
  stretch: Stretch,
  from: number,
  to: number,
  width: number,
): void {
  if (from >= to) return;
  brush.lineWidth = width;
  brush.beginPath();
  for (let frame = from; frame <= to; frame++) {
    const cell = cellAt(picture, frame);
    if (cell !== null) brush.lineTo(...centre(picture, cell, trailOffset(stretch.index)));
  }
  brush.stroke();
}

function drawArrowhead(brush: Brush, picture: Picture, stretch: Stretch, frame: number): void {
  const [from, to] = [cellAt(picture, frame), cellAt(picture, frame + 1)];
  const way = from && to && direction(from, to);
  if (!from || !to || !way) return;
  const unit = unitOf(picture);
  const [x0, y0] = centre(picture, from, trailOffset(stretch.index));
  const [x1, y1] = centre(picture, to, trailOffset(stretch.index));
  fillTriangle(brush, [(x0 + x1) / 2, (y0 + y1) / 2], way, unit * 0.19);
}

function fillTriangle(brush: Brush, [x, y]: readonly [number, number], [dy, dx]: Cell, size: number): void {
  brush.beginPath();
  brush.moveTo(x + dx * size, y + dy * size);
  brush.lineTo(x - dx * size * 0.7 - dy * size, y - dy * size * 0.7 + dx * size);
  brush.lineTo(x - dx * size * 0.7 + dy * size, y - dy * size * 0.7 - dx * size);
  brush.closePath();
  brush.fill();
}

/** Draw where the trajectory ended: a cross in lava, a ring elsewhere, smaller where the agent is. */
function drawEnd(brush: Brush, picture: Picture): void {
  const { maze, palette, scene } = picture;
  const last = scene.tape.frames.length - 1;
  const cell = cellAt(picture, last);
  if (cell === null) return;
  const unit = unitOf(picture);
  const [x, y] = centre(picture, cell, 0);
  const isHere = scene.at === last;
  brush.beginPath();
  if (isLava(maze, cell)) {
    const arm = unit * (isHere ? 0.12 : 0.22);
    for (const side of [-1, 1]) {
      brush.moveTo(x - arm, y - arm * side);
      brush.lineTo(x + arm, y + arm * side);
    }
    brush.strokeStyle = isHere ? palette.map['agent-edge'] : palette.map.burnt;
  } else {
    if (!isHere) brush.arc(x, y, unit * 0.22, 0, 2 * Math.PI);
    brush.strokeStyle = palette.map.agent;
  }
  brush.lineWidth = unit * 0.09;
  brush.stroke();
}

/** Return the stretches with the current one last, so that no other marker covers its marker. */
function inFront({ tape, current }: Scene): Stretch[] {
  return tape.stretches.toSorted((a, b) => Number(a.index === current) - Number(b.index === current));
}

/** Draw where a subgoal was chosen: its number and letter, at the corner of the cell. */
function drawMarker(brush: Brush, picture: Picture, stretch: Stretch): void {
  const cell = cellAt(picture, stretch.first);
  if (cell === null || stretch.subgoal === null) return;
  const { palette, scene } = picture;
  const unit = unitOf(picture);
  const [x, y] = centre(picture, cell, -0.36);
  const text = `${stretch.index + 1}${initial(stretch.subgoal)}`;
  const isCurrent = scene.current === stretch.index;
  brush.font = `700 ${Math.round(unit * 0.34)}px system-ui, sans-serif`;
  const width = Math.max(unit * 0.56, brush.measureText(text).width + unit * 0.18);
  const height = unit * 0.48;
  brush.globalAlpha = stretch.asked ? 1 : 0.55;
  brush.fillStyle = colorOf(picture, stretch);
  brush.beginPath();
  brush.roundRect(x - width / 2, y - height / 2, width, height, unit * 0.14);
  brush.fill();
  if (isCurrent) {
    brush.strokeStyle = palette.map.agent;
    brush.lineWidth = unit * 0.09;
    brush.stroke();
  }
  brush.fillStyle = palette.map['marker-text'];
  brush.textAlign = 'center';
  brush.textBaseline = 'middle';
  brush.fillText(text, x, y + unit * 0.02);
  brush.globalAlpha = 1;
}

/** Draw a label: an arrow out of its state, or a square where the segment should have ended. */
function drawLabel(brush: Brush, picture: Picture, label: Label): void {
  const cell = cellAt(picture, label.frame);
  if (cell === null) return;
  const { palette } = picture;
  const unit = unitOf(picture);
  const [x, y] = centre(picture, cell, 0);
  const way = label.action === null ? null : MOVES[label.action];
  brush.fillStyle = palette.map.label;
  brush.strokeStyle = palette.map['label-edge'];
  brush.lineWidth = unit * 0.06;
  if (way) {
    fillTriangle(brush, [x + way[1] * unit * 0.24, y + way[0] * unit * 0.24], way, unit * 0.2);
  } else if (label.action === null) {
    brush.fillRect(x - unit * 0.2, y - unit * 0.2, unit * 0.4, unit * 0.4);
  }
  brush.stroke();
}

function drawAgent(brush: Brush, picture: Picture): void {
  const cell = cellAt(picture, picture.scene.at);
  if (cell === null) return;
  const unit = unitOf(picture);
  brush.beginPath();
  brush.arc(...centre(picture, cell, 0), unit * 0.28, 0, 2 * Math.PI);
  brush.fillStyle = picture.palette.map.agent;
  brush.fill();
  brush.strokeStyle = picture.palette.map['agent-edge'];
  brush.lineWidth = unit * 0.1;
  brush.stroke();
}

function colorOf({ scene, palette }: Picture, stretch: Stretch): string {
  const index = stretch.subgoal === null ? 0 : scene.vocabulary.subgoals.indexOf(stretch.subgoal);
  return palette.subgoals[Math.max(0, index) % palette.subgoals.length] ?? palette.map.agent;
}

function cellAt({ scene }: Picture, frame: number): Cell | null {
  return parseCell(scene.tape.frames[frame]);
}

function centre(picture: Picture, cell: Cell, offset: number): [x: number, y: number] {
  const unit = unitOf(picture);
  return [(cell[1] + 0.5 + offset) * unit, (cell[0] + 0.5 + offset) * unit];
}

function unitOf({ maze, size }: Picture): number {
  return size / maze.rows.length;
}
