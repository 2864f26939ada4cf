// SPDX-License-Identifier: Apache-2.0
// The parent's page in a real browser, on the real daemons, with a finger resting on the picture of the child.
import assert from "node:assert/strict";
import {after, before, describe} from "node:test";

import {Browser} from "./browser.js";
import {Daemons, eventually, tellingLogsOf} from "./daemons.js";

const {TELEHUG_BIN, TELEHUG_SOURCE, TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES} = process.env;

const active = "active";
const passive = "passive";
let daemons;
let browser;
let page;
let wearers;

const test = tellingLogsOf(() => daemons);

const status = () => daemons.status(active);
const button = (name) => page.getByRole("button", {name});
const answer = () => page.locator("#answer").textContent();
const answers = (pattern) => eventually(async () => pattern.test(await answer()), `the answer ${pattern}`);
const touched = () => page.locator("#picture .touched").evaluateAll((boxes) => boxes.map((box) => Number(box.dataset.box)));
const felt = () => page.locator("#picture .felt").count();

const framesPass = async (count) => {
  const end = (await status()).counters.frames + count;
  await eventually(async () => (await status()).counters.frames >= end, `${count} pictures pass`);
};

describe("The parent's page", () => {
  before(async () => {
    daemons = new Daemons(TELEHUG_BIN, TELEHUG_SOURCE);
    [browser] = await Promise.all([
      Browser.start(TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES),
      daemons.startPassive("duemilanove-12-heaters-2.toml"),
      daemons.startBareActive(),
    ]);
  });

  after(async () => {
    await browser?.end();
    await daemons.end();
  });

  test("begins with what is to be set up first", async () => {
    const {calibrated, web} = await eventually(async () => {
      const newest = await status();
      return newest?.peer?.connected && newest;
    }, "the two daemons meet");
    assert.equal(calibrated, false);
    const first = await browser.open(await daemons.link(active));
    if (web.pages.includes("setup.html")) {
      await first.waitForURL("**/setup.html");
      await first.getByRole("button", {name: "Begin"}).waitFor();  // it has all that it asks for
      await first.goto(new URL("/", first.url()).href);
    }
    await first.getByText("telehug must learn where your screen is").waitFor();
    await first.getByText("✓ This computer is known to another one.").waitFor();
    assert.equal(new URL(first.url()).pathname, "/", "it leads on only once");
    assert.equal(await first.locator("#picture-part").isVisible(), false);
    assert.equal(await first.getByRole("link", {name: "Draw"}).isVisible(), false, "fingers draw nothing yet");
    await browser.assertAccessible(first, "the first start");
    await browser.photograph(first, "live-first-start");
    assert.deepEqual(first.wrong, []);
    await first.context().close();
    await daemons.endOne(daemons.children.at(-1));
  });

  test("lights the box that is touched, and says that it is felt", async () => {
    await daemons.startActive();
    await eventually(async () => (await status())?.peer?.connected, "the daemon with a calibration meets the other");
    page = await browser.open(await daemons.link(active));
    await eventually(felt, "a box is felt");
    await answers(/^Box \d+: the person on this computer feels it\.$/);
    const {last_touch} = await status();
    assert.deepEqual(await touched(), [last_touch.box]);
    assert.equal(await page.locator("#picture .touched text").textContent(), `${last_touch.box} ✓`);
    assert.equal(await page.locator("#picture .finger").count(), 1);
    await page.getByText("Ready: you can touch").waitFor();
    await page.getByText("the person on this computer: here").waitFor();
    await browser.photograph(page, "live-touched");
  });

  test("draws the face, and the boxes as they are numbered and seen", async () => {
    const {places_px} = (await status()).face;
    const numbers = await page.locator("#picture [data-box]").evaluateAll((boxes) => boxes.map((box) => Number(box.dataset.box)));
    assert.deepEqual(numbers.sort((a, b) => a - b), Array.from({length: places_px.columns * places_px.rows}, (_, k) => k + 1));
    const face = await page.locator("#picture rect.face").boundingBox();
    const box = await page.locator("#picture [data-box='3'] rect").boundingBox();
    assert.ok(Math.abs(face.height / box.width - 2) < 0.15, "a box is half as wide as the face is high");
    assert.ok(Math.abs(face.y + face.height - box.y) < 0.1 * face.height, "the boxes begin at the chin");
  });

  test("puts the finger where it lies in its box", async () => {
    const [finger, box] = await page.evaluate(() => ["#picture .finger", "#picture .touched rect"].map(
        (selector) => document.querySelector(selector).getBoundingClientRect().toJSON()));
    const x = finger.x + finger.width / 2;
    const y = finger.y + finger.height / 2;
    assert.ok(x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height,
              `${JSON.stringify(finger)} is not in ${JSON.stringify(box)}`);
  });

  test("says which finger touched nobody, and why", async () => {
    const misses = await page.evaluate(async () => {
      const {nearMiss} = await import("/near_miss.js");
      return [nearMiss({touches_outside_grid: 1}, {touches_outside_grid: 2}), nearMiss({}, {touches_without_face: 1}),
              nearMiss({touches_withheld: 3}, {touches_withheld: 3, touches: 9})];
    });
    assert.deepEqual(misses, ["near.outside", "near.no_face", undefined]);
    const {counters} = await status();
    for (const name of ["touches_outside_grid", "touches_without_face", "touches_with_old_map", "touches_withheld",
                        "fingers_off_screen", "fingers_hovered"])
      assert.ok(name in counters, `the status counts ${name}`);
  });

  test("shows how long each stage takes", async () => {
    const {latency_ms} = await status();
    await page.getByRole("row", {name: /Finding fingers [\d.]+ ms [\d.]+ ms/}).waitFor();
    const usual = await page.getByRole("row", {name: /All of it/}).getByRole("cell").first().textContent();
    assert.ok(Math.abs(parseFloat(usual) - latency_ms.frame_to_published.p50) <= 0.5 * latency_ms.frame_to_published.p50, usual);
    const width = (name) => page.getByRole("row", {name}).locator(".usual").evaluate((bar) => bar.width.baseVal.value);
    assert.ok(await width(/All of it/) > await width(/Which box/), "bars are as long as what they show");
  });

  test("has nothing serious for axe-core in either colour scheme", async () => {
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({colorScheme});
      await browser.assertAccessible(page, colorScheme);
    }
    await browser.photograph(page, "live-dark");
    await page.emulateMedia({colorScheme: "light"});
  });

  test("sees the pause that the wearer's page orders", async () => {
    wearers = await browser.open(await daemons.link(passive));
    await wearers.getByRole("button", {name: "Pause"}).click();
    await answers(/wants a pause/);
    await eventually(async () => await felt() === 0, "nothing is felt any more");
    assert.equal((await touched()).length, 1, "the finger is still there");
    await page.getByText("here, but can't feel anything now.").waitFor();
    await page.getByText(/the other side is not ready: paused/).waitFor();
    await browser.assertAccessible(page, "paused");
    await browser.photograph(page, "live-paused");
    await wearers.getByRole("button", {name: "Go on"}).click();
    await answers(/feels it/);
  });

  test("says that the wearer does not want to be touched there", async () => {
    const {box} = (await status()).last_touch;
    await daemons.telehug("mute", String(box), "--socket", daemons.socket(passive));
    await answers(/does not want to be touched there/);
    await daemons.telehug("unmute", "--all", "--socket", daemons.socket(passive));
    await answers(/feels it/);
  });

  test("stops everything until it carries on", async () => {
    await button("STOP everything").click();
    await page.getByText("Everything is stopped").waitFor();
    assert.equal((await status()).state, "stopped");
    await eventually(async () => (await touched()).length === 0, "no box is touched");
    await button("Send a hug").click();
    await page.getByText("everything is stopped here: run `telehug resume` first").waitFor();
    await browser.assertAccessible(page, "stopped");
    await browser.photograph(page, "live-stopped");
    await button("Carry on").click();
    await eventually(felt, "a box is felt again");
  });

  test("sends a hug, and shows the one that comes back", async () => {
    const hugs = async () => (await status()).counters.hugs_begun;
    const before = await hugs();
    await button("Send a hug").click();
    await page.getByText("The hug goes out.").waitFor();
    await eventually(async () => await hugs() === before + 1, "the hug");
    await daemons.telehug("hug", "--socket", daemons.socket(passive));
    await page.getByText("hugs you!").waitFor();
  });

  test("lets the keyboard reach all of it", async () => {
    await page.locator("#language").focus();
    const reached = new Set();
    for (let presses = 0; presses < 8; ++presses) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.mode));
    }
    for (const id of ["stop", "hug", "on", "auto", "off"]) assert.ok(reached.has(id), `${id}: ${[...reached]}`);
  });

  test("speaks German and French", async () => {
    await page.locator("#language").selectOption("de");
    await button("Alles STOPP").waitFor();
    await answers(/^Feld \d+: .* spürt es\.$/);
    await page.locator("#language").selectOption("fr");
    await answers(/^Case \d+ : .* le sent\.$/);
    await page.locator("#language").selectOption("en");
  });

  test("fits a small tablet without scrolling sideways", async () => {
    await page.setViewportSize({width: 768, height: 1024});
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
    await page.setViewportSize({width: 1280, height: 800});
  });

  test("touches nobody while camera and screen are set up", async () => {
    const setUp = (order) => page.evaluate(async (what) => {
      const {command} = await import("/shared/page.js");
      return command({command: "setup", order: what});
    }, order);
    await setUp("start");
    await eventually(async () => await felt() === 0, "nothing is felt any more");
    assert.equal((await touched()).length, 0, "the finger counts as lifted");
    assert.equal((await status()).camera.why, "a set-up uses it");
    const {touches_published: before} = (await status()).counters;
    await eventually(async () => (await status()).camera.why === "a set-up uses it", "it goes on");
    assert.equal((await status()).counters.touches_published, before);
    await setUp("cancel");
    // What lies on the screen then was meant for the set-up: it touches somebody when it was lifted.
    daemons.showCamera("background.jpg");
    await eventually(async () => (await status()).sending.on, "touches go out again");
    await framesPass(10);
    daemons.showCamera("sequence/012.jpg");
    await eventually(felt, "a box is felt again");
  });

  test("holds touches back until they are to go out", async () => {
    await button("Never").click();
    await page.getByText("Touches don't go out: they are switched off here.").waitFor();
    assert.equal(await button("Never").getAttribute("aria-pressed"), "true");
    assert.equal((await status()).sending.name, "off");
    await eventually(async () => (await touched()).length === 0, "no box is touched");
    await answers(/^The last answer: Box \d+: .* feels it\.$/);
    await button("Always").click();
    await page.getByText("Touches on the person go out.").waitFor();
    assert.equal((await status()).sending.on, true);
    await button("While the chat is in front").click();
    await eventually(async () => (await status()).sending.name === "auto", "the switch is as it was");
  });

  test("says what to do when the wearer is gone", async () => {
    await wearers.context().close();
    await daemons.endOne(daemons.children[0]);
    await page.getByText("Nobody is connected.").waitFor();
    await page.getByText("No face is seen on the screen").waitFor();
    await page.locator("#problems li").first().waitFor();
    await eventually(async () => (await touched()).length === 0, "no box is touched");
    await browser.assertAccessible(page, "alone");
  });

  test("asks nobody else for anything, complains of nothing and is light", async () => {
    assert.deepEqual(page.wrong, []);
    await browser.assertLight(page);
  });
});
