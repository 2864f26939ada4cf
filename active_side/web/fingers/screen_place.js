// SPDX-License-Identifier: Apache-2.0
import {monitorOf, pageOf, screenMap} from "./screen_map.js";

// Where places on the screen are on this page, as the window moves, grows or becomes the whole screen.
export class ScreenPlace {
  #pointer;  // an event of a mouse or pen, which knows where the page is
  #size;
  #moved;

  // moved(): the map is another one.
  constructor(moved) {
    this.#moved = moved;
    const onPointer = (event) => {
      const apart = (axis) => event[`screen${axis}`] - event[`client${axis}`];
      const before = this.#pointer;
      this.#pointer = event;
      if (before && ["X", "Y"].every((axis) => Math.abs(apart(axis) - before[`screen${axis}`] + before[`client${axis}`]) < 1))
        return;
      moved();
    };
    window.addEventListener("pointermove", onPointer, {capture: true});
    window.addEventListener("resize", moved);
    document.addEventListener("fullscreenchange", moved);
  }

  // size: of the calibrated screen, or nothing.
  resize(size) {
    if (JSON.stringify(this.#size) === JSON.stringify(size)) return;
    this.#size = size;
    this.#moved();
  }

  get size() { return this.#size; }
  get map() { return screenMap(monitorOf(window), pageOf(window, this.#pointer), this.#size); }
}
