// SPDX-License-Identifier: Apache-2.0
// The parent's daemon before a virtual rig that the test directs: its screen shows the real browser's page, and its
// user's finger is where the test puts it (active_side/capture/virtual_rig/directed_rig.hpp).
import {execFile} from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import {promisify} from "node:util";

const run = promisify(execFile);

export const SCREEN = {width_mm: 380, height_mm: 300, width_px: 1280, height_px: 1024};  // of the usual virtual rig
const REACH_MM = 120;  // where a hand comes from
const REACH_S = 0.3;   // and how long that takes

// Rows of hand.csv, [t_s, x_mm, y_mm, hover_mm], for a finger that comes down at the first of `places`, [t_s, x_mm, y_mm],
// goes from one to the next, and is lifted at the last one.
export function stroke(places) {
  const first = places[0];
  const last = places.at(-1);
  return [[first[0] - REACH_S, first[1], first[2] + REACH_MM / 5, REACH_MM], ...places.map((place) => [...place, 0]),
          [last[0] + REACH_S, last[1], last[2] + REACH_MM / 5, REACH_MM]];
}

export class DirectedRig {
  // `daemons`: whose folder and settings it shares.
  constructor(daemons) {
    this.daemons = daemons;
    this.folder = path.join(daemons.folder, "directed");
    this.source = `virtual?${this.folder}`;
    this.calibration = path.join(daemons.folder, "directed.toml");
    fs.mkdirSync(this.folder);
  }

  async calibrate() {
    await run(path.join(this.daemons.bin, "telehug-active"),
              ["calibrate", "--config", "/dev/null", "--source", this.source, "--out", this.calibration]);
  }

  startActive(settings = []) {
    return this.daemons.start("active", [`rig.calibration_file=${this.calibration}`, ...settings],
                              ["--source", this.source]);
  }

  put(name, content) {
    const beside = path.join(this.folder, `beside-${name}`);
    fs.writeFileSync(beside, content);
    fs.renameSync(beside, path.join(this.folder, name));
  }

  // From now on; `rows` as stroke() makes them. None: nobody is there.
  moveHand(rows) {
    this.put("hand.csv", ["t_s,x_mm,y_mm,hover_mm", ...rows.map((row) => row.join(","))].join("\n"));
  }

  // What the browser shows now is what the camera sees.
  async show(page) {
    this.put("screen.png", await page.screenshot());
  }
}
