// SPDX-License-Identifier: Apache-2.0
// Strokes on paper, once a picture of the screen at the most. Finished ones are kept as a picture of their own, so that
// the time for one more point does not grow with the drawing.
import {smoothPath, tracePath} from "./smooth_path.js";

const REACH_COLOUR = "#6b7688";  // 3:1 from either paper

// map: x_px_per_mm, y_px_per_mm, left_px, top_px of screen_map.js. scale: pixels of the context to a pixel of the map.
export function drawStrokes(context, strokes, map, scale, colours) {
  context.setTransform(scale * map.x_px_per_mm, 0, 0, scale * map.y_px_per_mm, scale * map.left_px, scale * map.top_px);
  context.lineCap = context.lineJoin = "round";
  for (const {colour, width_mm, points} of strokes) {
    context.strokeStyle = colours[colour];
    context.lineWidth = width_mm;
    context.beginPath();
    tracePath(context, smoothPath(points));
    context.stroke();
  }
  context.setTransform(1, 0, 0, 1, 0, 0);
}

// Within this line of {x_mm, y_mm} the camera sees fingers.
function drawReach(context, outline, map, scale) {
  context.setTransform(scale, 0, 0, scale, 0, 0);
  context.strokeStyle = REACH_COLOUR;
  context.lineWidth = 1.5;
  context.setLineDash([6, 6]);
  context.beginPath();
  for (const {x, y} of outline.map(map.toPage)) context.lineTo(x, y);
  context.closePath();
  context.stroke();
  context.setLineDash([]);
  context.setTransform(1, 0, 0, 1, 0, 0);
}

export class StrokeCanvas {
  #canvas;
  #drawing;
  #map;
  #palette;
  #reach;
  #kept = document.createElement("canvas");
  #keptStrokes = null;  // that are on it
  #waits = false;

  constructor(canvas, drawing) {
    this.#canvas = canvas;
    this.#drawing = drawing;
  }

  // Also after the window's size or any of these has changed. reach: where the camera sees fingers, [{x_mm, y_mm}]; empty if
  // that is not known.
  show(map, palette, reach) {
    this.#map = map;
    this.#palette = palette;
    this.#reach = reach;
    const {width, height} = this.#canvas.getBoundingClientRect();
    for (const canvas of [this.#canvas, this.#kept]) {
      canvas.width = Math.round(width * devicePixelRatio);
      canvas.height = Math.round(height * devicePixelRatio);
    }
    this.#keptStrokes = null;
    this.refresh();
  }

  refresh() {
    if (this.#waits) return;
    this.#waits = true;
    requestAnimationFrame(() => {
      this.#waits = false;
      this.#draw();
    });
  }

  #draw() {
    const {finished, growing} = this.#drawing;
    if (finished !== this.#keptStrokes) this.#keep(finished);
    const context = this.#canvas.getContext("2d");
    // The canvas' own background would not do: Chromium keeps showing the one before.
    context.fillStyle = this.#palette.paper;
    context.fillRect(0, 0, this.#canvas.width, this.#canvas.height);
    drawReach(context, this.#reach, this.#map, devicePixelRatio);
    if (this.#kept.width > 0 && this.#kept.height > 0) context.drawImage(this.#kept, 0, 0);
    drawStrokes(context, growing, this.#map, devicePixelRatio, this.#palette.colours);
  }

  // Most often there is one stroke more than before.
  #keep(finished) {
    const before = this.#keptStrokes;
    const grown = before !== null && before.every((stroke, i) => stroke === finished[i]);
    const context = this.#kept.getContext("2d");
    if (!grown) context.clearRect(0, 0, this.#kept.width, this.#kept.height);
    const fresh = grown ? finished.slice(before.length) : finished;
    drawStrokes(context, fresh, this.#map, devicePixelRatio, this.#palette.colours);
    this.#keptStrokes = finished;
  }
}
