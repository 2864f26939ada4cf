// SPDX-License-Identifier: Apache-2.0
// The accuracy check: red dots all over the calibrated screen are touched one after the other; white dots show where
// telehug saw the touches, tables and box plots how far that was off.
import {beginPage, command, follow, onPress, showProblems, text, write} from "/shared/page.js";
import {Background} from "./accuracy/background.js";
import {chime} from "./accuracy/chime.js";
import {DotCheck} from "./accuracy/dot_check.js";
import {dotGrid} from "./accuracy/dot_grid.js";
import {errorOf} from "./accuracy/errors.js";
import {saveCsv, saveReport, showFindings} from "./accuracy/results_view.js";
import {clearDots, drawDots, fillScreen, leaveScreen} from "./accuracy/stage.js";
import {TouchTaker} from "./accuracy/touch_taker.js";
import {covers, otherPixels, otherScreen} from "./accuracy/window_fit.js";
import {Words} from "./accuracy/words.js";
import {TouchFrames} from "./fingers/touch_frames.js";

const SETUP = "/setup.html";
const OPENS_MS = 4000;  // the camera, after it was asked for
const QUIET_MS = 10_000;

const part = (id) => document.getElementById(id);
const background = new Background();
let status = null;
// What is or was measured: {check, unseen (dots that the camera does not see), spacing_mm, status (at the beginning),
// date}; null: nothing has been begun.
let run = null;
let following = null;  // {end, frames, since_ms}; null: fingers do nothing here
let running = false;
let touched = false;  // a finger is on the screen and has not been taken yet
let active_ms = 0;    // when something was done last

const words = () => new Words(document.documentElement.lang, text);
const spacing = () => Number(document.querySelector("input[name='spacing']:checked").value);
const isCalibratedAs = (one, other) => JSON.stringify(one) === JSON.stringify(other);

// --- what is to be said before ---

function hindrance() {
  if (!status.touch_screen) {
    const there = status.web.pages.includes(SETUP.slice(1));
    return {why: text(there ? "accuracy.not_calibrated" : "accuracy.not_calibrated_by_hand"),
            way: there ? SETUP : "", way_name: text("first.go_calibrate")};
  }
  if (status.state === "stopped") return {why: text("accuracy.stopped"), way: "/", way_name: text("accuracy.to_live")};
  const shape = otherScreen(screen, status.touch_screen);
  if (shape) return {why: text(shape, shownAndCalibrated()), way: ""};
  if (gridOf().dots.every((dot) => !dot.reached)) return {why: text("accuracy.nothing_reached"), way: ""};
  return null;
}

function shownAndCalibrated() {
  const {width_mm, height_mm, width_px, height_px} = status.touch_screen;
  return {shown: `${Math.round(screen.width * devicePixelRatio)} x ${Math.round(screen.height * devicePixelRatio)}`,
          calibrated: `${width_px} x ${height_px}`, mm: `${Math.round(width_mm)} x ${Math.round(height_mm)}`};
}

const gridOf = () => dotGrid(status.touch_screen, spacing());

function showIntro() {
  const found = hindrance();
  part("hindrance").hidden = found === null;
  part("start").disabled = found !== null;
  if (found) {
    write(part("hindrance-why"), found.why);
    part("hindrance-way").hidden = found.way === "";
    if (found.way) Object.assign(part("hindrance-way"), {href: found.way, textContent: found.way_name});
  }
  const size = status.touch_screen;
  const pixels = size && !found ? otherPixels(screen, devicePixelRatio, size) : "";
  part("fit").hidden = pixels === "";
  if (pixels) write(part("fit"), text(pixels, shownAndCalibrated()));
  const dots = size ? gridOf().dots : [];
  const reached = dots.filter((dot) => dot.reached).length;
  const count = size ? text("accuracy.dots_count", {count: reached}) : "";
  write(part("dots-count"), reached < dots.length ? `${count} ${text("accuracy.dots_unseen", {count: dots.length - reached})}` : count);
}

// --- while it runs ---

function trouble() {
  if (!part("lost").hidden) return {why: part("lost").textContent, problems: []};
  if (status.state === "stopped") return {why: text("accuracy.stopped"), problems: []};
  if (status.camera.problems.length > 0) return {why: text("accuracy.camera_trouble"), problems: status.camera.problems};
  if (following && !status.camera.open && performance.now() - following.since_ms > OPENS_MS)
    return {why: text("accuracy.no_pictures"), problems: []};
  return null;
}

function showTrouble() {
  const found = trouble();
  // A touch that nobody could see was not missed.
  part("miss").disabled = found !== null;
  if (found) active_ms = performance.now();
  const quiet = performance.now() - active_ms > QUIET_MS;
  part("trouble").hidden = !found && !quiet;
  write(part("trouble-why"), found ? found.why : quiet ? text("accuracy.quiet") : "");
  showProblems(part("trouble-list"), found ? found.problems : []);
}

function showDots(said = "") {
  const {check} = run;
  drawDots(run.status.touch_screen, run.unseen, check, touched);
  const {dot} = check;
  const now = dot && text("accuracy.now", {number: check.at + 1, count: check.count, row: dot.row, column: dot.column});
  write(part("now"), [said, now].filter(Boolean).join(" "));
  part("back").disabled = !check.begun;
}

function went(said) {
  active_ms = performance.now();
  showDots(said);
  showTrouble();
  if (run.check.isDone) finish();
}

const fingers = {
  touched() {
    touched = true;
    if (running) showDots();
  },
  taken(place) {
    touched = false;
    if (!running || trouble()) return;
    run.check.find(place);
    if (part("sound").checked) chime();
    const {distance_mm} = errorOf(run.check.results[run.check.at - 1]);
    went(text("accuracy.off_by", {mm: words().number(distance_mm)}));
  },
  unsteady() {
    touched = false;
    if (running) went(text("accuracy.unsteady"));
  },
};

const orders = {
  back: () => run.check.back() && went(text("accuracy.went_back")),
  skip: () => (run.check.skip(), went(text("accuracy.did_skip"))),
  miss: () => part("miss").disabled || (run.check.miss(), went(text("accuracy.did_miss"))),
  end: () => finish(),
};
const keys = {b: "back", s: "skip", m: "miss", backspace: "back", arrowleft: "back", arrowright: "skip", escape: "end"};

function onKey(event) {
  if (!running || event.ctrlKey || event.altKey || event.metaKey || event.repeat) return;
  const order = keys[event.key.toLowerCase()];
  if (!order) return;
  event.preventDefault();
  orders[order]();
}

// Only while fingers are really used here: meanwhile they touch nobody else.
function judgeFollowing() {
  const wanted = running && !document.hidden;
  if (wanted === (following !== null)) return;
  if (!wanted) {
    following.end();
    following.frames.lift();
    following = null;
    return;
  }
  const frames = new TouchFrames(new TouchTaker(fingers));
  following = {frames, since_ms: performance.now(), end: follow({fingers: (news) => frames.take(news)})};
}

let wakeLock = null;
async function keepAwake() {
  // Nobody moves the mouse meanwhile; browsers that can't are no reason to stop.
  wakeLock = await navigator.wakeLock?.request("screen").catch(() => null);
}

async function begin() {
  if (hindrance()) return;
  part("stage").classList.toggle("bright", background.shown === "bright");
  if (!await fillScreen(() => covers(window))) throw new Error(text("accuracy.not_full"));
  background.draw(part("backdrop"), devicePixelRatio);
  running = true;
  active_ms = performance.now();
  showDots();
  showTrouble();
  part("stage").focus();
  judgeFollowing();
  await keepAwake();
}

async function start() {
  const {dots} = gridOf();
  const before = run;
  run = {check: new DotCheck(dots.filter((dot) => dot.reached)), unseen: dots.filter((dot) => !dot.reached),
         spacing_mm: spacing(), status};
  try {
    await begin();
  } catch (problem) {
    run = before;
    throw problem;
  }
}

async function goOn() {
  showStatus(await command({command: "status"}));
  if (!isCalibratedAs(status.touch_screen, run.status.touch_screen)) throw new Error(text("accuracy.calibrated_anew"));
  await begin();
}

async function finish(said = "") {
  if (!running) return;
  running = false;
  judgeFollowing();
  wakeLock?.release();
  run.date = new Date();
  await leaveScreen();
  clearDots();
  write(part("now"), "");
  write(part("refusal"), said);
  showResults();
  (part("results").hidden ? part("start") : part("done-title")).focus();
}

function onWindow() {
  if (running && !(document.fullscreenElement && covers(window)))
    finish(document.fullscreenElement ? text("accuracy.not_full") : "");
}

// --- what was found ---

function showResults() {
  const begun = run !== null && run.check.begun;
  part("results").hidden = !begun;
  part("intro").hidden = begun;
  if (begun) showFindings(run, background, words());
}

function anew() {
  run = null;
  write(part("saved"), "");
  showResults();
  showIntro();
  part("start").focus();
}

// --- the page ---

function showStatus(newest) {
  status = newest;
  if (running) showTrouble();
  else showIntro();
}

async function choosePicture() {
  const [file] = part("picture").files;
  write(part("refusal"), "");
  if (!file) return;
  try {
    await background.take(file);
    document.querySelector("input[value='picture']").checked = true;
    background.kind = "picture";
  } catch {
    part("picture").value = "";
    write(part("refusal"), text("accuracy.no_picture"));
  }
}

function choose(event) {
  if (event.target.name === "background") {
    background.kind = event.target.value;
    if (background.kind === "picture" && !background.hasPicture) part("picture").click();
  }
  showIntro();
}

function writeAgain() {
  if (status === null) return;
  document.title = `${text("accuracy.title")} - telehug`;
  showIntro();
  showResults();
}

await beginPage(() => writeAgain());
status = await command({command: "status"});
writeAgain();
onPress(part("start"), start);
onPress(part("go-on"), goOn);
onPress(part("anew"), anew);
onPress(part("save"), () => saveReport(run, background, words()));
onPress(part("csv"), () => saveCsv(run));
for (const [id, act] of Object.entries(orders)) part(id).addEventListener("click", act);
part("options").addEventListener("change", (event) => event.target.id === "picture" ? choosePicture() : choose(event));
document.addEventListener("keydown", onKey);
document.addEventListener("fullscreenchange", onWindow);
document.addEventListener("visibilitychange", judgeFollowing);
window.addEventListener("resize", onWindow);
setInterval(() => running && showTrouble(), 1000);
follow({status: showStatus});
