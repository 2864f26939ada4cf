// SPDX-License-Identifier: Apache-2.0
import {pathData, smoothPath} from "./smooth_path.js";

// The strokes as an SVG picture in their real size: one unit is one mm of the screen.
export function svgOfDrawing(strokes, {width_mm, height_mm}, {paper, colours}) {
  const size = `${width_mm.toFixed(1)} ${height_mm.toFixed(1)}`;
  const [width, height] = size.split(" ");
  const paths = strokes.map(({colour, width_mm: stroke_mm, points}) =>
    `  <path stroke="${colours[colour]}" stroke-width="${stroke_mm}" d="${pathData(smoothPath(points))}"/>\n`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${size}"
  fill="none" stroke-linecap="round" stroke-linejoin="round">
  <rect width="100%" height="100%" fill="${paper}"/>
${paths.join("")}</svg>
`;
}
