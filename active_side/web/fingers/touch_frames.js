// SPDX-License-Identifier: Apache-2.0
// From the live topic "fingers" (active_side/finger_feed.hpp) to what fingers do. A touch begins when a second picture shows
// it: what one alone shows was a finger that passed over the screen.
const LANDED_MM = 10;  // a finger that is farther away in the second picture was still coming down in the first

export class TouchFrames {
  #hands;
  #last = 0;  // 0: none yet
  #landing = new Map();  // ids of those that one picture has shown, and where
  #touching = new Set();  // ids
  missed = 0;

  // hands: {down(id, place), move(id, place), up(id)}
  constructor(hands) {
    this.#hands = hands;
  }

  take({frames}) {
    if (frames.length === 0) return;
    const newest = frames[frames.length - 1].sequence;
    // What went on before the page looked is over, and so it is when the daemon has begun anew.
    if (this.#last === 0 || newest < this.#last) {
      this.lift();
      this.#last = newest - 1;
    }
    for (const frame of frames) {
      if (frame.sequence <= this.#last) continue;
      this.missed += frame.sequence - this.#last - 1;
      this.#last = frame.sequence;
      this.#see(frame.contacts);
    }
  }

  // Nothing more comes for now: who touched is gone.
  lift() {
    for (const id of this.#touching) this.#hands.up(id);
    this.#touching.clear();
    this.#landing.clear();
    this.#last = 0;
  }

  #see(contacts) {
    const there = new Set(contacts.filter((contact) => contact.phase !== "up").map((contact) => contact.id));
    for (const id of [...this.#touching, ...this.#landing.keys()]) if (!there.has(id)) this.#leave(id);
    for (const {id, phase, x_mm, y_mm} of contacts) {
      if (phase === "up") continue;
      if (phase === "down") this.#leave(id);
      this.#follow(id, {x_mm, y_mm});
    }
  }

  // A contact whose beginning was missed begins where it is seen.
  #follow(id, place) {
    if (this.#touching.has(id)) return this.#hands.move(id, place);
    const first = this.#landing.get(id);
    if (!first) return this.#landing.set(id, place);
    const landed = Math.hypot(place.x_mm - first.x_mm, place.y_mm - first.y_mm) <= LANDED_MM;
    this.#landing.delete(id);
    this.#touching.add(id);
    this.#hands.down(id, landed ? first : place);
    if (landed) this.#hands.move(id, place);
  }

  #leave(id) {
    this.#landing.delete(id);
    if (this.#touching.delete(id)) this.#hands.up(id);
  }
}
