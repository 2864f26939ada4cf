// SPDX-License-Identifier: Apache-2.0
// Closes the loop from a real browser to the virtual rig's camera and back: what a page shows is on the rig's screen as
// long as wanted, and a hand touches where the page shows a dot.
import fs from "node:fs";
import path from "node:path";

import {DirectedRig, SCREEN} from "./directed_rig.js";

const PAUSE_MS = 60;
const FOREVER_S = 1000;

export class LoopedRig extends DirectedRig {
  pictures = 0;

  // From now on what `page` looks like is on the screen, until stopShowing().
  keepShowing(page) {
    this.showing = true;
    this.shown = (async () => {
      for (let before = Buffer.alloc(0); this.showing;) {
        const picture = await page.screenshot({animations: "allow", caret: "initial"}).catch(() => before);
        if (this.showing && !picture.equals(before)) {
          this.put("screen.png", picture);
          ++this.pictures;
        }
        before = picture;
        await new Promise((done) => setTimeout(done, PAUSE_MS));
      }
    })();
  }

  async stopShowing() {
    this.showing = false;
    await this.shown;
  }

  // A picture that can't be read: as if the camera delivered none.
  spoil() {
    this.put("screen.png", "no picture");
  }

  // A finger comes from the user's side to a place on the screen, in mm, and rests there.
  touch([x, y]) {
    this.moveHand([[0.05, x, y + 60, 40], [0.3, x, y, 0], [FOREVER_S, x, y, 0]]);
  }

  handsAway() {
    fs.rmSync(path.join(this.folder, "hand.csv"), {force: true});
  }
}

// The middle of what is white on the set-up's canvas, in mm of the screen, by its own pixels; nothing if nothing is.
export const whiteDot = (page) => page.evaluate((size) => {
  const canvas = document.getElementById("shown");
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", {willReadFrequently: true});
  copy.drawImage(canvas, 0, 0);
  const {data} = copy.getImageData(0, 0, canvas.width, canvas.height);
  let weight = 0;
  let x = 0;
  let y = 0;
  for (let at = 0; at < data.length; at += 4) {
    if (data[at] === 0) continue;
    const pixel = at / 4;
    weight += data[at];
    x += data[at] * (pixel % canvas.width + 0.5);
    y += data[at] * (Math.floor(pixel / canvas.width) + 0.5);
  }
  return weight === 0 ? undefined
                      : [x / weight / canvas.width * size.width_mm, y / weight / canvas.height * size.height_mm];
}, SCREEN);
