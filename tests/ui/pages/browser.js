// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium, and what every page has to keep to: nothing from elsewhere, no complaint on its console, no serious
// finding of axe-core, a weight.
import assert from "node:assert/strict";
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";

const PROGRAM = "/usr/bin/chromium";
// Without sandbox: CI runs as root. The rest keeps the browser itself from asking its maker for anything.
const FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
               "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage"];
const MOST_BYTES = 150_000;
export const SIZES = [{width: 1280, height: 800}, {width: 1920, height: 1080}];

export class Browser {
  // `packages`: where install put them. `pictures`: folder for screenshots.
  static async start(packages, pictures) {
    const require = createRequire(path.join(packages, "package.json"));
    const browser = new Browser();
    browser.axe = fs.readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
    browser.pictures = pictures;
    fs.mkdirSync(pictures, {recursive: true});
    browser.chromium = await require("playwright-core").chromium.launch({executablePath: PROGRAM, args: FLAGS});
    return browser;
  }

  // A page in a browser of its own, with a list of what was wrong with it.
  async open(url, options = {}) {
    const context = await this.chromium.newContext({viewport: SIZES[0], locale: "en-GB", ...options});
    const page = await context.newPage();
    page.setDefaultTimeout(10_000);
    page.wrong = [];
    const host = new URL(url).host;
    page.on("console", (message) => ["error", "warning"].includes(message.type()) && page.wrong.push(message.text()));
    page.on("pageerror", (error) => page.wrong.push(String(error)));
    page.on("request", (request) => {
      const asked = new URL(request.url());
      if (asked.protocol !== "data:" && asked.host !== host) page.wrong.push(`asks ${request.url()}`);
    });
    await page.goto(url);
    return page;
  }

  async assertAccessible(page, what) {
    // By the debugger, which the page's own rules against foreign scripts do not bind.
    await page.evaluate(this.axe);
    const {violations} = await page.evaluate(() => window.axe.run());
    const serious = violations.filter((one) => ["serious", "critical"].includes(one.impact))
        .map((one) => `${one.id}: ${one.help}: ${one.nodes.map((node) => node.html).join(" ")}`);
    assert.deepEqual(serious, [], `axe-core on ${what}`);
  }

  // What this page consists of; what it asks for while it is used is no weight.
  async assertLight(page) {
    const bytes = await page.evaluate(async () => {
      const names = [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")]
          .map((entry) => new URL(entry.name).pathname)
          .filter((name) => !/^[/](command|live|picture[/].*)$/.test(name));
      const weights = [...new Set(names)].map(async (name) => (await (await fetch(name)).arrayBuffer()).byteLength);
      return (await Promise.all(weights)).reduce((sum, weight) => sum + weight, 0);
    });
    assert.ok(bytes > 1000, `of ${page.url()} only ${bytes} bytes were measured`);
    assert.ok(bytes <= MOST_BYTES, `the page weighs ${bytes} bytes`);
    console.log(`${new URL(page.url()).pathname} weighs ${Math.round(bytes / 1000)} kB`);
  }

  async photograph(page, name) {
    for (const size of SIZES) {
      await page.setViewportSize(size);
      await page.screenshot({path: path.join(this.pictures, `${name}-${size.width}x${size.height}.png`)});
    }
    await page.setViewportSize(SIZES[0]);
  }

  async end() {
    await this.chromium.close();
  }
}
