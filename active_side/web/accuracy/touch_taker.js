// SPDX-License-Identifier: Apache-2.0
// From what a finger does to the place that counts as its touch: the median of where it was seen while it rested. One
// finger at a time.
//
// A lit dot under a fingertip misleads the camera's net: on the virtual rig by 2 to 4 mm upwards on a dark screen, by 1
// to 1.5 on a bright one. So the dot goes out when it is touched, and what was seen until screen and camera have followed
// does not count.
import {median} from "./statistics.js";

const GOES_OUT_MS = 400;
const RESTS_MS = 600;  // and this far, as RestRule of active_side/setup/finger_rest.hpp
const STILL_MM = 3;
const LEAST_PLACES = 6;
// A finger that is lost for a moment comes back as another one: that is still the touch before.
const SAME_MS = 500;
const SAME_MM = 15;

const apart = (a, b) => Math.hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm);
const middle = (places) => ({x_mm: median(places.map((place) => place.x_mm)), y_mm: median(places.map((place) => place.y_mm))});

export class TouchTaker {
  #hears;
  #now_ms;
  #id = null;   // of the finger that is followed
  #done = false;  // it has been taken, or is still the one before
  #down_ms = 0;
  #places = [];  // the last ones within a small circle
  #since_ms = 0;
  #last = null;  // what was taken last: {place, until_ms}

  // hears: {touched(): a finger begins; taken({x_mm, y_mm}): it has rested; unsteady(): it was lifted before it had}.
  // now_ms(): a clock.
  constructor(hears, now_ms = () => performance.now()) {
    this.#hears = hears;
    this.#now_ms = now_ms;
  }

  down(id, place) {
    if (this.#id !== null) return;
    this.#id = id;
    this.#places = [];
    this.#down_ms = this.#now_ms();
    this.#done = this.#goesOn(place);
    if (!this.#done) this.#hears.touched();
  }

  move(id, place) {
    const now_ms = this.#now_ms();
    if (id !== this.#id || this.#done || now_ms - this.#down_ms < GOES_OUT_MS) return;
    if (this.#places.length === 0 || apart(place, middle(this.#places)) > STILL_MM) {
      this.#places = [place];
      this.#since_ms = now_ms;
      return;
    }
    this.#places.push(place);
    if (this.#places.length >= LEAST_PLACES && now_ms - this.#since_ms >= RESTS_MS) this.#take();
  }

  up(id) {
    if (id !== this.#id) return;
    this.#id = null;
    if (this.#done) this.#last.until_ms = this.#now_ms() + SAME_MS;
    else this.#hears.unsteady();
  }

  #take() {
    this.#done = true;
    this.#last = {place: middle(this.#places), until_ms: Infinity};
    this.#hears.taken(this.#last.place);
  }

  #goesOn(place) {
    return this.#last !== null && this.#now_ms() < this.#last.until_ms && apart(place, this.#last.place) < SAME_MM;
  }
}
