// SPDX-License-Identifier: Apache-2.0
// From nothing to a saved calibration in a real browser, on the real daemon: the virtual rig's screen shows what the
// browser shows, its camera sees that, and its user touches the dots where the browser draws them.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import {after, before, describe} from "node:test";

import {Browser} from "./browser.js";
import {Daemons, eventually, tellingLogsOf} from "./daemons.js";
import {SCREEN} from "./directed_rig.js";
import {LoopedRig} from "./looped_rig.js";
import {SetUpPerson} from "./setup_person.js";
import {XServer} from "./x_server.js";

const {TELEHUG_BIN, TELEHUG_SOURCE, TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES} = process.env;

// The usual virtual rig's camera: see capture/virtual_rig/settings.hpp.
const VIEW = {width: SCREEN.width_px, height: SCREEN.height_px};
const CAMERA = {focal_px: 1100, middle_px: 360, above_mm: 15, before_mm: 50};

let daemons;
let browser;
let page;
let rig;
let person;
let monitor;

const test = tellingLogsOf(() => daemons);

const calibration = () => path.join(daemons.folder, "rig.toml");
const settings = () => path.join(daemons.folder, "telehug/active.d/50-setup.toml");

// Where the daemon sees a finger rest, by its live topic: the middle of the last frames.
const restingFinger = () => page.evaluate(() => new Promise((done) => {
  const places = [];
  const source = new EventSource("/live?topics=fingers");
  source.addEventListener("fingers", (event) => {
    const contact = JSON.parse(event.data).frames.at(-1)?.contacts[0];
    if (contact?.phase === "move") places.push([contact.x_mm, contact.y_mm]);
    if (places.length < 12) return;
    source.close();
    const middle = (axis) => places.map((place) => place[axis]).sort((a, b) => a - b)[6];
    done([middle(0), middle(1)]);
  });
}));

const countSounds = () => page.evaluate(() => {
  const {start} = OscillatorNode.prototype;
  window.heard = 0;
  OscillatorNode.prototype.start = function(...when) {
    ++window.heard;
    return start.apply(this, when);
  };
});
const sounds = () => page.evaluate(() => window.heard);

// `dots`: where the canvas showed them.
async function assertDrawnToASixteenthOfAPixel(dots) {
  const wanted = await page.evaluate(() => new Promise((done) => {
    const source = new EventSource("/live?topics=setup");
    source.addEventListener("setup", (event) => {
      source.close();
      done(JSON.parse(event.data).dots);
    });
  }));
  const px = [VIEW.width / SCREEN.width_mm, VIEW.height / SCREEN.height_mm];
  dots.forEach((dot, number) => dot.forEach((mm, axis) => {
    const off = Math.abs(mm - wanted[number][axis]) * px[axis];
    assert.ok(off <= 0.5 / 16 + 0.005, `dot ${number} is drawn ${off} px beside its place`);
  }));
}

describe("The set-up page", () => {
  before(async () => {
    daemons = new Daemons(TELEHUG_BIN, TELEHUG_SOURCE);
    rig = new LoopedRig(daemons);
    [browser, monitor] = await Promise.all([
      Browser.start(TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES),
      XServer.start(VIEW),
    ]);
    await daemons.startUnsetActive(rig.source, monitor.display);
    page = await browser.open(await daemons.link("active"), {viewport: VIEW, screen: VIEW});
    page.setDefaultTimeout(30_000);  // what a camera sees comes late on a busy PC
    person = new SetUpPerson(page, rig);
    rig.keepShowing(page);
  });

  after(async () => {
    await rig.stopShowing();
    await browser?.end();
    await daemons.end();
    monitor?.end();
  });

  // Screenshots change the window, which the rig must not see.
  async function photograph(name) {
    await rig.stopShowing();
    await browser.photograph(page, name);
    await page.setViewportSize(VIEW);
    rig.keepShowing(page);
  }

  test("is where a first start leads to, and offers the camera", async () => {
    await page.waitForURL("**/setup.html");
    await person.button("Begin").waitFor();
    assert.match(await page.locator("#cameras option").first().textContent(), /^virtual/);
    await browser.assertAccessible(page, "the beginning");
    await photograph("setup-begin");
  });

  test("shows what the camera sees, with the green band and the screen's edge over it", async () => {
    await person.openCamera();
    await page.locator("#camera-advice", {hasText: "Good: the edge lies in the green band."}).waitFor();
    const picture = page.getByRole("img", {name: "What the camera sees"});
    await picture.waitFor();
    await eventually(() => picture.locator("canvas").evaluate((canvas) => canvas.width === 640), "the first picture");
    const colours = await picture.locator("canvas").evaluate((canvas) => {
      const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return new Set(data).size;
    });
    assert.ok(colours > 50, "a picture is drawn");
    // From the rig's true camera: the edge lies at v0 + f z0 / y.
    const edge = CAMERA.middle_px + CAMERA.focal_px * CAMERA.before_mm / (SCREEN.height_mm + CAMERA.above_mm);
    const points = await picture.locator("polyline").getAttribute("points");
    for (const point of points.split(" "))
      assert.ok(Math.abs(Number(point.split(",")[1]) - edge) < 4, `${points} is not at ${edge}`);
    await browser.assertAccessible(page, "the camera");
    await photograph("setup-camera");
  });

  test("knows the monitor and what the X server supposes of its size", async () => {
    await person.button("Next").click();
    assert.equal(await page.locator("#monitors option").textContent(), "screen: 1280 × 1024");
    await page.getByText("The size is only what this computer supposes").waitFor();
    assert.equal(await page.locator("#width").inputValue(), "339.0");  // at 96 pixels an inch
  });

  test("tells the size of a screen by a bank card", async () => {
    await page.getByText("Without a ruler").click();
    await page.locator("#card-slider").evaluate((slider) => {
      slider.value = String(85.6 * 1280 / 380);
      slider.dispatchEvent(new Event("input"));
    });
    const size = await page.evaluate(() => ["width", "height"].map((id) => document.getElementById(id).valueAsNumber));
    assert.ok(Math.abs(size[0] - 380) < 0.7 && Math.abs(size[1] - 304) < 0.7, `${size}`);
    const card = await page.locator("#card").boundingBox();
    assert.ok(Math.abs(card.width / card.height - 85.6 / 53.98) < 0.01, "it has a card's shape");
    await browser.assertAccessible(page, "the screen's size");
    await photograph("setup-screen");
    await page.locator("#width").fill("9");
    await person.button("Show the pages on the whole screen").click();
    await page.getByText("Width and height of the visible screen are 100 to 3000 mm.").waitFor();
    await person.button("Back").click();
  });

  test("notices that its window does not cover the monitor", async () => {
    await page.locator("#camera-advice", {hasText: "Good"}).waitFor();
    const pagesAreHigh = (high) => page.evaluate((height) => { document.getElementById("shown").style.height = height; }, high);
    await person.button("Next").click();
    await page.locator("#width").fill("380");
    await pagesAreHigh("800px");  // as in a window that a bar of the desktop keeps lower
    await person.button("Show the pages on the whole screen").click();
    await page.getByText("It has 1280 × 800 pixels, but screen has 1280 × 1024.").waitFor();
    await browser.assertAccessible(page, "the question whether the window covers the monitor");
    await person.button("Leave (Esc)").click();
    await person.visible("part-screen").waitFor();
    assert.equal(await person.whole(), undefined);
    await person.button("Back").click();
    await pagesAreHigh("");
  });

  test("makes a full calibration of nine touches in less than a minute, and saves it", async () => {
    const begin = Date.now();
    await person.toWholeScreen("Nine dots");
    assert.deepEqual(await page.evaluate(() => [document.getElementById("shown").width, document.getElementById("shown").height]),
                     [VIEW.width, VIEW.height]);
    await person.confirmTheEdge();
    await countSounds();
    const dots = await person.touchAllDots();
    await person.solved();
    assert.ok(await sounds() >= 9, "each touch that is taken sounds");
    const seconds = (Date.now() - begin) / 1000;
    console.log(`# nine dots: ${seconds.toFixed(1)} s; ${rig.pictures} pictures of the screen so far; ${await person.words("camera-facts")}`);
    assert.equal(dots.length, 9);
    await assertDrawnToASixteenthOfAPixel(dots);
    assert.ok(seconds < 60, `it took ${seconds} s`);
    assert.equal(await person.whole(), undefined, "the result is not on the whole screen");
    assert.equal(await person.words("verdict"), "Good: save it.");
    const rows = await page.locator("#dots tbody tr").allTextContents();
    assert.equal(rows.length, 9);
    assert.ok(rows.every((row) => row.includes("yes")), rows.join());
    const numbers = await page.locator("#map-numbers td").allTextContents();
    assert.ok(numbers.some((number) => /^[0-2]\.\d mm$/.test(number)) && numbers.includes("not seen"), numbers.join());
    for (const colorScheme of ["dark", "light"]) {
      await page.emulateMedia({colorScheme});
      await browser.assertAccessible(page, `the result, ${colorScheme}`);
    }
    await photograph("setup-result");
    await person.button("Save").click();
    await person.visible("part-saved").waitFor();
    await browser.assertAccessible(page, "saved");
    await photograph("setup-saved");
  });

  test("makes a calibration by which the daemon at once places touches where they are", async () => {
    await eventually(async () => (await daemons.status("active"))?.calibrated, "the daemon uses it by itself");
    const errors = [];
    for (const place of [[190, 270], [110, 245], [265, 215], [190, 195]]) {
      rig.touch(place);
      const found = await restingFinger();
      errors.push(Math.hypot(found[0] - place[0], found[1] - place[1]));
      rig.handsAway();
    }
    console.log(`# errors of touches by this calibration, mm: ${errors.map((error) => error.toFixed(1)).join(", ")}`);
    assert.ok(errors.every((error) => error < 4), `${errors}`);
  });

  test("keeps camera and size for every later start", async () => {
    const kept = fs.readFileSync(settings(), "utf8");
    assert.match(kept, /screen_width_mm = 380/);
    assert.match(kept, /screen_height_mm = 300/);
    assert.match(kept, /monitor = 'screen'/);
    assert.ok(kept.includes(`source = '${rig.source}'`), kept);
    assert.match(await person.words("saved-settings"), /50-setup\.toml/);
    assert.equal(await page.locator("#saved-problem").isVisible(), false);
  });

  test("goes back to the whole screen after Escape, where it was", async () => {
    await person.button("Set up once more").click();
    await page.locator("#camera-facts", {hasText: "pictures a second"}).waitFor();
    await page.getByLabel("Sounds").uncheck();
    await page.evaluate(() => { window.heard = 0; });
    await person.toWholeScreen("Two dots: quick");
    await person.visible("confirm").waitFor();
    await browser.assertAccessible(page, "is it the edge?");
    await photograph("setup-confirm");
    await person.confirmTheEdge();
    await eventually(async () => await person.whole() === "dot", "the first dot");
    await browser.assertAccessible(page, "a dot");
    await photograph("setup-dot");
    await page.evaluate(() => document.exitFullscreen());  // what Escape does, which no test can press on the window
    await page.getByText("The set-up waits").waitFor();
    await browser.assertAccessible(page, "left the whole screen");
    await photograph("setup-away");
    await person.button("Back to the whole screen").click();
    await eventually(async () => await person.whole() === "dot", "the same dot");
  });

  test("goes on where it was after the page was loaded anew", async () => {
    await page.reload();
    await page.getByText("The set-up waits").waitFor();
    await countSounds();
    await person.button("Back to the whole screen").click();
    await eventually(async () => await person.whole() === "dot", "the same dot");
    assert.match(await person.words("whole-title"), /^Dot 1 of 2/);
  });

  test("takes the last dot back by a key, and leaves one out only where enough are left", async () => {
    await person.touchShownDot();
    assert.equal(await person.dotNumber(), 2);
    assert.equal(await page.locator("#skip").isVisible(), false);
    await page.keyboard.press("Backspace");
    await eventually(async () => await person.dotNumber() === 1, "the first dot again");
  });

  test("makes a quick calibration of two touches", async () => {
    const begin = Date.now();
    const dots = await person.touchAllDots();
    await person.solved();
    console.log(`# two dots: ${((Date.now() - begin) / 1000).toFixed(1)} s`);
    assert.equal(dots.length, 2);
    assert.equal(await sounds(), 0, "sounds are switched off");
    assert.equal((await page.locator("#dots tbody tr").count()), 2);
  });

  test("takes a dot again from the table of results", async () => {
    await person.button("Touch dot 2 again").click();
    await eventually(async () => await person.whole() === "dot" && await person.dotNumber() === 2, "the second dot");
    await person.touchShownDot();
    await person.solved();
  });

  test("breaks off, changes nothing and lets go of the camera", async () => {
    const kept = fs.readFileSync(calibration(), "utf8");
    await person.button("Break off").click();
    await page.getByText("The set-up was broken off. The calibration is as before; settings that were found for the camera stay.").waitFor();
    assert.equal(fs.readFileSync(calibration(), "utf8"), kept);
    assert.notEqual((await daemons.status("active")).camera.why, "a set-up uses it");
  });

  test("speaks German and French", async () => {
    await person.openCamera();
    await page.locator("#language").selectOption("de");
    await page.getByText("Gut: Die Kante liegt im grünen Band.").waitFor();
    await page.locator("#language").selectOption("fr");
    await page.getByText("Bien : le bord est dans la bande verte.").waitFor();
    await page.locator("#language").selectOption("en");
  });

  test("asks nobody else for anything, complains of nothing and is light", async () => {
    assert.deepEqual(page.wrong.filter((one) => !one.includes("ERR_")), [], "but that the page was left");
    await browser.assertLight(page);
  });
});
