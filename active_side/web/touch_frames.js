// SPDX-License-Identifier: Apache-2.0
// From the live topic "fingers" (active_side/finger_feed.hpp) to what fingers do.
export class TouchFrames {
  #hands;
  #last = 0;  // 0: none yet
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

  // Nothing more comes: who touched is gone.
  lift() {
    for (const id of this.#touching) this.#hands.up(id);
    this.#touching.clear();
  }

  #see(contacts) {
    const there = new Set(contacts.filter((contact) => contact.phase !== "up").map((contact) => contact.id));
    for (const id of [...this.#touching]) if (!there.has(id)) this.#leave(id);
    for (const {id, phase, x_mm, y_mm} of contacts) {
      if (phase === "up") continue;
      // A contact whose beginning was missed begins where it is seen.
      if (phase === "down" || !this.#touching.has(id)) {
        this.#leave(id);
        this.#hands.down(id, {x_mm, y_mm});
      } else {
        this.#hands.move(id, {x_mm, y_mm});
      }
      this.#touching.add(id);
    }
  }

  #leave(id) {
    if (this.#touching.delete(id)) this.#hands.up(id);
  }
}
