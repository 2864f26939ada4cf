// SPDX-License-Identifier: Apache-2.0
// Dots that are touched one after the other, and what became of each: "open" (not yet touched), "found" (with the place
// where telehug saw the touch), "missed" (touched, but not noticed) or "skipped".
export class DotCheck {
  #results;
  #at = 0;

  // dots: those of dotGrid() that are reached.
  constructor(dots) {
    this.#results = dots.map((dot) => ({dot, outcome: "open"}));
  }

  // [{dot, outcome, place}]; place only of those that were found.
  get results() { return this.#results; }
  get count() { return this.#results.length; }
  // The index of the dot that is to be touched now; count: all are done.
  get at() { return this.#at; }
  get dot() { return this.#results[this.#at]?.dot ?? null; }
  get isDone() { return this.#at === this.count; }
  get begun() { return this.#at > 0; }

  find(place) { this.#decide("found", {place}); }
  miss() { this.#decide("missed"); }
  skip() { this.#decide("skipped"); }

  // The dot before is touched again; what it had counts no more.
  back() {
    if (!this.begun) return false;
    const {dot} = this.#results[--this.#at];
    this.#results[this.#at] = {dot, outcome: "open"};
    return true;
  }

  #decide(outcome, more = {}) {
    if (this.isDone) return;
    this.#results[this.#at] = {dot: this.dot, outcome, ...more};
    ++this.#at;
  }
}
