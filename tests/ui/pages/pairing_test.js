// SPDX-License-Identifier: Apache-2.0
// Two PCs become a pair on their pages: one shows a code, the other takes it. Real browser, real daemons.
import assert from "node:assert/strict";
import {after, before, describe} from "node:test";

import {Browser} from "./browser.js";
import {Daemons, eventually, tellingLogsOf} from "./daemons.js";

const {TELEHUG_BIN, TELEHUG_SOURCE, TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES} = process.env;

let daemons;
let browser;
let wearer;
let parent;

const test = tellingLogsOf(() => daemons);

async function openPairing(side) {
  const page = await browser.open(await daemons.link(side));
  await page.waitForLoadState();
  await page.goto(new URL("/pairing.html", page.url()).href);
  await page.getByText("None yet.").waitFor();
  page.wrong.length = 0;  // the page that was left in the middle of what it asked complains of that
  return page;
}

const shownCode = (page) => eventually(async () => await page.locator("#shown-code").textContent(), "a code");
const words = (page) => page.locator("#words li").allTextContents();

describe("The pairing page", () => {
  before(async () => {
    daemons = new Daemons(TELEHUG_BIN, TELEHUG_SOURCE);
    [browser] = await Promise.all([
      Browser.start(TELEHUG_UI_PACKAGES, TELEHUG_UI_PICTURES),
      daemons.startPassive("duemilanove-12-heaters-2.toml"),
      daemons.startBareActive(),
    ]);
    wearer = await openPairing("passive");
    parent = await openPairing("active");
  });

  after(async () => {
    await browser?.end();
    await daemons.end();
  });

  test("is where the parent's and the wearer's own pages lead", async () => {
    const {web} = await daemons.status("active");
    assert.ok(web.pages.includes("pairing.html"), `${web.pages}`);
    await wearer.goto(new URL("/", wearer.url()).href);
    await wearer.locator("#jacket-state", {hasText: "answers"}).waitFor();
    await wearer.getByRole("link", {name: "Pairs"}).click();
    await wearer.waitForURL("**/pairing.html");
    await browser.assertAccessible(parent, "nothing paired");
  });

  test("shows a code, also for a camera, and how long it is good", async () => {
    await wearer.getByLabel("How the other person sees you").fill("Mia");
    await wearer.getByRole("button", {name: "Show a code"}).click();
    assert.match(await shownCode(wearer), /^([0-9A-Z]{5}-){7}[0-9A-Z]{5}$/);
    await wearer.getByRole("img", {name: "The code for a camera"}).waitFor();
    await wearer.getByText(/Good for another (10:00|9:\d\d)\./).waitFor();
    await browser.assertAccessible(wearer, "a code");
    await browser.photograph(wearer, "pairing-code");
  });

  test("still shows it after the page was loaded anew", async () => {
    const code = await shownCode(wearer);
    await wearer.reload();
    assert.equal(await shownCode(wearer), code);
  });

  test("says what is wrong with a code", async () => {
    const wrong = (await shownCode(wearer)).replace(/.$/, (last) => last === "A" ? "B" : "A");
    await parent.getByLabel("Code", {exact: true}).fill(wrong);
    await parent.getByRole("button", {name: "Take this code"}).click();
    await eventually(async () => await parent.locator("#refusal").textContent(), "a refusal");
  });

  test("makes a pair that shows the same eight words on both", async () => {
    await parent.getByLabel("How the other person sees you").fill("Mum");
    await parent.getByLabel("Code", {exact: true}).fill(await shownCode(wearer));
    await parent.getByRole("button", {name: "Take this code"}).click();
    await parent.getByText("Paired with Mia").waitFor();
    await wearer.getByText("Paired with Mum").waitFor();
    assert.equal((await words(parent)).length, 8);
    assert.deepEqual(await words(parent), await words(wearer));
    assert.equal(await wearer.locator("#shown-code").textContent(), "", "the code is gone");
    await browser.assertAccessible(parent, "paired");
    await browser.photograph(parent, "pairing-words");
    for (const page of [parent, wearer]) await page.getByRole("button", {name: "They are the same"}).click();
    await parent.getByRole("button", {name: "Show a code"}).waitFor();
  });

  test("lets the two daemons meet as that pair", async () => {
    const status = await eventually(async () => {
      const newest = await daemons.status("active");
      return newest?.pair?.name === "Mia" && newest.peer.connected && newest;
    }, "the pair is connected");
    assert.equal(status.pair.phrase.split(" ").length, 8);
  });

  test("breaks off when it is told to", async () => {
    await parent.getByRole("button", {name: "Show a code"}).click();
    await shownCode(parent);
    await parent.getByRole("button", {name: "Break off"}).click();
    await parent.getByRole("button", {name: "Try again"}).click();
    await parent.getByRole("button", {name: "Show a code"}).waitFor();
  });

  test("asks nobody else for anything, complains of nothing and is light", async () => {
    assert.deepEqual(wearer.wrong, []);
    await browser.assertLight(wearer);
    await browser.assertLight(parent);
  });

  // The last: the daemon whose only pair is over ends.
  test("forgets a pair only after it has asked", async () => {
    const forget = parent.getByRole("button", {name: "Forget the pair with Mia"});
    await forget.click();
    await parent.getByText("Forget the pair with Mia?").waitFor();
    await browser.assertAccessible(parent, "the question");
    await parent.getByRole("button", {name: "Keep it"}).click();
    await forget.click();
    await parent.getByRole("button", {name: "Forget this pair", exact: true}).click();
    await parent.getByText("None yet.").waitFor();
  });
});
