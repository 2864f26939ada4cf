// SPDX-License-Identifier: Apache-2.0
// The screen with its dots and where telehug saw the touches on them, as SVG in mm. Colours come from results.css.
import {touchesOf} from "./errors.js";

const MARGIN_MM = 8;
const DOT_MM = 2.5;
const FOUND_MM = 1.8;
const CROSS_MM = 2.5;

const fixed = (value) => value.toFixed(2);
const circle = (kind, {x_mm, y_mm}, r, title) =>
    `<circle class="${kind}" cx="${fixed(x_mm)}" cy="${fixed(y_mm)}" r="${r}">${title ? `<title>${title}</title>` : ""}</circle>`;

const cross = ({x_mm, y_mm}) =>
    `<path class="missed" d="M${fixed(x_mm - CROSS_MM)} ${fixed(y_mm - CROSS_MM)}l${2 * CROSS_MM} ${2 * CROSS_MM}` +
    `m0 ${-2 * CROSS_MM}l${-2 * CROSS_MM} ${2 * CROSS_MM}"/>`;

// screen: {width_mm, height_mm}; picture: a data URL that lies behind, or null; title is markup.
export function screenPlotSvg(title, {width_mm, height_mm}, results, picture, words) {
  const box = [-MARGIN_MM, -MARGIN_MM, width_mm + 2 * MARGIN_MM, height_mm + 2 * MARGIN_MM].map(fixed).join(" ");
  const dots = results.map(({dot, outcome}) => outcome === "missed" ? circle("dot", dot, DOT_MM) + cross(dot)
                                               : outcome === "found" ? circle("dot", dot, DOT_MM)
                                                                     : circle("untouched", dot, DOT_MM));
  const found = touchesOf(results).map(({dot, place, error}) =>
      `<line class="error" x1="${fixed(dot.x_mm)}" y1="${fixed(dot.y_mm)}" x2="${fixed(place.x_mm)}" y2="${fixed(place.y_mm)}"/>` +
      circle("found", place, FOUND_MM, words.text("accuracy.off_by", {mm: words.number(error.distance_mm)})));
  const behind = picture ? `<image href="${picture}" width="${fixed(width_mm)}" height="${fixed(height_mm)}" preserveAspectRatio="xMidYMid slice"/>`
                         : "";
  return `<svg class="screen-plot" role="img" aria-label="${title}" viewBox="${box}">` +
         `<rect class="screen" width="${fixed(width_mm)}" height="${fixed(height_mm)}"/>${behind}` +
         `${dots.join("")}${found.join("")}</svg>`;
}
