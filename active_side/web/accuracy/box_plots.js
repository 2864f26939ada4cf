// SPDX-License-Identifier: Apache-2.0
// Lying box plots below each other, as SVG. Colours come from results.css.
import {boxPlot} from "./statistics.js";

const WIDTH = 520;
const LEFT = 110;
const RIGHT = WIDTH - 24;
const TOP = 30;
const ROW = 22;
const HALF = 6.5;

// Half of an axis that holds the boxes of all of these with their whiskers: a round number, 1 mm at least.
export function axisFor(groups) {
  const most = Math.max(0, ...groups.map(({values}) => boxPlot(values)).flatMap(({low, high}) => [-low, high]));
  return [1, 2, 3, 4, 5, 6, 8, 10, 15, 20, 30, 50].find((end) => end >= most) ?? Math.ceil(most / 100) * 100;
}

const line = (kind, x1, y1, x2, y2) =>
    `<line class="${kind}" x1="${x1.toFixed(1)}" y1="${y1.toFixed(1)}" x2="${x2.toFixed(1)}" y2="${y2.toFixed(1)}"/>`;
const label = (x, y, anchor, content) =>
    `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}">${content}</text>`;

function axis(end, at, bottom, words) {
  return [-1, -0.5, 0, 0.5, 1].map((part) => {
    const x = at(part * end);
    const value = words.signed(part * end, Number.isInteger(end / 2) ? 0 : 1);
    return line(part === 0 ? "zero" : "grid", x, TOP, x, bottom) + label(x, bottom + 16, "middle", value);
  }).join("");
}

// Those beyond the axis are only counted.
function outliersOf(outliers, end, at, y) {
  const below = outliers.filter((value) => value < -end).length;
  const above = outliers.filter((value) => value > end).length;
  const within = outliers.filter((value) => Math.abs(value) <= end);
  return within.map((value) => `<circle class="outlier" cx="${at(value).toFixed(1)}" cy="${y}" r="2.5"/>`).join("") +
         (below > 0 ? label(LEFT - 2, y + 4, "end", `${below} ◂`) : "") +
         (above > 0 ? label(RIGHT + 2, y + 4, "start", `▸ ${above}`) : "");
}

function box({low, first, median, third, high}, at, y) {
  const whiskers = line("whisker", at(low), y, at(first), y) + line("whisker", at(third), y, at(high), y) +
                   [low, high].map((end) => line("whisker", at(end), y - HALF / 2, at(end), y + HALF / 2)).join("");
  const middle = `<rect class="box" x="${at(first).toFixed(1)}" y="${y - HALF}" ` +
                 `width="${Math.max(0.5, at(third) - at(first)).toFixed(1)}" height="${2 * HALF}"/>`;
  return whiskers + middle + line("median", at(median), y - HALF, at(median), y + HALF);
}

// title and names are markup. groups: [{name, values: [mm]}]; end: of the axis, which goes from -end to end.
export function boxPlotsSvg(title, groups, end, words) {
  const bottom = TOP + ROW * groups.length;
  const at = (value) => LEFT + (value + end) / (2 * end) * (RIGHT - LEFT);
  const rows = groups.map(({name, values}, i) => {
    const y = TOP + ROW * (i + 0.5);
    const plot = boxPlot(values);
    return label(4, y + 4, "start", `${name} (${values.length})`) + box(plot, at, y) + outliersOf(plot.outliers, end, at, y);
  });
  return `<svg class="plot" role="img" aria-label="${title}" viewBox="0 0 ${WIDTH} ${bottom + 24}">` +
         `<text class="title" x="${(LEFT + RIGHT) / 2}" y="16" text-anchor="middle">${title}</text>` +
         axis(end, at, bottom, words) + rows.join("") + "</svg>";
}
