// SPDX-License-Identifier: Apache-2.0
// How far touches were seen from their dots, and what that is in a few figures.
import {mean, reachedBy, standardDeviation} from "./statistics.js";

// Means of the thesis' own rig (a master's thesis of 2012; see the README), for comparison.
export const THESIS = {horizontal_mm: 2.13, vertical_mm: 3.66, missed_percent: 4.25};

// A touch that is seen farther off is counted as such, as `telehug-active eval` does.
export const FAR_MM = 10;

// Of a result that was found: horizontal_mm > 0 is right of the dot, vertical_mm > 0 below it.
export function errorOf({dot, place}) {
  const horizontal_mm = place.x_mm - dot.x_mm;
  const vertical_mm = place.y_mm - dot.y_mm;
  return {horizontal_mm, vertical_mm, distance_mm: Math.hypot(horizontal_mm, vertical_mm)};
}

// Found results with their errors.
export function touchesOf(results) {
  return results.filter(({outcome}) => outcome === "found").map((result) => ({...result, error: errorOf(result)}));
}

function spread(values) {
  if (values.length === 0) return null;
  const sizes = values.map(Math.abs);
  return {size_mm: mean(sizes), p95_mm: reachedBy(sizes, 0.95), most_mm: Math.max(...sizes), offset_mm: mean(values),
          sd_mm: standardDeviation(values)};
}

// results: of a DotCheck. Figures in mm, null without any touch. Missed ones are counted among those that were touched.
export function summaryOf(results) {
  const touches = touchesOf(results);
  const missed = results.filter(({outcome}) => outcome === "missed").length;
  const touched = touches.length + missed;
  return {
    found: touches.length,
    missed,
    skipped: results.filter(({outcome}) => outcome === "skipped").length,
    open: results.filter(({outcome}) => outcome === "open").length,
    far: touches.filter(({error}) => error.distance_mm > FAR_MM).length,
    missed_percent: touched === 0 ? null : 100 * missed / touched,
    horizontal: spread(touches.map(({error}) => error.horizontal_mm)),
    vertical: spread(touches.map(({error}) => error.vertical_mm)),
    distance: spread(touches.map(({error}) => error.distance_mm)),
  };
}

// Errors by the dots' "row" or "column": [{number, values: [mm]}], those with touches only.
export function errorsBy(results, line, direction) {
  const touches = touchesOf(results);
  const numbers = [...new Set(touches.map(({dot}) => dot[line]))].sort((a, b) => a - b);
  return numbers.map((number) => ({number, values: touches.filter(({dot}) => dot[line] === number)
                                                     .map(({error}) => error[direction])}));
}
