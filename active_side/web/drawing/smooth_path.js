// SPDX-License-Identifier: Apache-2.0
// A smooth line through points: quadratic curves from the middle of one piece to the middle of the next, with the points
// between as their controls. Its end is the newest point itself, so the line lags behind nothing. Points are {x_mm, y_mm}.

// Steps as SVG has them: ["M", x, y], ["L", x, y], ["Q", control x, control y, x, y].
export function smoothPath(points) {
  if (points.length === 0) return [];
  const [first] = points;
  const last = points[points.length - 1];
  const steps = [["M", first.x_mm, first.y_mm]];
  for (let i = 1; i + 1 < points.length; ++i) {
    const {x_mm, y_mm} = points[i];
    const next = points[i + 1];
    steps.push(["Q", x_mm, y_mm, (x_mm + next.x_mm) / 2, (y_mm + next.y_mm) / 2]);
  }
  // A line of no length would not be drawn; its round ends make a dot of a very short one.
  steps.push(["L", points.length > 1 ? last.x_mm : last.x_mm + 0.01, last.y_mm]);
  return steps;
}

// Onto a canvas' context, or another thing with its moveTo, lineTo, quadraticCurveTo.
export function tracePath(context, steps) {
  const draw = {M: "moveTo", L: "lineTo", Q: "quadraticCurveTo"};
  for (const [step, ...numbers] of steps) context[draw[step]](...numbers);
}

// As the d of an SVG path.
export function pathData(steps) {
  return steps.map(([step, ...numbers]) => step + numbers.map((number) => number.toFixed(2)).join(" ")).join("");
}
