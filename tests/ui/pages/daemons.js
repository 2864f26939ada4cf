// SPDX-License-Identifier: Apache-2.0
// Real daemons in a folder, DDS domain and partition of their own: the wearer's with the simulated jacket, the parent's
// with a picture of a finger that rests on the child for ever.
import {execFile, spawn} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {test} from "node:test";
import {promisify} from "node:util";

const run = promisify(execFile);

// Node's test(), which prints what the daemons said if it fails. `daemons`: a function, since they start later.
export const tellingLogsOf = (daemons) => (name, body) => test(name, async () => {
  try {
    await body();
  } catch (failure) {
    console.log(daemons().logs());
    throw failure;
  }
});

// Waits until `condition` holds something, and returns it.
export async function eventually(condition, what, longestMs = 20_000) {
  const end = Date.now() + longestMs;
  for (;;) {
    const found = await condition();
    if (found) return found;
    if (Date.now() > end) throw new Error(`waited in vain for: ${what}`);
    await new Promise((done) => setTimeout(done, 20));
  }
}

export class Daemons {
  constructor(bin, source) {
    this.bin = bin;
    this.source = source;
    this.folder = fs.mkdtempSync(path.join(os.tmpdir(), "telehug-ui-"));
    this.children = [];
    // As tests/doubles/unique_domain.hpp: the folder's name keeps runs apart, whatever their domain.
    this.dds = [`peer.domain=${70 + process.pid % 30}`, "peer.loopback_only=true",
                `peer.partition=${path.basename(this.folder)}`];
  }

  socket(side) {
    return path.join(this.folder, `${side}.sock`);
  }

  // `own`: as if this user had the files of configuration in the folder `telehug` beside the sockets, and the X server
  // `own.display`; else there are none.
  start(side, settings, more = [], own = undefined) {
    const all = [...this.dds, `control.socket=${this.socket(side)}`,
                 `control.stop_file=${path.join(this.folder, `stop-${side}.json`)}`,
                 `peer.pairs_folder=${path.join(this.folder, `pairs-${side}`)}`, ...settings];
    const log = fs.openSync(path.join(this.folder, `${side}.log`), "a");
    const child = spawn(path.join(this.bin, `telehug-${side}`),
                        ["run", ...(own ? [] : ["--config", "/dev/null"]), ...all.flatMap((setting) => ["--set", setting]), ...more],
                        {stdio: ["ignore", log, log],
                         env: own ? {...process.env, DISPLAY: own.display, XDG_CONFIG_HOME: this.folder} : process.env});
    this.children.push(child);
    return child;
  }

  // A shipped jacket, but that a finger may rest on it for longer than a motor's budget lasts, and that the motors of its
  // box are felt as long as it does.
  tireless(jacket) {
    const profile = path.join(this.folder, jacket);
    const shipped = fs.readFileSync(path.join(this.source, "deploy/jackets", jacket), "utf8");
    const tireless = shipped.replaceAll(/max_duty = .*\n/g, "").replace('rendering = "places"', 'rendering = "boxes"');
    if (!tireless.includes('rendering = "boxes"')) throw new Error(`${jacket} has no rendering`);
    fs.writeFileSync(profile, tireless);
    return profile;
  }

  // `jacket`: its profile's name.
  async startPassive(jacket, settings = []) {
    const profile = this.tireless(jacket);
    const child = this.start("passive", [`jacket.profile=${profile}`, "jacket.link=simulated",
                                         `consent.file=${path.join(this.folder, "consent.json")}`, ...settings]);
    await eventually(async () => (await this.status("passive"))?.jacket.state === "armed", "the simulated jacket");
    return child;
  }

  async startActive() {
    const fixtures = path.join(this.source, "tests/fixtures");
    const held = path.join(this.folder, "held");
    const rig = path.join(this.folder, "rig.toml");
    fs.mkdirSync(held);
    this.showCamera("sequence/012.jpg");
    await run(path.join(this.bin, "telehug-active"), ["calibrate", "--config", "/dev/null", "--source",
                                                      `replay:${path.join(fixtures, "rig2")}`, "--out", rig]);
    return this.start("active", [`rig.calibration_file=${rig}`,
                                 `body_map.picture=${path.join(fixtures, "chat/01_full.jpg")}`],
                      ["--source", `replay:${held}`, "--loop"]);
  }

  // What the camera of startActive() sees from now on, of tests/fixtures/rig2: at first a finger that rests.
  showCamera(picture) {
    const next = path.join(this.folder, "next.jpg");
    fs.symlinkSync(path.join(this.source, "tests/fixtures/rig2", picture), next);
    fs.renameSync(next, path.join(this.folder, "held", "1.jpg"));
  }

  // A PC on which nothing has been set up yet.
  async startBareActive() {
    const child = this.start("active", [`rig.calibration_file=${path.join(this.folder, "none.toml")}`],
                             ["--source", "virtual"]);
    await eventually(() => this.status("active"), "the daemon that has no calibration");
    return child;
  }

  // The same, with the camera that `source` names, with files of configuration as a user has them.
  async startUnsetActive(source, display = "", settings = []) {
    const child = this.start("active", [`rig.calibration_file=${path.join(this.folder, "rig.toml")}`, ...settings],
                             ["--source", source], {display});
    await eventually(() => this.status("active"), "the daemon that has no calibration");
    return child;
  }

  async telehug(...words) {
    return (await run(path.join(this.bin, "telehug"), words)).stdout;
  }

  // Nothing if the daemon does not answer.
  async status(side) {
    try {
      return JSON.parse(await this.telehug("status", "--json", "--socket", this.socket(side))).daemons[0];
    } catch {
      return undefined;
    }
  }

  async link(side) {
    return (await this.telehug("open", "--print", "--socket", this.socket(side))).trim();
  }

  logs() {
    return ["passive", "active"].map((side) => path.join(this.folder, `${side}.log`)).filter(fs.existsSync)
        .map((log) => `--- ${log}\n${fs.readFileSync(log, "utf8")}`).join("\n");
  }

  endOne(child) {
    return new Promise((done) => {
      if (child.exitCode !== null || child.signalCode !== null) return done();
      const hard = setTimeout(() => child.kill("SIGKILL"), 5000);
      child.on("exit", () => {
        clearTimeout(hard);
        done();
      });
      child.kill("SIGTERM");
    });
  }

  async end() {
    await Promise.all(this.children.map((child) => this.endOne(child)));
    fs.rmSync(this.folder, {recursive: true, force: true});
  }
}
