// SPDX-License-Identifier: Apache-2.0
// A word as a finger writes it, and how far what a page drew is from it. Places in mm of the screen: [x, y].

const SPEED_MM_S = 200;  // people write on a wall with 150 to 250
const REST_S = 0.1;      // where a line begins and ends
const LIFT_MM = 25;
const LIFT_S = 0.15;
const STEP_MM = 2;

// From angle to angle, in degrees, 0 to the right, 90 down.
function arc([x, y], radius_mm, from, to) {
  return Array.from({length: 25}, (_, i) => {
    const angle = (from + (to - from) * i / 24) * Math.PI / 180;
    return [x + radius_mm * Math.cos(angle), y + radius_mm * Math.sin(angle)];
  });
}

// "HUG", its letters `high` mm high.
export function hug([x, y], high) {
  const r = 0.3 * high;
  const wide = 2 * r;
  const u = x + wide + 0.35 * high;
  const g = u + wide + 0.35 * high + r;
  return [
    [[x, y], [x, y + high]],
    [[x + wide, y], [x + wide, y + high]],
    [[x, y + high / 2], [x + wide, y + high / 2]],
    [[u, y], ...arc([u + r, y + high - r], r, 180, 0), [u + wide, y]],
    [...arc([g, y + r], r, -40, -180), ...arc([g, y + high - r], r, 180, 0), [g + r, y + high / 2], [g, y + high / 2]],
  ];
}

const distance = ([ax, ay], [bx, by]) => Math.hypot(ax - bx, ay - by);

// Rows of hand.csv for a finger that draws these lines, and how long it takes.
export function writing(lines, begin_s = 0.5) {
  let t = begin_s;
  const rows = [[t - 0.3, ...lines[0][0], 120]];
  for (const line of lines) {
    rows.push([t, ...line[0], LIFT_MM], [t += LIFT_S, ...line[0], 0], [t += REST_S, ...line[0], 0]);
    for (let i = 1; i < line.length; ++i)
      if (distance(line[i - 1], line[i]) > 0) rows.push([t += distance(line[i - 1], line[i]) / SPEED_MM_S, ...line[i], 0]);
    rows.push([t += REST_S, ...line.at(-1), 0], [t += LIFT_S, ...line.at(-1), LIFT_MM]);
    t += 0.2;
  }
  rows.push([t, ...lines.at(-1).at(-1), 120]);
  return {rows: rows.map((row) => row.map((value) => Number(value.toFixed(3)))), seconds: t};
}

// Points along a line, evenly.
function along(line) {
  const points = [line[0]];
  for (let i = 1; i < line.length; ++i) {
    const steps = Math.max(1, Math.round(distance(line[i - 1], line[i]) / STEP_MM));
    for (let k = 1; k <= steps; ++k)
      points.push([0, 1].map((axis) => line[i - 1][axis] + (line[i][axis] - line[i - 1][axis]) * k / steps));
  }
  return points;
}

function toLine([px, py], line) {
  let least = distance([px, py], line[0]);
  for (let i = 1; i < line.length; ++i) {
    const [[ax, ay], [bx, by]] = [line[i - 1], line[i]];
    const length2 = (bx - ax) ** 2 + (by - ay) ** 2;
    const share = length2 === 0 ? 0 : Math.min(1, Math.max(0, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length2));
    least = Math.min(least, distance([px, py], [ax + share * (bx - ax), ay + share * (by - ay)]));
  }
  return least;
}

// How far two lines are apart, both ways: what was drawn wrongly, and what was not drawn.
export function deviations(drawn, written) {
  return [...along(drawn).map((point) => toLine(point, written)), ...along(written).map((point) => toLine(point, drawn))];
}

// The lines of an SVG of the page, in mm: its steps are M, L and Q.
export function linesOf(svg) {
  return [...svg.matchAll(/<path stroke="([^"]+)" stroke-width="([^"]+)" d="([^"]+)"/g)].map(([, colour, width, data]) => {
    const points = [];
    for (const [, step, numbers] of data.matchAll(/([MLQ])([^MLQ]+)/g)) {
      const values = numbers.split(" ").map(Number);
      if (step === "Q") {
        const [x, y] = points.at(-1);
        for (let i = 1; i < 8; ++i) {
          const t = i / 8;
          points.push([0, 1].map((axis) => (1 - t) ** 2 * [x, y][axis] + 2 * t * (1 - t) * values[axis] + t * t * values[2 + axis]));
        }
      }
      points.push(values.slice(-2));
    }
    return {colour, width_mm: Number(width), points};
  });
}
