// SPDX-License-Identifier: Apache-2.0
// A pen that arrow keys move (with Shift in larger steps) and the space bar puts down and lifts.
const STEP_MM = 2;
const LARGE_STEP_MM = 10;
const WAYS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};

export class KeyboardPen {
  place = null;  // null: not used yet
  isDown = false;

  // Returns what a key did: "moved", "down", "up", or nothing if it is none of the pen's. size: {width_mm, height_mm}.
  press(key, large, size) {
    if (key !== " " && !(key in WAYS)) return undefined;
    this.place ??= {x_mm: size.width_mm / 2, y_mm: size.height_mm / 2};
    if (key === " ") {
      this.isDown = !this.isDown;
      return this.isDown ? "down" : "up";
    }
    const step = large ? LARGE_STEP_MM : STEP_MM;
    const within = (value, most) => Math.min(most, Math.max(0, value));
    this.place = {x_mm: within(this.place.x_mm + step * WAYS[key][0], size.width_mm),
                  y_mm: within(this.place.y_mm + step * WAYS[key][1], size.height_mm)};
    return "moved";
  }
}
