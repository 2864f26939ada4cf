// SPDX-License-Identifier: Apache-2.0
// What pages that are used with the fingers share: the button that starts and stops it, and what keeps fingers from
// working. As long as such a page is seen, fingers touch nobody, whether it is stopped or not.
import {command, follow, onPress, text, write} from "/shared/page.js";
import {TouchFrames} from "./touch_frames.js";

const part = (id) => document.getElementById(id);

export class Fingers {
  #frames;
  #sized;
  #end = null;  // ends following; null: the page is not seen
  #status;
  #on = true;

  // hands: as of touch_frames.js. sized({width_mm, height_mm, ...}, or nothing): called whenever the screen's size may have
  // changed.
  constructor(hands, sized) {
    this.#frames = new TouchFrames(hands);
    this.#sized = sized;
  }

  // After beginPage().
  async begin() {
    onPress(part("run"), async () => this.#toggle());
    this.#show(await command({command: "status"}));
    this.#follow();
    document.addEventListener("visibilitychange", () => this.#follow());
  }

  get on() { return this.#on; }

  writeAgain() {
    write(part("run").querySelector("span"), text(this.#on ? "fingers.stop" : "fingers.start"));
    part("run").classList.toggle("main", !this.#on);
    const hindrance = this.#hindrance();
    write(part("hint"), text(hindrance || (this.#on ? "fingers.on" : "fingers.off")));
    const way = part("to-setup");
    way.hidden = hindrance !== "fingers.not_calibrated" || !this.#status.web.pages.includes(way.getAttribute("href").slice(1));
    const {missed} = this.#frames;
    write(part("missed"), missed > 0 ? text("fingers.missed", {count: missed}) : "");
  }

  #hindrance() {
    if (this.#status.state === "stopped") return "fingers.stopped";
    return this.#status.touch_screen ? "" : "fingers.not_calibrated";
  }

  #toggle() {
    this.#on = !this.#on;
    if (!this.#on) this.#frames.lift();
    this.writeAgain();
  }

  #follow() {
    if (document.hidden) {
      this.#end?.();
      this.#end = null;
      this.#frames.lift();
    } else {
      this.#end ??= follow({status: (status) => this.#show(status), fingers: (news) => {
        if (this.#on) this.#frames.take(news);
      }});
    }
  }

  #show(status) {
    this.#status = status;
    this.#sized(status.touch_screen);
    this.writeAgain();
  }
}
