// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import fs from "node:fs";
import {test} from "node:test";

import {load} from "./modules.js";

const {boxPlot, mean, median, quantile, reachedBy, standardDeviation} = await load("accuracy/statistics.js");
const {axisFor, boxPlotsSvg} = await load("accuracy/box_plots.js");
const {csvOf} = await load("accuracy/csv.js");
const {DotCheck} = await load("accuracy/dot_check.js");
const {dotGrid, isInside} = await load("accuracy/dot_grid.js");
const {errorsBy, summaryOf} = await load("accuracy/errors.js");
const {reportHtml} = await load("accuracy/report.js");
const {summaryTable} = await load("accuracy/tables.js");
const {TouchTaker} = await load("accuracy/touch_taker.js");
const {covers, otherPixels, otherScreen} = await load("accuracy/window_fit.js");
const {Words, escaped} = await load("accuracy/words.js");

const english = JSON.parse(fs.readFileSync(new URL("../../../active_side/web/texts.en.json", import.meta.url)));
const words = (language = "en") => new Words(language, (key, values = {}) =>
    english[key].replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole));
const at = (x_mm, y_mm) => ({x_mm, y_mm});
const near = (found, wanted) => assert.ok(Math.abs(found - wanted) < 1e-9, `${found} is not ${wanted}`);

// --- figures ---

test("quartiles are those of Hyndman and Fan's definition 7", () => {
  // Their ranks among six are 1.25, 2.5 and 3.75, counted from 0.
  const values = [32, 1, 16, 2, 8, 4];
  near(quantile(values, 0.25), 2.5);
  near(median(values), 6);
  near(quantile(values, 0.75), 14);
  near(quantile([7], 0.25), 7);
});

test("what 95 % reach is a value that was seen, as eval says it", () => {
  const hundred = Array.from({length: 100}, (_, i) => 100 - i);
  assert.equal(reachedBy(hundred, 0.95), 95);
  assert.equal(reachedBy([3, 1, 2], 0.95), 3);
});

test("the standard deviation is a sample's, and 0 of one value", () => {
  near(mean([2, 4, 4, 4, 5, 5, 7, 9]), 5);
  near(standardDeviation([2, 4, 4, 4, 5, 5, 7, 9]), Math.sqrt(32 / 7));
  assert.equal(standardDeviation([3]), 0);
});

test("whiskers end within one and a half boxes, what lies beyond is an outlier", () => {
  assert.deepEqual(boxPlot([1, 2, 3, 4, 5, 100, -100]),
                   {low: 1, first: 1.5, median: 3, third: 4.5, high: 5, outliers: [-100, 100]});
  assert.deepEqual(boxPlot([1, 2, 3, 4, 5, 8.4]).outliers, []);
  assert.deepEqual(boxPlot([1, 2, 3, 4, 5, 11]).outliers, [11]);
  assert.deepEqual(boxPlot([2]), {low: 2, first: 2, median: 2, third: 2, high: 2, outliers: []});
});

const results = () => {
  const check = new DotCheck([{row: 1, column: 1, ...at(10, 10)}, {row: 1, column: 2, ...at(40, 10)},
                              {row: 2, column: 2, ...at(40, 40)}, {row: 2, column: 1, ...at(10, 40)},
                              {row: 3, column: 1, ...at(10, 70)}, {row: 3, column: 2, ...at(40, 70)}]);
  check.find(at(13, 6));
  check.find(at(39, 10));
  check.miss();
  check.skip();
  check.find(at(10, 85));
  return check.results;
};

test("errors are told with and without their sign, missed touches among all that were touched", () => {
  const summary = summaryOf(results());
  assert.deepEqual([summary.found, summary.missed, summary.skipped, summary.open, summary.far], [3, 1, 1, 1, 1]);
  assert.equal(summary.missed_percent, 25);
  near(summary.horizontal.size_mm, 4 / 3);
  near(summary.horizontal.offset_mm, 2 / 3);
  near(summary.vertical.size_mm, 19 / 3);
  near(summary.vertical.offset_mm, 11 / 3);
  near(summary.vertical.sd_mm, standardDeviation([-4, 0, 15]));
  near(summary.distance.size_mm, (5 + 1 + 15) / 3);
  assert.equal(summary.distance.p95_mm, 15);
});

test("nothing touched is no figure at all, not 0", () => {
  const none = summaryOf(new DotCheck([{row: 1, column: 1, ...at(1, 1)}]).results);
  assert.deepEqual([none.missed_percent, none.horizontal, none.distance], [null, null, null]);
  assert.doesNotMatch(summaryTable(none, words()), /NaN|0\.00 %/);
});

test("errors are gathered by the dots' rows and columns", () => {
  assert.deepEqual(errorsBy(results(), "row", "vertical_mm"), [{number: 1, values: [-4, 0]}, {number: 3, values: [15]}]);
  assert.deepEqual(errorsBy(results(), "column", "horizontal_mm"), [{number: 1, values: [3, 0]}, {number: 2, values: [-1]}]);
});

// --- dots ---

test("dots stand every 30 mm in the middle of the screen, 10 mm from its edges at least", () => {
  const {rows, columns, dots} = dotGrid({width_mm: 380, height_mm: 300}, 30);
  assert.deepEqual([rows, columns, dots.length], [10, 13, 130]);
  assert.deepEqual([dots[0].x_mm, dots[0].y_mm, dots.at(-1).y_mm], [10, 15, 285]);
  assert.deepEqual([dots[1].x_mm - dots[0].x_mm, dots[13].y_mm - dots[0].y_mm], [30, 30]);
  assert.ok(dots.every((dot) => dot.reached));
  assert.equal(dotGrid({width_mm: 15, height_mm: 15}, 30).dots.length, 1);
});

test("every other row goes back", () => {
  const {dots} = dotGrid({width_mm: 80, height_mm: 80}, 30);
  assert.deepEqual(dots.map(({row, column}) => `${row}${column}`), ["11", "12", "13", "23", "22", "21", "31", "32", "33"]);
});

test("dots are reached where all of a finger is within the outline", () => {
  const outline = [[0, 300], [0, 200], [100, 95], [280, 95], [380, 200], [380, 300]];
  assert.equal(isInside([190, 100], outline), true);
  assert.equal(isInside([10, 100], outline), false);
  const {dots} = dotGrid({width_mm: 380, height_mm: 300, reach_mm: outline}, 30);
  const reached = (row, column) => dots.find((dot) => dot.row === row && dot.column === column).reached;
  assert.equal(reached(4, 7), true, "105 mm from the top");
  assert.equal(reached(3, 7), false, "75 mm from the top");
  const tight = dotGrid({width_mm: 380, height_mm: 300, reach_mm: outline.map(([x, y]) => [x, Math.max(y, 102)])}, 30);
  assert.equal(tight.dots.find((dot) => dot.row === 4 && dot.column === 7).reached, false, "half of the finger is cut off");
  assert.ok(dotGrid({width_mm: 380, height_mm: 300, reach_mm: []}, 30).dots.every((dot) => !dot.reached));
});

test("a dot that was skipped or missed can be taken back, and is open again", () => {
  const check = new DotCheck([{row: 1, column: 1, ...at(0, 0)}, {row: 1, column: 2, ...at(30, 0)}]);
  assert.equal(check.back(), false);
  check.miss();
  check.find(at(31, 1));
  assert.ok(check.isDone);
  check.skip();
  assert.equal(check.at, 2, "there is nothing left to skip");
  check.back();
  check.back();
  assert.deepEqual(check.results.map(({outcome, place}) => [outcome, place]), [["open", undefined], ["open", undefined]]);
});

// --- touches ---

class Hand {
  constructor() {
    this.heard = [];
    this.now_ms = 0;
    this.taker = new TouchTaker({touched: () => this.heard.push("touched"), unsteady: () => this.heard.push("unsteady"),
                                 taken: ({x_mm, y_mm}) => this.heard.push(`taken ${x_mm} ${y_mm}`)}, () => this.now_ms);
  }
  // 30 frames a second; place: of the time since it came down.
  touch(id, ms, place) {
    this.taker.down(id, place(0));
    for (let frame = 1; frame * 1000 / 30 < ms; ++frame) {
      this.now_ms += 1000 / 30;
      this.taker.move(id, place(frame * 1000 / 30));
    }
    this.taker.up(id);
    return this;
  }
  wait(ms) {
    this.now_ms += ms;
    return this;
  }
}

test("a touch is the median of where the finger rests once its dot has gone out", () => {
  const hand = new Hand();
  let frame = 0;
  hand.touch(1, 1500, (ms) => ms < 380 ? at(99, 96) : ++frame % 5 === 0 ? at(101.5, 98) : at(100, 100));
  assert.deepEqual(hand.heard, ["touched", "taken 100 100"]);
});

test("a finger that is lifted too early, or slides, is told so and not taken", () => {
  assert.deepEqual(new Hand().touch(1, 900, () => at(50, 50)).heard, ["touched", "unsteady"]);
  assert.deepEqual(new Hand().touch(1, 3000, (ms) => at(ms / 10, 50)).heard, ["touched", "unsteady"]);
  assert.deepEqual(new Hand().touch(1, 3000, (ms) => at(Math.min(ms, 900) / 10, 50)).heard, ["touched", "taken 90 50"]);
});

test("one touch is taken once, also if the finger is lost for a moment", () => {
  const hand = new Hand();
  hand.touch(1, 4000, () => at(50, 50)).wait(200).touch(2, 4000, () => at(52, 50));
  assert.deepEqual(hand.heard, ["touched", "taken 50 50"]);
  hand.wait(200).touch(3, 1500, () => at(80, 50));
  assert.deepEqual(hand.heard.slice(2), ["touched", "taken 80 50"], "the next dot is elsewhere");
  hand.wait(600).touch(4, 1500, () => at(80, 50));
  assert.deepEqual(hand.heard.slice(4), ["touched", "taken 80 50"], "the same place, later");
});

test("a second finger meanwhile is none", () => {
  const hand = new Hand();
  hand.taker.down(1, at(50, 50));
  hand.touch(2, 3000, () => at(90, 50));
  assert.deepEqual(hand.heard, ["touched"]);
  hand.taker.up(1);
  assert.deepEqual(hand.heard, ["touched", "unsteady"]);
});

// --- the window ---

test("the window's screen is told from the calibrated one by its shape, its resolution by its pixels", () => {
  const calibrated = {width_mm: 380, height_mm: 300, width_px: 1280, height_px: 1024};
  assert.equal(otherScreen({width: 1280, height: 1024}, calibrated), "");
  assert.equal(otherScreen({width: 1920, height: 1080}, calibrated), "accuracy.other_shape");
  assert.equal(otherPixels({width: 1280, height: 1024}, 1, calibrated), "");
  assert.equal(otherPixels({width: 853, height: 683}, 1.5, calibrated), "", "a desktop scaled to 150 %");
  assert.equal(otherPixels({width: 1600, height: 1280}, 1, calibrated), "accuracy.other_pixels");
  assert.equal(otherPixels({width: 1600, height: 1280}, 1, {...calibrated, width_px: 0, height_px: 0}), "");
  const screen = {width: 1280, height: 1024};
  assert.equal(covers({innerWidth: 1280, innerHeight: 1024, screen}), true);
  assert.equal(covers({innerWidth: 1280, innerHeight: 950, screen}), false);
});

// --- what is shown and saved ---

test("the CSV has a row for every dot, and places only of touches that were seen", () => {
  const rows = csvOf(results()).trimEnd().split("\n");
  assert.equal(rows.length, 7);
  assert.equal(rows[1], "1,1,1,10.000,10.000,found,13.000,6.000,3.000,-4.000,5.000");
  assert.equal(rows[3], "3,2,2,40.000,40.000,missed,,,,,");
  assert.equal(rows[6], "6,3,2,40.000,70.000,open,,,,,");
});

test("all box plots' whiskers fit their axis; outliers beyond it are counted", () => {
  const groups = [{name: "row 1", values: [-0.1, 0, 0.1, 0, 0.1, 40]}];
  assert.equal(axisFor(groups), 1);
  assert.equal(axisFor([{name: "", values: [-3.2, 1]}]), 4);
  assert.match(boxPlotsSvg("title", groups, 1, words()), /▸ 1</);
});

const check = () => ({
  results: results(), spacing_mm: 30, background: "picture", picture: null, date: new Date("2026-05-04T18:21:00Z"),
  status: {version: "1.2.3", camera: {name: "<script>alert(1)</script> \"cam\""}, detector: {name: "default", model: "default"},
           touch_screen: {width_mm: 380, height_mm: 300, width_px: 1280, height_px: 1024, calibrated: "2026-05-01T10:00:00Z"}},
});

test("a report is one file with nothing foreign and no script in it, whatever the camera is called", () => {
  const html = reportHtml(check(), "body { margin: 0 }", words());
  assert.doesNotMatch(html, /<script|<link|@import|url\(|src=|href=/);
  assert.match(html, /&#60;script&#62;alert\(1\)/);
  assert.match(html, /default-src 'none'/);
  assert.match(html, /380 x 300 mm, 1280 x 1024 pixels/);
  assert.match(html, /2\.13.*3\.66/);
  assert.match(html, /25\.00 % \(1 of 4\)/);
  assert.equal(escaped("<a href='x'>\"&"), "&#60;a href=&#39;x&#39;&#62;&#34;&#38;");
});

test("the picture is in the report only if it is wanted", () => {
  const html = reportHtml({...check(), picture: "data:image/jpeg;base64,AAAA"}, "", words());
  assert.match(html, /<image href="data:image\/jpeg;base64,AAAA"/);
});

test("numbers are written as the language does", () => {
  assert.equal(words("de").number(1.5), "1,50");
  assert.equal(words("en").signed(1.5), "+1.50");
  assert.equal(words("en").signed(-0.5, 1), "-0.5");
});
