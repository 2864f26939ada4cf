// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import {test} from "node:test";

import {load} from "./modules.js";

const {Drawing} = await load("drawing/drawing.js");
const {TouchFrames} = await load("fingers/touch_frames.js");
const {smoothPath, pathData} = await load("drawing/smooth_path.js");
const {svgOfDrawing} = await load("drawing/svg_of_drawing.js");
const {screenMap} = await load("fingers/screen_map.js");

const looks = {colour: 1, width_mm: 4};
const at = (x_mm, y_mm) => ({x_mm, y_mm});

test("two fingers draw two strokes at once", () => {
  const drawing = new Drawing();
  drawing.begin("a", at(0, 0), looks);
  drawing.begin("b", at(50, 0), looks);
  drawing.extend("a", at(10, 0));
  drawing.extend("b", at(50, 10));
  assert.equal(drawing.growing.length, 2);
  drawing.endAll();
  assert.deepEqual(drawing.strokes.map((stroke) => stroke.points), [[at(0, 0), at(10, 0)], [at(50, 0), at(50, 10)]]);
});

test("undo and redo go back and forth, also over a clearing", () => {
  const drawing = new Drawing();
  drawing.begin("a", at(0, 0), looks);
  drawing.clear();
  assert.equal(drawing.strokes.length, 0);
  drawing.undo();
  assert.equal(drawing.strokes.length, 1);
  drawing.undo();
  assert.equal(drawing.canUndo, false);
  drawing.redo();
  assert.equal(drawing.strokes.length, 1);
});

test("a finger that rests, and a place that is none, add nothing", () => {
  const drawing = new Drawing();
  drawing.begin("a", at(0, 0), looks);
  drawing.extend("a", at(0.1, 0));
  drawing.extend("a", at(NaN, 0));
  assert.equal(drawing.strokes[0].points.length, 1);
});

// Hands that write down what they are told, with the x of places.
function noting(did) {
  return {down: (id, place) => did.push(`down ${id} ${place.x_mm}`), move: (id, place) => did.push(`move ${id} ${place.x_mm}`),
          up: (id) => did.push(`up ${id}`)};
}

const frame = (sequence, ...contacts) => ({sequence, contacts: contacts.map(([id, phase, x_mm]) => ({id, phase, x_mm, y_mm: 0}))});

test("frames that are told again count once, gaps are counted, the lost begin where they are seen", () => {
  const did = [];
  const frames = new TouchFrames(noting(did));
  frames.take({frames: [frame(1, [7, "down", 1]), frame(2)]});
  assert.deepEqual(did, [], "what was over before is not drawn");
  frames.take({frames: [frame(2), frame(3, [8, "down", 1])]});
  frames.take({frames: [frame(3, [8, "down", 1]), frame(4, [8, "move", 2])]});
  frames.take({frames: [frame(6, [8, "up", 3], [9, "move", 5]), frame(7, [9, "move", 6])]});
  assert.deepEqual(did, ["down 8 1", "move 8 2", "up 8", "down 9 5", "move 9 6"]);
  assert.equal(frames.missed, 1);
  frames.take({frames: [frame(1)]});
  assert.equal(did.at(-1), "up 9", "a daemon that began anew has lifted everything");
});

test("a finger that one picture alone shows on the screen has passed over it, and one that jumps has just landed", () => {
  const did = [];
  const frames = new TouchFrames(noting(did));
  frames.take({frames: [frame(1)]});
  frames.take({frames: [frame(2, [1, "down", 5]), frame(3, [1, "up", 5], [2, "down", 30]), frame(4, [2, "move", 50]),
                        frame(5, [2, "up", 50])]});
  assert.deepEqual(did, ["down 2 50", "up 2"]);
});

test("fingers are lifted when nothing more is wanted, and what comes then begins anew", () => {
  const did = [];
  const frames = new TouchFrames(noting(did));
  frames.take({frames: [frame(1)]});
  frames.take({frames: [frame(2, [1, "down", 5]), frame(3, [1, "move", 5])]});
  frames.lift();
  assert.deepEqual(did.splice(0), ["down 1 5", "move 1 5", "up 1"]);
  frames.take({frames: [frame(60, [1, "move", 8])]});
  frames.take({frames: [frame(61, [1, "move", 9])]});
  assert.deepEqual(did, ["down 1 8", "move 1 9"]);
  assert.equal(frames.missed, 0);
});

test("a path is smooth, ends at the newest point, and one point is a dot", () => {
  assert.equal(pathData(smoothPath([at(0, 0), at(10, 0), at(10, 10)])), "M0.00 0.00Q10.00 0.00 10.00 5.00L10.00 10.00");
  assert.equal(pathData(smoothPath([at(1, 2)])), "M1.00 2.00L1.01 2.00");
});

test("the SVG has the screen's real size", () => {
  const svg = svgOfDrawing([{...looks, points: [at(1, 2), at(3, 4)]}], {width_mm: 380, height_mm: 300},
                           {paper: "#fff", colours: ["#000", "#c00"]});
  assert.match(svg, /width="380.0mm" height="300.0mm" viewBox="0 0 380.0 300.0"/);
  assert.match(svg, /<path stroke="#c00" stroke-width="4" d="M1.00 2.00L3.00 4.00"\/>/);
});

test("a place on the screen is where the page shows it, and back", () => {
  const map = screenMap({left: 100, top: 0, width: 1900, height: 1500}, {left: 150, top: 80}, {width_mm: 380, height_mm: 300});
  assert.deepEqual(map.toPage(at(20, 30)), {x: 50, y: 70});
  assert.deepEqual(map.toScreen({x: 50, y: 70}), at(20, 30));
});
