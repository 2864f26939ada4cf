// SPDX-License-Identifier: Apache-2.0
// Fingers that touched the screen, but nobody.

// Counters of the status, and the texts of them.
const TEXTS = {touches_outside_grid: "near.outside", touches_without_face: "near.no_face", touches_with_old_map: "near.old_map",
               touches_withheld: "near.withheld", fingers_off_screen: "near.off_screen",
               fingers_hovered: "near.hovers"};

// The text's key of what happened between these two; undefined: nothing did.
export function nearMiss(before, now) {
  return TEXTS[Object.keys(TEXTS).find((name) => (now[name] ?? 0) > (before[name] ?? 0))];
}
