// SPDX-License-Identifier: Apache-2.0
// The red dots: a grid in the middle of the screen, in mm from its top-left corner.
const LEAST_FROM_EDGE_MM = 10;
const FINGER_MM = 5;  // half as wide as a finger that touches

const along = (length_mm, spacing_mm) => {
  const steps = Math.max(0, Math.floor((length_mm - 2 * LEAST_FROM_EDGE_MM) / spacing_mm));
  return Array.from({length: steps + 1}, (_, i) => length_mm / 2 + (i - steps / 2) * spacing_mm);
};

// polygon: [[x, y], ...]
export function isInside([x, y], polygon) {
  let inside = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [xi, yi] = polygon[i];
    const [xj, yj] = polygon[j];
    if ((yi > y) !== (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi) inside = !inside;
  }
  return inside;
}

// All of a finger on the dot is where the camera sees touches.
function isReached({x_mm, y_mm}, reach_mm) {
  return [[-1, 0], [1, 0], [0, -1], [0, 1]].every(
      ([right, down]) => isInside([x_mm + right * FINGER_MM, y_mm + down * FINGER_MM], reach_mm));
}

// screen: {width_mm, height_mm, reach_mm}; without reach_mm all is reached. Returns {rows, columns, dots: [{row, column,
// x_mm, y_mm, reached}]}, rows and columns counted from 1. Every other row goes back, so that the hand never has far to go.
export function dotGrid({width_mm, height_mm, reach_mm}, spacing_mm) {
  const columns = along(width_mm, spacing_mm);
  const rows = along(height_mm, spacing_mm);
  const dots = rows.flatMap((y_mm, row) => {
    const line = columns.map((x_mm, column) => ({row: row + 1, column: column + 1, x_mm, y_mm}));
    return row % 2 === 0 ? line : line.reverse();
  });
  for (const dot of dots) dot.reached = !reach_mm || isReached(dot, reach_mm);
  return {rows: rows.length, columns: columns.length, dots};
}
