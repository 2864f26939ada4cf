// SPDX-License-Identifier: Apache-2.0
// Drawing and the game in a real browser, which is what the virtual rig's camera sees, driven by the rig's finger.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import {after, before, describe} from "node:test";

import {Browser} from "./browser.js";
import {Daemons, eventually, tellingLogsOf} from "./daemons.js";
import {DirectedRig, SCREEN} from "./directed_rig.js";
import {deviations, hug, linesOf, writing} from "./handwriting.js";

const {TELEHUG_BIN, TELEHUG_SOURCE, TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES} = process.env;
const WHOLE_SCREEN = {width: SCREEN.width_px, height: SCREEN.height_px};

const active = "active";
let daemons;
let browser;
let rig;
let page;

const test = tellingLogsOf(() => daemons);

const status = () => daemons.status(active);
const counter = async (name) => (await status()).counters[name];
const button = (name) => page.getByRole("button", {name});
const score = async () => Number((await page.locator("#score").textContent()).match(/\d+/)[0]);

async function saved(key) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press(key)]);
  const file = path.join(daemons.folder, download.suggestedFilename());
  await download.saveAs(file);
  return fs.readFileSync(file);
}
const lines = async () => linesOf((await saved("v")).toString());

// Lets the hand do this and come back, and waits until all of it has been seen.
async function move({rows, seconds}) {
  rig.put("hand.csv", [rows[0].length > 4 ? "t_s,x_mm,y_mm,hover_mm,second_x_mm,second_y_mm" : "t_s,x_mm,y_mm,hover_mm",
                       ...rows].join("\n"));
  await new Promise((done) => setTimeout(done, 1000 * seconds));
  const frames = await counter("frames");
  await eventually(async () => await counter("frames") > frames + 10, "the camera has seen the hand go");
}

// Clears the paper, and returns what the finger draws on it. A PC that is too busy to draw the camera's pictures in time
// has not seen how the finger moved: then it writes again.
async function draw(strokes) {
  for (let tries = 1;; ++tries) {
    await page.keyboard.press("c");
    const missed = await counter("frames_missed");
    const wanted = writing(strokes);
    await move(wanted);
    const lost = (await counter("frames_missed") - missed) / (30 * wanted.seconds);
    if (lost < 0.1 || tries === 5) return lines();
    console.log(`the camera missed ${(100 * lost).toFixed(0)} % of its pictures`);
  }
}

// What colours a PNG has at these [x, y], and its size.
async function look(png, places) {
  return page.evaluate(async ([data, all]) => {
    const bytes = Uint8Array.from(atob(data), (one) => one.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], {type: "image/png"}));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d", {willReadFrequently: true});
    context.drawImage(bitmap, 0, 0);
    const hex = (value) => value.toString(16).padStart(2, "0");
    const colours = all.map(([x, y]) => `#${[...context.getImageData(x, y, 1, 1).data].slice(0, 3).map(hex).join("")}`);
    return {size: [bitmap.width, bitmap.height], colours};
  }, [png.toString("base64"), places]);
}
const inPixels = ([x_mm, y_mm]) => [x_mm * SCREEN.width_px / SCREEN.width_mm, y_mm * SCREEN.height_px / SCREEN.height_mm];

function report(what, drawn, written) {
  const all = drawn.flatMap((line, i) => deviations(line.points, written[i]));
  const mean = all.reduce((sum, one) => sum + one, 0) / all.length;
  const most = Math.max(...all);
  console.log(`${what}: ${drawn.length} strokes, mean deviation ${mean.toFixed(2)} mm, at the most ${most.toFixed(1)} mm`);
  return {mean, most};
}

async function lookAt(pictures) {
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({colorScheme});
    await browser.assertAccessible(page, `${pictures}, ${colorScheme}`);
    await browser.photograph(page, `${pictures}${colorScheme === "dark" ? "-dark" : ""}`);
    await page.setViewportSize(WHOLE_SCREEN);
  }
  await page.emulateMedia({colorScheme: "light"});
}

describe("The page to draw on", () => {
  before(async () => {
    daemons = new Daemons(TELEHUG_BIN, TELEHUG_SOURCE);
    rig = new DirectedRig(daemons);
    [browser] = await Promise.all([
      Browser.start(TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES),
      daemons.startPassive("duemilanove-16.toml"),
      rig.calibrate(),
    ]);
    rig.startActive([`body_map.picture=${path.join(TELEHUG_SOURCE, "tests/fixtures/chat/01_full.jpg")}`]);
    await eventually(async () => (await status())?.sending.on && (await status()).peer.connected, "touches would go out");
  });

  after(async () => {
    await browser?.end();
    await daemons.end();
  });

  test("is a click away once camera and screen are set up, and keeps touches from the other side", async () => {
    page = await browser.open(await daemons.link(active), {viewport: WHOLE_SCREEN, screen: WHOLE_SCREEN});
    await page.getByRole("link", {name: "Draw"}).click();
    await page.getByText("Your fingers work here, and touch nobody.").waitFor();
    await eventually(async () => (await status()).sending.why === "a page uses the fingers", "touches are kept here");
    await page.keyboard.press("f");
    await page.waitForFunction(() => document.fullscreenElement !== null);
    await page.keyboard.press("h");
    await button(/^Tools/).and(page.locator("[aria-expanded=false]")).waitFor();
    await rig.show(page);
  });

  test("shows where the camera sees fingers", async () => {
    const outline = (await status()).touch_screen.reach_mm;
    const [[ax, ay], [bx, by]] = outline.filter(([x, y]) => y > 150 && y < 280 && x < 150);
    const places = Array.from({length: 40}, (_, i) => inPixels([ax + (bx - ax) * i / 39, ay + (by - ay) * i / 39]));
    const {colours} = await look(await page.screenshot(), places);
    assert.ok(colours.includes("#6b7688") && colours.includes("#12161d"), `a dashed line: ${colours}`);
  });

  test("holds a word as the finger wrote it, stroke by stroke", async () => {
    const word = hug([103, 170], 70);
    const drawn = await draw(word);
    assert.equal(drawn.length, word.length, "each lift of the finger is recognised");
    const {mean, most} = report("a word of 70 mm letters at 200 mm/s", drawn, word);
    assert.ok(mean < 1.5, `the mean deviation is ${mean} mm`);
    assert.ok(most < 10, `the most is ${most} mm`);
    assert.equal(await page.locator("#missed").textContent(), "", "every picture of the camera has arrived");
    await page.keyboard.press("h");
    await browser.photograph(page, "draw-word");
    await page.setViewportSize(WHOLE_SCREEN);
  });

  test("saves a picture of it", async () => {
    const [{points: [begin]}] = await lines();
    const places = [inPixels(begin), [5, 1000]];
    const wanted = {size: [SCREEN.width_px, SCREEN.height_px], colours: ["#eef2f7", "#12161d"]};
    assert.deepEqual(await look(await saved("p"), places), wanted);
    assert.deepEqual(await look(await page.screenshot(), places), wanted, "and that is what is seen");
  });

  test("has light paper, too", async () => {
    const [{points: [begin]}] = await lines();
    await page.keyboard.press("b");
    const {colours} = await look(await page.screenshot(), [inPixels(begin), [5, 1000]]);
    assert.deepEqual(colours, ["#1a2230", "#ffffff"]);
    await page.keyboard.press("b");
    assert.deepEqual((await look(await page.screenshot(), [[5, 1000]])).colours, ["#12161d"]);
  });

  test("draws with two fingers at once", async () => {
    await page.keyboard.press("c");
    const ways = [[[120, 180], [170, 210]], [[165, 175], [215, 205]]];
    const row = (t_s, share, hover_mm) => {
      const [first, second] = ways.map(([from, to]) => [0, 1].map((axis) => from[axis] + share * (to[axis] - from[axis])));
      return [t_s, ...first, hover_mm, ...second];
    };
    await move({rows: [row(0.2, 0, 120), row(0.5, 0, 0), row(0.7, 0, 0), row(1.1, 1, 0), row(1.2, 1, 0), row(1.5, 1, 120)],
                seconds: 1.5});
    const drawn = (await lines()).sort((a, b) => a.points[0][0] - b.points[0][0]);
    assert.equal(drawn.length, 2);
    const {mean} = report("two fingers", drawn, ways);
    assert.ok(mean < 1.5, `the mean deviation is ${mean} mm`);
  });

  test("undoes, does again, clears, and stops and starts the fingers by keys", async () => {
    const line = [[[150, 150], [250, 150]]];
    const count = async () => (await lines()).length;
    assert.equal((await draw(line)).length, 1);
    await page.keyboard.press("z");
    assert.equal(await count(), 0);
    await page.keyboard.press("y");
    assert.equal(await count(), 1);
    await page.keyboard.press("Control+z");
    assert.equal(await count(), 0);
    await page.keyboard.press("y");
    await page.keyboard.press("c");
    assert.equal(await count(), 0);
    await page.keyboard.press("s");
    await page.getByText("until you start them").waitFor();
    assert.equal((await draw(line)).length, 0, "a stopped page draws nothing");
    assert.equal((await status()).sending.on, false, "nor does the finger touch anybody then");
    await page.keyboard.press("s");
    await page.keyboard.press("2");
    await page.keyboard.press("+");
    const [{colour, width_mm}] = await draw(line);
    assert.deepEqual({colour, width_mm}, {colour: "#ff8787", width_mm: 7});
    await page.keyboard.press("1");
    await page.keyboard.press("-");
  });

  test("draws by keys alone", async () => {
    await page.keyboard.press("c");
    await page.locator("#paper").focus();
    for (const key of ["Space", "ArrowRight", "Shift+ArrowDown", "Space", "ArrowLeft"]) await page.keyboard.press(key);
    await page.getByText("The pen is up.").waitFor();
    const [{points}, ...others] = await lines();
    const {width_mm, height_mm} = SCREEN;
    assert.deepEqual([points[0], points.at(-1)], [[width_mm / 2, height_mm / 2], [width_mm / 2 + 2, height_mm / 2 + 10]]);
    assert.equal(others.length, 0);
  });

  test("draws with a mouse where it points", async () => {
    await page.keyboard.press("c");
    await page.mouse.move(640, 600);
    await page.mouse.down();
    await page.mouse.move(840, 700, {steps: 5});
    await page.mouse.up();
    const [{points}] = await lines();
    for (const [found, wanted] of [[points[0], [640, 600]], [points.at(-1), [840, 700]]])
      for (const axis of [0, 1]) assert.ok(Math.abs(inPixels(found)[axis] - wanted[axis]) < 1, `${inPixels(found)}`);
  });

  test("lets touches out while another tab hides it, and keeps them again when it is back", async () => {
    const hide = (hidden) => page.evaluate((value) => {
      Object.defineProperty(document, "hidden", {value, configurable: true});
      document.dispatchEvent(new Event("visibilitychange"));
    }, hidden);
    await hide(true);
    await eventually(async () => (await status()).sending.on, "touches go out");
    await hide(false);
    await eventually(async () => !(await status()).sending.on, "touches are kept");
  });

  test("says what keeps the fingers from working", async () => {
    await daemons.telehug("stop", "--socket", daemons.socket(active));
    await page.getByText("Everything is stopped, fingers too.").waitFor();
    await daemons.telehug("resume", "--socket", daemons.socket(active));
    await page.getByText("Your fingers work here, and touch nobody.").waitFor();
  });

  test("has nothing serious for axe-core, weighs little and asks nobody else", async () => {
    await lookAt("draw");
    await browser.assertLight(page);
    assert.deepEqual(page.wrong, []);
  });

  test("leads to a game that the finger plays", async () => {
    await page.getByRole("link", {name: "Pop the balloons"}).click();
    await page.getByText("Popped: 0").waitFor();
    await page.keyboard.press("f");
    await page.waitForFunction(() => document.fullscreenElement !== null);
    await rig.show(page);
    // As who plays does: sees where one is and how fast it rises, and puts a finger where it will be.
    const balloons = () => page.evaluate(async () => {
      const {palettes} = await import("/drawing/palette.js");
      const paper = document.getElementById("paper");
      const {width, height} = paper;
      const copy = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
      copy.drawImage(paper, 0, 0);
      const now = performance.now();
      const {data} = copy.getImageData(0, 0, width, height);
      const sums = new Map(palettes.dark.colours.map((colour) => [parseInt(colour.slice(1), 16), {n: 0, x: 0, y: 0}]));
      for (let i = 0; i < data.length; i += 4) {
        const one = sums.get(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
        if (!one) continue;
        ++one.n;
        one.x += i / 4 % width;
        one.y += Math.floor(i / 4 / width);
      }
      return {now, all: [...sums.values()].map(({n, x, y}) => ({n, x: x / n, y: y / n}))};
    });
    const whole = Math.PI * (22 * SCREEN.width_px / SCREEN.width_mm) * (22 * SCREEN.height_px / SCREEN.height_mm);
    const seen = await eventually(async () => {
      const first = await balloons();
      await new Promise((done) => setTimeout(done, 300));
      const then = await balloons();
      const number = then.all.findIndex(({n, x, y}, i) => Math.min(n, first.all[i].n) > 0.8 * whole &&
          x > 390 && x < 890 && y > 650 && y < 900);
      return number >= 0 && {first: first.all[number], then: then.all[number], ms: then.now - first.now};
    }, "a balloon that no other one covers, where the camera sees a finger on it");
    const soon = 1.2;  // s until the finger is there
    const rises = (seen.first.y - seen.then.y) / seen.ms * 1000;
    const x_mm = seen.then.x * SCREEN.width_mm / SCREEN.width_px;
    const y_mm = (seen.then.y - soon * rises) * SCREEN.height_mm / SCREEN.height_px;
    await move(writing([[[x_mm, y_mm], [x_mm + 3, y_mm]]], soon - 0.15));
    await eventually(async () => await score() >= 1, "it is popped");
    const before = await score();
    await page.keyboard.press("3");
    await eventually(async () => await score() === before + 1, "one is popped by its number");
  });

  test("has a game with nothing serious for axe-core, which weighs little", async () => {
    await lookAt("game");
    await browser.assertLight(page);
    assert.deepEqual(page.wrong, []);
  });

  test("has touched nobody, and lets touches out again when it is left", async () => {
    assert.equal(await counter("touches_published"), 0);
    assert.ok(await counter("touches_withheld") >= 10);
    assert.equal((await status()).sending.why, "a page uses the fingers");
    await browser.end();
    browser = undefined;
    await eventually(async () => (await status()).sending.on, "touches go out again");
  });
});
