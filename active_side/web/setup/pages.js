// SPDX-License-Identifier: Apache-2.0
// What the whole screen shows in a set-up, to a sixteenth of a device pixel: the camera measures where it is.

const SIXTEENTH = 16;

// How much of a pixel a disc covers, by its distance from the middle: straight edges are exact, and so nearly are those
// of discs that are as large as these.
const coverage = (radius, distance) => Math.min(1, Math.max(0, radius - distance + 0.5));

const onGrid = (px) => Math.round(px * SIXTEENTH) / SIXTEENTH;

// White on black, as drawn by setup/page_pictures.cpp: the screen's edge lies half a pixel before the middle of pixel 0.
function drawDot(context, x, y, radius) {
  const left = Math.max(0, Math.floor(x - radius - 1));
  const top = Math.max(0, Math.floor(y - radius - 1));
  const right = Math.min(context.canvas.width, Math.ceil(x + radius + 2));
  const bottom = Math.min(context.canvas.height, Math.ceil(y + radius + 2));
  if (right <= left || bottom <= top) return;
  const picture = context.createImageData(right - left, bottom - top);
  for (let row = top; row < bottom; ++row) {
    for (let column = left; column < right; ++column) {
      const at = 4 * ((row - top) * (right - left) + column - left);
      const level = Math.round(255 * coverage(radius, Math.hypot(column - x, row - y)));
      picture.data.set([level, level, level, 255], at);
    }
  }
  context.putImageData(picture, left, top);
}

function fill(context, colour) {
  context.fillStyle = colour;
  context.fillRect(0, 0, context.canvas.width, context.canvas.height);
}

function drawTriangle(context, corners, perMm) {
  fill(context, "#ffffff");
  context.fillStyle = "#000000";
  context.beginPath();
  for (const [x, y] of corners) context.lineTo(x * perMm.x, y * perMm.y);
  context.closePath();
  context.fill();
}

// `show`: of the topic "setup". The canvas has the screen's own pixels.
export function drawShown(canvas, show) {
  const context = canvas.getContext("2d", {alpha: false});
  const perMm = {x: canvas.width / show.width_mm, y: canvas.height / show.height_mm};
  if (show.page === "triangle") {
    drawTriangle(context, show.triangle, perMm);
    return;
  }
  fill(context, "#000000");
  const radius = onGrid(show.dot_mm / 2 * perMm.x);
  for (const [x, y] of show.dots) drawDot(context, onGrid(x * perMm.x - 0.5), onGrid(y * perMm.y - 0.5), radius);
}
