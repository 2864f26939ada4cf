// SPDX-License-Identifier: Apache-2.0
// A person who sets up before the set-up page: presses its buttons, and touches the dots where it draws them.
import {eventually} from "./daemons.js";
import {SCREEN} from "./directed_rig.js";
import {whiteDot} from "./looped_rig.js";

const LONGEST_TOUCH_MS = 15_000;

export class SetUpPerson {
  constructor(page, rig) {
    this.page = page;
    this.rig = rig;
  }

  button(name) {
    return this.page.getByRole("button", {name});
  }

  visible(id) {
    return this.page.locator(`#${id}:visible`);
  }

  words(id) {
    return this.page.locator(`#${id}`).textContent();
  }

  // Which page is on the whole screen; nothing if none is.
  whole() {
    return this.page.evaluate(() => document.fullscreenElement?.dataset.page);
  }

  async openCamera() {
    await this.button("Begin").click();
    await this.page.locator("#camera-facts", {hasText: /[1-9]\d* pictures a second/}).waitFor();
  }

  async toWholeScreen(mode) {
    await this.page.locator("#camera-advice", {hasText: "Good"}).waitFor();
    await this.button("Next").click();
    await this.page.locator("#width").fill(String(SCREEN.width_mm));
    await this.page.locator("#height").fill(String(SCREEN.height_mm));
    await this.page.getByLabel(mode).check();
    await this.button("Show the pages on the whole screen").click();
    await eventually(async () => await this.whole() === "triangle", "the triangle on the whole screen");
  }

  async confirmTheEdge() {
    await this.visible("confirm").waitFor();
    await this.page.keyboard.press("Enter");
  }

  async dotNumber() {
    return Number(/^Dot (\d+) of/.exec(await this.words("whole-title"))?.[1] ?? 0);
  }

  // Touches the dot that is shown until another one is, or none; where it was, in mm.
  async touchShownDot() {
    const number = await eventually(() => this.dotNumber(), "a dot");
    const dot = await eventually(() => whiteDot(this.page), "the dot's pixels");
    this.rig.touch(dot);
    await eventually(async () => await this.whole() !== "dot" || await this.dotNumber() !== number,
                     `dot ${number} is taken`, LONGEST_TOUCH_MS);
    this.rig.handsAway();
    return dot;
  }

  async touchAllDots() {
    const dots = [];
    await eventually(async () => await this.whole() === "dot", "the first dot");
    while (await this.whole() === "dot") dots.push(await this.touchShownDot());
    return dots;
  }

  solved() {
    return eventually(async () => await this.page.locator("#save").isEnabled(), "the result");
  }
}
