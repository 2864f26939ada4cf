// SPDX-License-Identifier: Apache-2.0
// The wearer's page in a real browser, on the real daemons, with a finger resting on the picture of the child.
import assert from "node:assert/strict";
import {after, before, describe} from "node:test";

import {Browser} from "./browser.js";
import {Daemons, eventually, tellingLogsOf} from "./daemons.js";

const {TELEHUG_BIN, TELEHUG_SOURCE, TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES} = process.env;

const passive = "passive";
let daemons;
let browser;
let page;

const test = tellingLogsOf(() => daemons);

const status = () => daemons.status(passive);
const lit = () => page.locator("#picture .runs").count();
const litNow = (what) => eventually(lit, what);
const dark = (what) => eventually(async () => await lit() === 0, what);
const box = (number) => page.locator(`#picture button[data-box="${number}"]`);

describe("The wearer's page", () => {
  before(async () => {
    daemons = new Daemons(TELEHUG_BIN, TELEHUG_SOURCE);
    [browser] = await Promise.all([
      Browser.start(TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES),
      daemons.startPassive("duemilanove-12-heaters-2.toml"),
      daemons.startActive(),
    ]);
  });

  after(async () => {
    await browser?.end();
    await daemons.end();
  });

  test("opens by a link that works once", async () => {
    const link = await daemons.link(passive);
    page = await browser.open(link);
    await page.getByRole("button", {name: "Pause"}).waitFor();
    assert.equal(new URL(page.url()).pathname, "/");
    const again = await browser.open(link);
    await again.getByText("This link has been used").waitFor();
    await again.context().close();
    const [cookie] = await page.context().cookies();
    assert.equal(cookie.httpOnly, true);
    assert.equal(cookie.sameSite, "Strict");
  });

  test("lights the motors that run", async () => {
    await litNow("a motor lights up");
    const running = new Set((await status()).jacket.running);
    const shown = await page.locator("#picture [data-actuator]:has(.runs)").evaluateAll(
        (groups) => groups.map((group) => Number(group.dataset.actuator)));
    assert.ok(shown.some((id) => running.has(id)), `shown: ${shown}, running: ${[...running]}`);
    await browser.photograph(page, "body-touched");
  });

  test("counts the touch and shows who is there", async () => {
    await page.getByText(/Touches today, since \d\d:\d\d: [1-9]/).waitFor();
    await page.getByText("Somebody on this computer: here").waitFor();
    await page.getByText("Ready: you can be touched").waitFor();
  });

  test("hugs back", async () => {
    await page.getByRole("button", {name: "Hug back"}).click();
    await eventually(async () => (await daemons.status("active")).last_hug, "the other side has seen the hug");
  });

  test("has nothing serious for axe-core in either colour scheme", async () => {
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({colorScheme});
      await browser.assertAccessible(page, colorScheme);
    }
    await browser.photograph(page, "body-dark");
    await page.emulateMedia({colorScheme: "light"});
  });

  test("pauses until it goes on", async () => {
    await page.getByRole("button", {name: "Pause"}).click();
    await page.getByText("Paused until you go on.").waitFor();
    assert.equal((await status()).consent.name, "paused");
    await dark("the motors fall silent");
    await browser.assertAccessible(page, "paused");
    await browser.photograph(page, "body-paused");
    await page.getByRole("button", {name: "Go on"}).click();
    await litNow("a motor lights up again");
    assert.equal((await status()).consent.name, "open");
  });

  test("mutes the box that is touched on the picture", async () => {
    const touched = (await status()).last_touch.box;
    await box(touched).click();
    await dark("the motors fall silent");
    assert.deepEqual((await status()).consent.muted_boxes, [touched]);
    assert.equal(await box(touched).getAttribute("aria-pressed"), "true");
    assert.equal(await box(touched).getAttribute("aria-label"), `Box ${touched}: muted`);
    await browser.photograph(page, "body-muted");
    await page.getByRole("button", {name: "Unmute all"}).click();
    await litNow("a motor lights up again");
    await page.getByText("Nothing is muted.").waitFor();
  });

  test("lets the keyboard do all of it", async () => {
    await box(1).focus();
    for (const key of ["ArrowRight", "ArrowDown", "ArrowDown", "ArrowLeft", "ArrowRight"]) await page.keyboard.press(key);
    assert.equal(await page.evaluate(() => document.activeElement.dataset.box), "12");
    await page.keyboard.press("Space");
    await eventually(async () => (await status()).consent.muted_boxes?.includes(12), "box 12 is muted");
    await page.locator('[data-box="12"][aria-pressed="true"]').waitFor();  // else the page would mute it again
    await page.keyboard.press("Space");
    await eventually(async () => !(await status()).consent.muted_boxes, "box 12 is unmuted");

    await page.locator("#language").focus();
    const reached = new Set();
    for (let presses = 0; presses < 12; ++presses) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.box));
    }
    for (const id of ["stop", "12", "pause", "strength", "trial-which", "trial", "identify"])
      assert.ok(reached.has(id), `${id} is not reached by the tab key: ${[...reached]}`);
  });

  test("lowers the strength", async () => {
    await page.getByLabel("How strong").focus();
    for (let presses = 0; presses < 4; ++presses) await page.keyboard.press("ArrowLeft");
    await eventually(async () => (await status()).consent.strength === 0.8, "80 %");
    await page.getByText("80 %").waitFor();
    await page.keyboard.press("End");
    await eventually(async () => (await status()).consent.strength === undefined, "all of it");
  });

  test("keeps quiet hours of the wearer's own", async () => {
    // Around now, so that they hold at once, whatever the time of day.
    const clock = (shiftMin) => {
      const time = new Date(Date.now() + shiftMin * 60_000);
      return `${String(time.getHours()).padStart(2, "0")}:${String(time.getMinutes()).padStart(2, "0")}`;
    };
    const [begin, end] = [clock(-5), clock(180)];
    await page.getByRole("button", {name: "Add quiet hours"}).click();
    await page.getByLabel("Quiet from").fill(begin);
    assert.equal((await status()).consent.own_quiet_hours, undefined, "half a span is none");
    await page.getByLabel("until", {exact: true}).fill(end);
    await page.getByText(`Quiet hours until ${end}: nothing can be felt.`).waitFor();
    assert.equal((await status()).consent.own_quiet_hours, `${begin}-${end}`);
    await dark("the motors fall silent");
    await browser.assertAccessible(page, "quiet hours");
    await browser.photograph(page, "body-quiet");
    await page.reload();
    await eventually(async () => await page.getByLabel("Quiet from").inputValue() === begin, "they are kept");

    // A row that is not filled in, or being changed, holds up no other.
    const add = page.getByRole("button", {name: "Add quiet hours"});
    await add.click();
    await add.click();
    await page.getByLabel("Quiet from").nth(2).fill("03:00");
    await page.getByLabel("until", {exact: true}).nth(2).fill("03:01");
    const kept = async (hours) => eventually(async () => (await status()).consent.own_quiet_hours === hours, `${hours} are kept`);
    await kept(`${begin}-${end},03:00-03:01`);
    await page.getByLabel("Quiet from").nth(0).fill("");
    await page.getByLabel("until", {exact: true}).nth(2).fill("03:02");
    await kept(`${begin}-${end},03:00-03:02`);
    await page.getByRole("button", {name: "Remove"}).nth(2).click();
    await kept(`${begin}-${end}`);
    assert.equal(await page.getByLabel("Quiet from").count(), 2, "what is half typed stays");
    await page.getByLabel("Quiet from").nth(1).fill("04:00");
    await page.getByLabel("until", {exact: true}).nth(1).fill("04:00");
    await page.getByText(/begins when it ends/).waitFor();
    await kept(`${begin}-${end}`);
    await page.getByRole("button", {name: "Remove"}).nth(1).click();
    await page.getByRole("button", {name: "Remove"}).click();
    await litNow("a motor lights up again");
    assert.equal((await status()).consent.own_quiet_hours, undefined);
  });

  test("leaves others the browser's few connections while nobody sees it", async () => {
    const hide = (tab, hidden) => tab.evaluate((value) => {
      Object.defineProperty(document, "hidden", {value, configurable: true});
      document.dispatchEvent(new Event("visibilitychange"));
    }, hidden);
    const tabs = [];
    for (let i = 0; i < 8; ++i) {
      const tab = await page.context().newPage();
      tabs.push(tab);
      await tab.goto(page.url(), {timeout: 10_000});
      await tab.getByText("Ready: you can be touched").waitFor({timeout: 10_000});
      await hide(tab, true);
    }
    const follows = tabs[0].waitForRequest(/\/live/, {timeout: 10_000});
    await hide(tabs[0], false);
    await follows;
    for (const tab of tabs) await tab.close();
  });

  test("stops everything until it carries on", async () => {
    await page.getByRole("button", {name: "STOP everything"}).click();
    await page.getByText("Everything is stopped").waitFor();
    assert.equal((await status()).state, "stopped");
    await dark("the motors fall silent");
    await browser.photograph(page, "body-stopped");
    await page.getByRole("button", {name: "Carry on"}).click();
    await litNow("a motor lights up again");
  });

  test("says why a motor can't be tried", async () => {
    await page.getByRole("button", {name: "Pause"}).click();
    await page.getByText("Paused until you go on.").waitFor();
    await page.getByRole("button", {name: "Try this one"}).click();
    await page.getByText(/was not driven: paused/).waitFor();
    await page.getByRole("button", {name: "Go on"}).click();
  });

  test("tries a motor", async () => {
    await page.locator("#trial-which").selectOption("12");
    const ms = await page.evaluate(() => new Promise((lit, fail) => {
      setTimeout(() => fail(new Error("motor 12 does not light up")), 10_000);
      const group = document.querySelector("#picture [data-actuator='12']");
      const ordered = performance.now();
      new MutationObserver(() => group.querySelector(".runs") && lit(performance.now() - ordered))
          .observe(group, {subtree: true, attributes: true});
      document.getElementById("trial").click();
    }));
    console.log(`from the order on the page to the motor's light there: ${ms.toFixed(0)} ms`);
    await eventually(async () => await page.locator("#trial-note").textContent() === "", "the trial ends");
  });

  test("speaks the browser's language, or the one that is chosen", async () => {
    const german = await browser.open(await daemons.link(passive), {locale: "de-DE"});
    await german.getByRole("button", {name: "Alles STOPP"}).waitFor();
    assert.equal(await german.evaluate(() => document.documentElement.lang), "de");
    await german.locator("#language").selectOption("fr");
    await german.getByRole("button", {name: "Tout ARRÊTER"}).waitFor();
    await german.reload();
    await german.getByRole("button", {name: "Tout ARRÊTER"}).waitFor();
    assert.deepEqual(german.wrong, []);
    await german.context().close();
  });

  test("fits a small tablet without scrolling sideways", async () => {
    await page.setViewportSize({width: 768, height: 1024});
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.equal(wide, 0);
    await page.setViewportSize({width: 1280, height: 800});
  });

  test("asks nobody else for anything, complains of nothing and is light", async () => {
    assert.deepEqual(page.wrong, []);
    await browser.assertLight(page);
  });

  test("says that telehug does not answer when it has ended", async () => {
    daemons.children[0].kill("SIGKILL");
    await page.getByText("telehug does not answer.").waitFor();
  });
});
