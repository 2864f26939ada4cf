// SPDX-License-Identifier: Apache-2.0
// The accuracy check in a closed loop: a rendered camera sees the real browser's page, and a rendered hand touches its
// dots at places that are known.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import {after, before, describe} from "node:test";

import {Browser, SIZES} from "./browser.js";
import {Daemons, eventually, tellingLogsOf} from "./daemons.js";
import {DirectedRig, SCREEN, stroke} from "./directed_rig.js";

const {TELEHUG_BIN, TELEHUG_SOURCE, TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES} = process.env;

const WHOLE = {width: SCREEN.width_px, height: SCREEN.height_px};
// Measured here: within 1.1 mm in each direction; a touch of a dot that stays lit is seen 2 to 4 mm too high.
const WITHIN_MM = 2;
const ON_PICTURE_MM = 3;  // away; measured: 1.9
// Which dot, and how far beside it the finger lands, on purpose.
const TOUCHES = [{dot: 1, right_mm: 0, down_mm: 0}, {dot: 4, right_mm: 8, down_mm: 0}, {dot: 10, right_mm: 0, down_mm: 0},
                 {dot: 20, right_mm: 0, down_mm: -7}, {dot: 33, right_mm: -13, down_mm: 0}];
const MISSED = 34;
const PICTURE = path.join(TELEHUG_SOURCE, "tests/fixtures/chat/01_full.jpg");
let daemons;
let rig;
let browser;
let page;
let loop = null;  // what brings the page before the camera, again and again

const test = tellingLogsOf(() => daemons);

const button = (name) => page.getByRole("button", {name});
const now = () => page.locator("#now").textContent();
const status = () => daemons.status("active");
const press = (key) => page.keyboard.press(key);

async function openCheck(options = {viewport: WHOLE, screen: WHOLE}) {
  const opened = await browser.open(await daemons.link("active"), options);
  // The first page leads to what is to be set up next.
  await opened.waitForURL(/(pairing|setup)\.html/);
  await opened.goto(new URL("/accuracy.html", opened.url()).href);
  await opened.locator("#options").waitFor();
  opened.wrong.length = 0;  // the page before was left while it asked for something
  return opened;
}

async function begin() {
  await button("Begin, on the full screen").click();
  await page.locator("#dots .ring").waitFor();
  loop = {ends: false};
  loop.done = (async () => {
    while (!loop.ends) await rig.show(page);
  })();
}

async function stop() {
  loop.ends = true;
  await loop.done;
  await press("Escape");
  await page.locator("#results").waitFor();
}

// The place of the dot that is to be touched.
const ring = () => page.locator("#dots .ring").evaluate(({cx, cy}) => ({x_mm: cx.baseVal.value, y_mm: cy.baseVal.value}));
const dotNumber = async () => Number(/dot (\d+) of/.exec(await now())[1]);

async function skipTo(dot) {
  while (await dotNumber() < dot) await press("s");
}

async function touchDot({dot, right_mm, down_mm}) {
  await skipTo(dot);
  const {x_mm, y_mm} = await ring();
  const place = [x_mm + right_mm, y_mm + down_mm];
  rig.moveHand(stroke([[0.4, ...place], [9, ...place]]));
  await eventually(async () => await dotNumber() === dot + 1, `dot ${dot} is taken`);
  assert.match(await now(), /^[\d.]+ mm off\. Touch dot/);
  rig.moveHand([]);
}

// The cells of a table's rows, by the heads of its columns.
const tableOf = (where, selector) => where.locator(selector).evaluate((table) => {
  const heads = [...table.tHead.rows[0].cells].map((cell) => cell.textContent);
  return [...table.tBodies[0].rows].map((row) => Object.fromEntries([...row.cells].map((cell, i) => [heads[i], cell.textContent])));
});

async function download(name) {
  const [file] = await Promise.all([page.waitForEvent("download"), button(name).click()]);
  const kept = path.join(daemons.folder, file.suggestedFilename());
  await file.saveAs(kept);
  return kept;
}

describe("The accuracy check", () => {
  before(async () => {
    daemons = new Daemons(TELEHUG_BIN, TELEHUG_SOURCE);
    rig = new DirectedRig(daemons);
    [browser] = await Promise.all([Browser.start(TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES), rig.calibrate()]);
  });

  after(async () => {
    if (loop) loop.ends = true;
    await browser?.end();
    await daemons.end();
  });

  test("leads to the set-up as long as there is nothing to check", async () => {
    const bare = await daemons.startBareActive();
    page = await openCheck();
    await page.getByText("There is nothing to check yet").waitFor();
    assert.equal(await button("Begin, on the full screen").isDisabled(), true);
    if ((await status()).web.pages.includes("setup.html"))
      assert.equal(await page.getByRole("link", {name: "Set up camera and screen"}).getAttribute("href"), "/setup.html");
    await browser.assertAccessible(page, "nothing to check");
    await page.getByRole("link", {name: "My touches"}).click();
    await page.locator("#first").waitFor();
    assert.equal(await page.locator("nav a[href='/accuracy.html']").isVisible(), false);
    await page.context().close();
    await daemons.endOne(bare);
  });

  test("is reached from the parent's page, and says how many dots the camera sees", async () => {
    rig.startActive();
    const {touch_screen} = await eventually(async () => (await status())?.touch_screen && status(), "the calibration");
    page = await openCheck();
    await page.getByRole("link", {name: "My touches"}).click();
    await page.getByRole("link", {name: "How exact?"}).click();
    await page.waitForURL("**/accuracy.html");
    const text = await eventually(() => page.locator("#dots-count").textContent(), "how many dots");
    const [reached, unseen] = text.match(/\d+/g).map(Number);
    assert.equal(reached + unseen, 130, "10 rows of 13");
    const top_mm = Math.min(...touch_screen.reach_mm.map(([, y]) => y));
    assert.ok(reached > 30 && reached <= 13 * Math.ceil((300 - top_mm) / 30), text);
    await page.getByLabel("A dot every 60 mm").check();
    await eventually(async () => /touch: 1\d\./.test(await page.locator("#dots-count").textContent()), "fewer dots");
    await page.getByLabel("A dot every 30 mm").check();
    await browser.assertAccessible(page, "the introduction");
    await page.screenshot({path: path.join(TELEHUG_UI_PICTURES, "accuracy-introduction-1280x1024.png")});
    assert.deepEqual(page.wrong, []);
    // Of this page alone; the bodies of pages that were left can't be asked for any more.
    let weight = 0;
    page.on("response", (response) => { weight += Number(response.headers()["content-length"] ?? 0); });
    const debug = await page.context().newCDPSession(page);
    await debug.send("Network.setCacheDisabled", {cacheDisabled: true});
    await page.reload();
    await eventually(() => page.locator("#dots-count").textContent(), "it is all there");
    console.log(`the page weighs ${weight} bytes`);
    assert.ok(weight > 50_000, "it was measured");
    assert.ok(weight <= 150_000);
  });

  test("does not begin on another screen, or in a window that does not fill it", async () => {
    const other = await openCheck({viewport: SIZES[0], screen: WHOLE});
    const start = other.getByRole("button", {name: "Begin, on the full screen"});
    await start.click();
    await other.getByText("The page does not fill the whole screen").waitFor();
    assert.equal(await other.locator("#stage").isVisible(), false);
    await other.setViewportSize(SIZES[1]);
    await other.reload();
    await other.getByText("This window is on a screen of 1920 x 1080 pixels, which has another shape").waitFor();
    assert.equal(await start.isDisabled(), true);
    await browser.photograph(other, "accuracy-introduction");
    await other.setViewportSize({width: 1600, height: 1280});
    await other.reload();
    await other.getByText("This screen has 1600 x 1280 pixels, the one that was set up 1280 x 1024.").waitFor();
    assert.equal(await start.isDisabled(), false);
    await other.context().close();
  });

  test("takes a touch of each dot in turn, and shows where it was seen", async () => {
    await begin();
    assert.equal(await page.evaluate(() => document.fullscreenElement.id), "stage");
    await eventually(async () => (await status()).camera.open, "the camera opens");
    assert.deepEqual((await status()).sending, {name: "auto", on: false, why: "a page uses the fingers"});
    for (const touch of TOUCHES.slice(0, 3)) await touchDot(touch);
    assert.equal(await page.locator("#dots .found").count(), 3);
    await browser.assertAccessible(page, "the full screen");
    await page.screenshot({path: path.join(TELEHUG_UI_PICTURES, "accuracy-dots-1280x1024.png")});
    for (const touch of TOUCHES.slice(3)) await touchDot(touch);
  });

  test("a dot goes out while it is touched, and a finger that is lifted too soon is not taken", async () => {
    await skipTo(MISSED);
    const {x_mm, y_mm} = await ring();
    rig.moveHand(stroke([[0.4, x_mm, y_mm], [0.8, x_mm, y_mm]]));
    const isLit = () => page.locator(`#dots .dot[cx="${x_mm}"][cy="${y_mm}"]`).count();
    assert.equal(await isLit(), 1);
    await eventually(async () => await isLit() === 0, "the dot goes out");
    await eventually(async () => (await now()).startsWith("Rest your finger on the dot for a second"), "it was too short");
    assert.equal(await isLit(), 1);
    assert.equal(await dotNumber(), MISSED);
  });

  test("counts as missed what was not noticed, goes back, and stops in the middle", async () => {
    await press("m");
    assert.match(await now(), /^Counted as missed\./);
    await press("m");
    await press("b");
    assert.match(await now(), new RegExp(`^One back\\. Touch dot ${MISSED + 1} of`));
    await stop();
    await page.getByRole("heading", {name: "Stopped before the last dot"}).waitFor();
    assert.equal(await page.evaluate(() => document.fullscreenElement), null);
    await eventually(async () => !(await status()).camera.open, "the fingers are nobody's any more");
  });

  test("the errors are those that the hand made", async () => {
    const rows = await tableOf(page, "table.dots");
    assert.equal(rows.length, MISSED, "dots that were not reached are left out");
    let most = 0;
    for (const {dot, right_mm, down_mm} of TOUCHES) {
      const row = rows[dot - 1];
      const off = [Number(row.horizontal) - right_mm, Number(row.vertical) - down_mm];
      console.log(`dot ${dot} at ${row["from the left"]}, ${row["from the top"]} mm: horizontal ${row.horizontal}, vertical ` +
                  `${row.vertical}; the hand was ${right_mm}, ${down_mm} beside it`);
      most = Math.max(most, ...off.map(Math.abs));
      assert.ok(Math.abs(Number(row.distance) - Math.hypot(Number(row.horizontal), Number(row.vertical))) < 0.02);
      assert.equal(row.remark, Number(row.distance) > 10 ? "more than 10 mm off" : "");
    }
    console.log(`at most ${most.toFixed(2)} mm from where the hand was`);
    assert.ok(most < WITHIN_MM);
    assert.equal(rows[MISSED - 1].remark, "missed");
    assert.equal(rows[1].remark, "skipped");
  });

  test("the summary is computed from them", async () => {
    const rows = (await tableOf(page, "table.dots")).filter((row) => row.distance !== "–");
    const summary = Object.fromEntries((await tableOf(page, "table.summary")).map((row) => [row[""], row]));
    for (const direction of ["horizontal", "vertical"]) {
      const errors = rows.map((row) => Number(row[direction]));
      const mean = errors.reduce((sum, one) => sum + one, 0) / errors.length;
      const size = errors.reduce((sum, one) => sum + Math.abs(one), 0) / errors.length;
      const sd = Math.sqrt(errors.reduce((sum, one) => sum + (one - mean) ** 2, 0) / (errors.length - 1));
      const near = (name, wanted) => assert.ok(Math.abs(Number(summary[name][direction]) - wanted) < 0.02,
                                               `${name}: ${summary[name][direction]}, not ${wanted}`);
      near("Mean error", size);
      near("Mean offset", mean);
      near("Standard deviation", sd);
      near("95 % are within", Math.max(...errors.map(Math.abs)));
    }
    assert.equal(summary["Missed touches"].horizontal, "16.67 % (1 of 6)");
    assert.equal(summary["Mean error"]["in the thesis"], "horizontal 2.13, vertical 3.66");
    assert.equal(await page.locator("svg.plot").count(), 4);
    assert.equal(await page.locator("svg.screen-plot .found").count(), TOUCHES.length);
    assert.equal(await page.locator("svg.screen-plot .missed").count(), 1);
    await page.getByText("Touches seen: 5, missed: 1").waitFor();
  });

  test("shows it to everybody", async () => {
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({colorScheme});
      await browser.assertAccessible(page, `the findings, ${colorScheme}`);
    }
    await page.emulateMedia({colorScheme: "light"});
    await browser.photograph(page, "accuracy-findings");
    await page.setViewportSize({width: 768, height: 1024});
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0, "no scrolling sideways");
    await page.setViewportSize(WHOLE);
    await page.locator("#language").selectOption("de");
    await page.getByText("16,67 % (1 von 6)").waitFor();
    await page.locator("#language").selectOption("fr");
    await page.getByText("16,67 % (1 sur 6)").waitFor();
    await page.locator("#language").selectOption("en");
  });

  test("a saved report is a page by itself, without network and without script", async () => {
    const file = await download("Save report");
    assert.match(path.basename(file), /^telehug-accuracy-\d{4}-\d\d-\d\d\.html$/);
    const html = fs.readFileSync(file, "utf8");
    assert.doesNotMatch(html, /<script|javascript:|https?:/i);
    assert.doesNotMatch(html, /data:image/);
    const context = await browser.chromium.newContext({offline: true, viewport: SIZES[0]});
    const report = await context.newPage();
    const asked = [];
    report.on("request", (request) => asked.push(request.url()));
    await report.goto(`file://${file}`);
    for (const table of ["table.dots", "table.summary"])
      assert.deepEqual(await tableOf(report, table), await tableOf(page, table));
    const {version} = await status();
    for (const fact of ["380 x 300 mm, 1280 x 1024 pixels", "virtual", "default, default", "30 mm", "A dark colour", version])
      await report.locator("dd").getByText(fact, {exact: true}).first().waitFor();
    await browser.assertAccessible(report, "the report");
    await browser.photograph(report, "accuracy-report");
    assert.deepEqual(asked, [`file://${file}`]);
    await context.close();
  });

  test("a saved CSV has every dot", async () => {
    const rows = fs.readFileSync(await download("Save as CSV"), "utf8").trimEnd().split("\n").map((row) => row.split(","));
    const shown = await tableOf(page, "table.dots");
    for (const [i, row] of shown.entries()) {
      assert.deepEqual(rows[i + 1].slice(0, 3), [row.dot, row.row, row.column]);
      if (row.distance !== "–") assert.ok(Math.abs(Number(rows[i + 1][10]) - Number(row.distance)) < 0.01);
    }
    assert.equal(rows.filter((row) => row[5] === "open").length, rows.length - 1 - MISSED);
  });

  test("goes on where it stopped", async () => {
    await button("Go on with the rest").click();
    await page.locator("#dots .ring").waitFor();
    const [, number, count] = /dot (\d+) of (\d+)/.exec(await now()).map(Number);
    assert.equal(number, MISSED + 1);
    for (let dot = number; dot <= count; ++dot) await press("ArrowRight");
    await page.getByRole("heading", {name: "All dots are done"}).waitFor();
    assert.equal(await button("Go on with the rest").isVisible(), false);
  });

  test("has any picture behind its dots, which stays in the browser", async () => {
    await button("Begin anew").click();
    const broken = path.join(daemons.folder, "no.png");
    fs.writeFileSync(broken, "no picture");
    await page.locator("#picture").setInputFiles(broken);
    await page.getByText("This file is no picture that the browser can show.").waitFor();
    const posted = [];
    page.on("request", (request) => request.method() === "POST" && posted.push(request.postData()));
    await page.locator("#picture").setInputFiles(PICTURE);
    await eventually(() => page.locator("input[value='picture']").isChecked(), "the picture is taken");
    await begin();
    assert.equal(await page.locator("#backdrop").isVisible(), true);
    const colours = await page.locator("#backdrop").evaluate((canvas) => {
      const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const seen = new Set();
      for (let i = 0; i < data.length; i += 4004) seen.add(data[i] >> 4);
      return seen.size;
    });
    assert.ok(colours > 6, `${colours} greys are no picture`);
    await touchDot({dot: 3, right_mm: 0, down_mm: 0});
    await page.screenshot({path: path.join(TELEHUG_UI_PICTURES, "accuracy-picture-1280x1024.png")});
    await stop();
    const [, , row] = await tableOf(page, "table.dots");
    console.log(`on a picture: horizontal ${row.horizontal}, vertical ${row.vertical}`);
    assert.ok(Number(row.distance) < ON_PICTURE_MM, `${row.distance} mm`);
    assert.doesNotMatch(fs.readFileSync(await download("Save report"), "utf8"), /data:image/);
    await page.getByLabel("Put a small copy of the picture into the report").check();
    const html = fs.readFileSync(await download("Save report"), "utf8");
    assert.match(html, /<image href="data:image\/jpeg;base64,/);
    assert.match(html, /A picture of your own/);
    assert.ok(posted.every((body) => body.length < 100), "only commands are sent");
    assert.deepEqual(page.wrong, []);
  });

  test("does not go on once camera and screen were set up again", async () => {
    const {calibrated} = (await status()).touch_screen;
    await rig.calibrate();
    await eventually(async () => (await status()).touch_screen.calibrated !== calibrated, "the new calibration");
    await button("Go on with the rest").click();
    await page.getByText("were set up again meanwhile").waitFor();
    assert.equal(await page.locator("#stage").isVisible(), false);
    await button("Begin anew").click();
    assert.equal(await page.locator("#refusal").textContent(), "");
  });

  test("says so when telehug itself is gone", async () => {
    await button("Begin, on the full screen").click();
    await page.locator("#dots .ring").waitFor();
    await daemons.endOne(daemons.children.at(-1));
    await page.locator("#trouble").getByText("telehug does not answer").waitFor();
    assert.equal(await button("It was not noticed").isDisabled(), true);
    await page.context().close();
  });

  test("says that no touch can be seen while there is no camera, and counts none as missed", async () => {
    daemons.start("active", [`rig.calibration_file=${rig.calibration}`], ["--source", "webcam:/dev/no-such-camera"]);
    await eventually(async () => (await status())?.touch_screen, "the calibration");
    page = await openCheck();
    await button("Begin, on the full screen").click();
    await page.locator("#trouble").getByText("No touch can be seen now:").waitFor();
    await page.locator("#trouble").getByText("/dev/no-such-camera").waitFor();
    await page.locator("#trouble").getByText("plug the camera in").waitFor();
    assert.equal(await button("It was not noticed").isDisabled(), true);
    const before = await dotNumber();
    await press("m");
    assert.equal(await dotNumber(), before);
    await browser.assertAccessible(page, "no camera");
    await press("Escape");
    await button("Begin, on the full screen").waitFor();
    assert.deepEqual(page.wrong, []);
  });
});
