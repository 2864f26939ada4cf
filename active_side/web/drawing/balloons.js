// SPDX-License-Identifier: Apache-2.0
// Balloons that rise: each has a number that a key pops it by. Places and sizes in mm of the screen.
const RADIUS_MM = 22;
const SLOWEST_MM_S = 15;
const FASTEST_MM_S = 40;
export const BALLOONS = 8;

export class Balloons {
  popped = 0;
  all = [];
  #random;

  // random: as Math.random.
  constructor(random) {
    this.#random = random;
    for (let number = 1; number <= BALLOONS; ++number) this.all.push({number, radius_mm: RADIUS_MM, colour: number - 1});
  }

  // Each begins somewhere else below or on the screen.
  begin(size) {
    for (const balloon of this.all) this.#place(balloon, size, this.#random() * size.height_mm);
  }

  step(seconds, size) {
    for (const balloon of this.all) {
      balloon.y_mm -= seconds * balloon.mm_s;
      if (balloon.y_mm < -balloon.radius_mm) this.#place(balloon, size, 0);
    }
  }

  // Pops what is hit; a new one comes from below. Returns its number, or nothing.
  hit({x_mm, y_mm}, size) {
    const balloon = this.all.find((one) => Math.hypot(one.x_mm - x_mm, one.y_mm - y_mm) <= one.radius_mm);
    return balloon && this.pop(balloon.number, size);
  }

  pop(number, size) {
    const balloon = this.all.find((one) => one.number === number);
    if (!balloon) return undefined;
    ++this.popped;
    this.#place(balloon, size, 0);
    return number;
  }

  // above_mm: how far above the place just below the screen.
  #place(balloon, {width_mm, height_mm}, above_mm) {
    const {radius_mm} = balloon;
    balloon.x_mm = radius_mm + this.#random() * Math.max(0, width_mm - 2 * radius_mm);
    balloon.y_mm = height_mm + radius_mm - above_mm;
    balloon.mm_s = SLOWEST_MM_S + this.#random() * (FASTEST_MM_S - SLOWEST_MM_S);
  }
}
