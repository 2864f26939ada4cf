// SPDX-License-Identifier: Apache-2.0
// What has been drawn: strokes of {colour (palette.js), width_mm, points: [{x_mm, y_mm}]}, with undo and redo. Whatever draws (a
// finger, a mouse, the keys) has an id of its own; each draws one stroke at a time, at the same time as the others.
const LEAST_STEP_MM = 0.2;  // a finger that rests adds nothing
const MOST_UNDONE = 200;

const isPlace = (point) => Number.isFinite(point?.x_mm) && Number.isFinite(point?.y_mm);

export class Drawing {
  #strokes = [];  // never changed, only replaced, so that it can be gone back to
  #open = new Map();
  #past = [];
  #future = [];

  begin(id, point, {colour, width_mm}) {
    this.end(id);
    if (isPlace(point)) this.#open.set(id, {colour, width_mm, points: [{x_mm: point.x_mm, y_mm: point.y_mm}]});
  }

  extend(id, point) {
    const points = this.#open.get(id)?.points;
    if (!points || !isPlace(point)) return;
    const last = points[points.length - 1];
    if (Math.hypot(point.x_mm - last.x_mm, point.y_mm - last.y_mm) < LEAST_STEP_MM) return;
    points.push({x_mm: point.x_mm, y_mm: point.y_mm});
  }

  end(id) {
    const stroke = this.#open.get(id);
    if (!stroke) return;
    this.#open.delete(id);
    this.#become([...this.#strokes, stroke]);
  }

  endAll() {
    for (const id of [...this.#open.keys()]) this.end(id);
  }

  // Can be undone.
  clear() {
    this.endAll();
    if (this.#strokes.length > 0) this.#become([]);
  }

  undo() {
    this.endAll();
    if (this.canUndo) this.#turn(this.#past, this.#future);
  }

  redo() {
    this.endAll();
    if (this.canRedo) this.#turn(this.#future, this.#past);
  }

  get canUndo() { return this.#past.length > 0; }
  get canRedo() { return this.#future.length > 0; }
  // Those that are finished: the same array until it changes.
  get finished() { return this.#strokes; }
  get growing() { return [...this.#open.values()]; }
  get strokes() { return [...this.#strokes, ...this.#open.values()]; }

  #become(strokes) {
    this.#past.push(this.#strokes);
    if (this.#past.length > MOST_UNDONE) this.#past.shift();
    this.#future = [];
    this.#strokes = strokes;
  }

  #turn(from, to) {
    to.push(this.#strokes);
    this.#strokes = from.pop();
  }
}
