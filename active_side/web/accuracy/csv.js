// SPDX-License-Identifier: Apache-2.0
import {errorOf} from "./errors.js";

const COLUMNS = ["dot", "row", "column", "x_mm", "y_mm", "outcome", "found_x_mm", "found_y_mm", "error_horizontal_mm",
                 "error_vertical_mm", "error_mm"];

const rounded = (value) => value.toFixed(3);

// One row per dot; the places of those that were not found are empty.
export function csvOf(results) {
  const rows = results.map((result, i) => {
    const {dot, outcome, place} = result;
    const known = [i + 1, dot.row, dot.column, rounded(dot.x_mm), rounded(dot.y_mm), outcome];
    if (outcome !== "found") return [...known, "", "", "", "", ""];
    const {horizontal_mm, vertical_mm, distance_mm} = errorOf(result);
    return [...known, ...[place.x_mm, place.y_mm, horizontal_mm, vertical_mm, distance_mm].map(rounded)];
  });
  return [COLUMNS, ...rows].map((row) => row.join(",")).join("\n") + "\n";
}
