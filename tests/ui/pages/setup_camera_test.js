// SPDX-License-Identifier: Apache-2.0
// The set-up page's camera in a real browser: turned away, missing, taken away, without settings, and let go of.
import assert from "node:assert/strict";
import {after, before, describe} from "node:test";

import {Browser} from "./browser.js";
import {Daemons, eventually, tellingLogsOf} from "./daemons.js";
import {SCREEN} from "./directed_rig.js";
import {LoopedRig} from "./looped_rig.js";
import {SetUpPerson} from "./setup_person.js";

const {TELEHUG_BIN, TELEHUG_SOURCE, TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES} = process.env;

const VIEW = {width: SCREEN.width_px, height: SCREEN.height_px};

let daemons;
let browser;
let page;
let rig;
let person;

const test = tellingLogsOf(() => daemons);

const whyOpen = async () => (await daemons.status("active")).camera.why;

// With a daemon of its own, before another camera.
async function withCamera(source, settings, look) {
  const other = new Daemons(TELEHUG_BIN, TELEHUG_SOURCE);
  try {
    await other.startUnsetActive(source(other), "", settings);
    const asked = await browser.open(await other.link("active"), {viewport: VIEW});
    await asked.getByRole("button", {name: "Begin"}).click();
    await look(asked);
    await asked.context().close();
  } finally {
    await other.end();
  }
}

describe("The camera of the set-up page", () => {
  before(async () => {
    daemons = new Daemons(TELEHUG_BIN, TELEHUG_SOURCE);
    rig = new LoopedRig(daemons);
    [browser] = await Promise.all([
      Browser.start(TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES),
      daemons.startUnsetActive(rig.source),
    ]);
    page = await browser.open(await daemons.link("active"), {viewport: VIEW, screen: VIEW});
    page.setDefaultTimeout(30_000);  // what a camera sees comes late on a busy PC
    person = new SetUpPerson(page, rig);
    await page.waitForURL("**/setup.html");
    await person.openCamera();
  });

  after(async () => {
    await browser?.end();
    await daemons.end();
  });

  test("says that the virtual camera has nothing to tune", async () => {
    await person.button("Find the best settings").click();
    await page.locator("#refusal", {hasText: "virtual is no webcam: it has no settings that could be tuned"}).waitFor();
  });

  test("tells a second page that a set-up runs already", async () => {
    const answer = await page.evaluate(async () => {
      const {command} = await import("/shared/page.js");
      return command({command: "setup", order: "start"}).then(() => "begun", (problem) => problem.message);
    });
    assert.match(answer, /runs already, perhaps on another page/);
  });

  test("has its pages in a window as large as the screen where the browser grants no whole screen", async () => {
    await page.evaluate(() => {
      Element.prototype.requestFullscreen = () => Promise.reject(new TypeError("denied"));
    });
    await page.locator("#camera-advice", {hasText: "Good"}).waitFor();
    await person.button("Next").click();
    await page.locator("#width").fill(String(SCREEN.width_mm));
    await page.locator("#height").fill(String(SCREEN.height_mm));
    await page.evaluate((height) => Object.defineProperty(screen, "height", {value: height, configurable: true}), VIEW.height + 100);
    await person.button("Show the pages on the whole screen").click();
    await page.locator("#refusal", {hasText: "press F11"}).waitFor();
    await page.evaluate((height) => Object.defineProperty(screen, "height", {value: height}), VIEW.height);
    await person.button("Show the pages on the whole screen").click();
    await page.locator('#whole[data-page="triangle"]:visible').waitFor();
    await page.keyboard.press("Escape");
    await page.locator("#whole").waitFor({state: "hidden"});
    await person.visible("camera-again").click();
    await page.locator("#camera-advice", {hasText: "Good"}).waitFor();
  });

  test("says that the camera delivers nothing, and goes on when it does again", async () => {
    rig.spoil();
    await page.getByText("The camera delivers no pictures").waitFor();
    await page.locator("#camera-facts", {hasText: "The camera:"}).waitFor();
    await browser.assertAccessible(page, "without a camera");
    await rig.show(page);
    await page.locator("#camera-advice", {hasText: "Good"}).waitFor();
  });

  test("is not let go of at once when its page is left", async () => {
    await page.goto("about:blank");
    assert.equal(await whyOpen(), "a set-up uses it");
  });

  test("is to be turned when it sees too little of the screen", async () => {
    await withCamera((other) => new LoopedRig(other).source.replace("virtual", "virtual:2"), [], async (asked) => {
      await asked.getByText("Turn the camera so that it sees more of the screen.").waitFor();
      assert.equal(await asked.locator("#camera-picture .edge.in").count(), 0, "the edge is not in the band");
      await browser.photograph(asked, "setup-turn");
    });
  });

  test("is to be plugged in when there is none", async () => {
    await withCamera(() => "webcam", ["camera.device=/dev/v4l/by-id/none"], async (asked) => {
      await asked.getByText("The camera: there is no webcam /dev/v4l/by-id/none; plug it in").waitFor();
      await asked.getByText("The camera delivers no pictures").waitFor();
    });
  });

  test("is let go of after ten seconds in which no page looked", async () => {
    await eventually(async () => await whyOpen() !== "a set-up uses it", "the camera is free");
    await page.goto(new URL("/setup.html", await daemons.link("active")).href);
    await page.getByText("No page looked any more: the set-up has ended.").waitFor();
  });
});
