// SPDX-License-Identifier: Apache-2.0
// Camera and screen are set up: from nothing to a saved calibration.
import {beginPage, command, follow, make, onPress, text, write, writeProblem, writeWithSaid} from "/shared/page.js";
import {drawOverlay, placePreview} from "/setup/preview.js";
import {showResult} from "/setup/result.js";
import {chosenMonitor, chosenSize, offerMonitors, restoreScreen, writeMonitors} from "/setup/screen.js";
import {play, wakeSounds} from "/setup/sound.js";
import {enterWhole, isWhole, leaveWhole, showWhole} from "/setup/whole.js";

const PARTS = ["begin", "camera", "screen", "away", "result", "saved"];
const STEP_OF = {begin: "camera", camera: "camera", screen: "screen", away: "touch", result: "result", saved: "result"};

const part = (id) => document.getElementById(id);
let news = {stage: "idle"};
let offers = {cameras: []};
let chooses = "camera";  // or "screen", while the daemon only looks at the camera
let shownPart = "";
let shownResult = "";

const order = (what, more = {}) => command({command: "setup", order: what, ...more});
const runs = () => news.stage === "running";
const step = () => (runs() ? news.step : "");
const pagesIn = (some) => some.stage === "running" && some.show.page !== "none";
const showsPages = () => pagesIn(news);

function offset([x, y]) {
  const mm = (value) => Math.abs(value).toFixed(0);
  const sides = [];
  if (Math.abs(x) >= 1) sides.push(text(x < 0 ? "setup.off_left" : "setup.off_right", {mm: mm(x)}));
  if (Math.abs(y) >= 1) sides.push(text(y < 0 ? "setup.off_up" : "setup.off_down", {mm: mm(y)}));
  return sides.join(", ");
}

function advice() {
  if (news.hangs) return text("setup.camera_hangs");
  if (news.advice === "none") return "";
  if (news.advice === "finger_beside_dot" && news.off_mm) return `${text("advice.finger_beside_dot")} ${offset(news.off_mm)}`;
  return text(`advice.${news.advice}`);
}

function partNow() {
  if (news.stage === "waiting") return "camera";
  if (news.stage === "ended" && news.why === "saved") return "saved";
  if (!runs()) return "begin";
  if (step() === "camera") return chooses;
  return step() === "solving" || step() === "solved" ? "result" : "away";
}

function showPart() {
  const now = partNow();
  for (const name of PARTS) part(`part-${name}`).hidden = name !== now || isWhole();
  for (const covered of [document.querySelector("header"), part("steps")]) covered.inert = isWhole();
  const current = isWhole() ? "touch" : STEP_OF[now];
  for (const item of document.querySelectorAll("#steps li")) {
    if (item.dataset.step === current) item.setAttribute("aria-current", "step");
    else item.removeAttribute("aria-current");
  }
  if (shownPart !== "" && shownPart !== now && !isWhole()) {
    const title = part(`part-${now}`).querySelector("h2");
    title.tabIndex = -1;
    title.focus();
  }
  shownPart = now;
}

function showBegin() {
  const why = news.stage === "ended" ? news.why : "";
  part("ended").hidden = why === "";
  writeWithSaid(part("ended"), why === "" ? "" : text(`setup.ended_${why}`), news.problem ?? "");
}

function showCamera() {
  if (!runs()) {
    write(part("camera-advice"), text(news.hangs ? "setup.camera_hangs" : "setup.waiting"));
    return;
  }
  const {camera} = news.run;
  const good = news.advice === "good" && camera.problem === "" && !news.hangs;
  part("camera-advice").classList.toggle("good", good);
  write(part("camera-advice"), good ? text("setup.camera_good") : advice());
  const facts = camera.problem ? text("setup.camera_says") : text("setup.camera_facts", {name: camera.name, fps: camera.fps});
  writeWithSaid(part("camera-facts"), facts, camera.problem);
  showTuning(news.run.tune);
}

function showTuning(tune) {
  part("tuning").hidden = tune === null;
  part("tune").disabled = tune !== null;
  if (tune === null) return;
  const asks = tune.phase === "empty" || tune.phase === "finger";
  const found = {before: tune.before.toFixed(1), after: tune.after.toFixed(1)};
  writeWithSaid(part("tune-text"), text(`setup.tune_${tune.phase}`, found), tune.problem);
  part("tune-next").hidden = !asks;
  part("tune-progress").hidden = tune.phase !== "search";
  part("tune-progress").value = tune.progress;
  write(part("tune-end"), text(asks || tune.phase === "search" ? "setup.tune_end" : "setup.tune_close"));
}

function showSolved() {
  const {result} = news;
  const solved = step() === "solved" && result !== null;
  part("verdict").classList.toggle("good", solved && result.good);
  write(part("verdict"), solved ? text(`advice.${news.advice}`) : text("setup.solving"));
  for (const id of ["save", "repeat"]) part(id).disabled = !solved;
  if (!solved) return;
  part("save").disabled = !news.can.save;
  part("repeat").hidden = result.repeat.length === 0;
  const newest = JSON.stringify([document.documentElement.lang, result]);
  if (newest === shownResult) return;
  shownResult = newest;
  showResult(news, (dots) => repeatDots(dots).catch((problem) => writeProblem(part("refusal"), problem)));
}

function showSaved() {
  const {saved} = news.run;
  write(part("saved-calibration"), text("setup.saved_calibration", {file: saved.calibration}));
  write(part("saved-settings"), saved.settings ? text("setup.saved_settings", {file: saved.settings}) : "");
  part("saved-problem").hidden = saved.problem === "";
  writeWithSaid(part("saved-problem"), saved.problem ? text("setup.saved_problem") : "", saved.problem);
}

function wholeTitle() {
  if (step() === "dots") return text("setup.dots_now", {number: news.dot + 1, all: news.dots.length});
  return text(`setup.now_${step()}`);
}

function show() {
  showPart();
  const now = partNow();
  if (now === "begin") showBegin();
  if (now === "camera") showCamera();
  if (now === "result") showSolved();
  if (now === "saved") showSaved();
  if (runs()) drawOverlay(news);
  if (isWhole()) {
    const refusal = runs() ? news.run.refusal : "";
    const pages = runs() ? news : {show: {page: "none", dots: [], width_mm: 1, height_mm: 1, dot_mm: 1}, can: {}, progress: 0};
    showWhole(pages, {title: showsPages() ? wholeTitle() : "", advice: showsPages() ? advice() : "", refusal});
  } else {
    placePreview(now === "camera" && runs() ? part("camera-picture") : null);
  }
}

function sound(before) {
  if (!runs() || before.stage !== "running") return;
  if (news.taken > before.taken) play(880);
  else if (news.step === "confirm_border" && before.step === "bright") play(660);
  else if (news.step === "solved" && before.step !== "solved") play(660, 880, 1320);
}

// This page was loaded while the pages are shown.
function takeUp() {
  const {chosen} = news.run;
  restoreScreen(chosen);
  document.querySelector(`input[name=mode][value=${chosen.mode}]`).checked = true;
}

function hear(newest) {
  const before = news;
  news = newest;
  if (showsPages() && before.stage === "idle") takeUp();
  sound(before);
  if (runs() && news.step === "camera" && before.step !== "camera") chooses = "camera";
  if (isWhole() && ((pagesIn(before) && !showsPages()) || !runs())) leaveWhole();
  const refusal = runs() ? news.run.refusal : "";
  if (refusal !== "" && refusal !== before.run?.refusal) writeProblem(part("refusal"), {message: refusal, fromDaemon: true});
  show();
}

// Whether they are the pages of a screen with so many pixels.
function areOf(px) {
  const {width_px, height_px} = news.run.chosen;
  return step() !== "camera" && width_px === px.width_px && height_px === px.height_px;
}

// The pages, on the whole screen; begun anew if they are to be others than before.
async function goWhole(anew) {
  wakeSounds();
  const px = await enterWhole(show);
  if (px === undefined) return;
  const mode = document.querySelector("input[name=mode]:checked").value;
  if (anew || !areOf(px))
    await order("begin", {...chosenSize(), ...px, monitor: chosenMonitor()?.name ?? "", mode});
  show();
}

async function repeatDots(dots) {
  await goWhole(false);
  if (!isWhole()) return;
  for (const dot of dots) await order("repeat", {dot});
}

function sizeIsSensible() {
  const fields = [part("width"), part("height")];
  const wrong = fields.find((field) => field.value === "" || !field.checkValidity());
  wrong?.focus();
  return wrong === undefined;
}

async function refreshOffers() {
  offers = await order("list");
  const chosen = part("cameras").value || offers.chosen.camera;
  part("cameras").replaceChildren(...offers.cameras.map((camera) =>
    make("option", {value: camera.source, textContent: camera.name, selected: camera.source === chosen})));
}

async function backToCamera() {
  chooses = "camera";
  if (step() !== "camera") await order("camera");
  show();
}

async function begin() {
  const size = chosenSize();
  await order("start", {camera: part("cameras").value, ...(size.width_mm > 0 && size.height_mm > 0 ? size : {})});
}

function press(id, act) {
  onPress(part(id), act);
}

function beginOrders() {
  press("stop", () => command({command: "stop", reason: "the set-up page"}));
  press("start", begin);
  press("once-more", async () => {
    await refreshOffers();
    await begin();
  });
  press("to-screen", () => {
    chooses = "screen";
    show();
  });
  press("to-camera", backToCamera);
  press("camera-again", backToCamera);
  press("camera-anew", backToCamera);
  press("tune", () => order("tune"));
  press("tune-next", () => order("tune_next"));
  press("tune-end", () => order("tune_end"));
  press("to-whole", async () => {
    if (!sizeIsSensible()) throw new Error(text("setup.size_wrong"));
    await goWhole(true);
  });
  press("to-whole-again", () => goWhole(false));
  press("repeat", () => repeatDots(news.result.repeat));
  press("confirm", () => order("confirm"));
  press("look-again", () => order("look_again"));
  press("back", () => order("back"));
  press("skip", () => order("skip"));
  press("save", () => order("save"));
  for (const button of document.querySelectorAll(".cancel")) onPress(button, () => order("cancel"));
  document.addEventListener("fullscreenchange", show);
  part("whole").addEventListener("resized", show);
}

// While the whole screen is shown; a focused button takes Enter by itself.
const KEYS = {Enter: "confirm", n: "look-again", Backspace: "back", s: "skip"};

function beginKeys() {
  document.addEventListener("keydown", (event) => {
    const button = part(KEYS[event.key] ?? "none");
    if (!isWhole() || !button || button.hidden || event.repeat) return;
    if (event.key === "Enter" && event.target instanceof HTMLButtonElement) return;
    event.preventDefault();
    button.click();
  });
}

function writeAll() {
  document.title = `${text("setup.title")} - telehug`;
  writeMonitors();
  show();
}

async function linkFurther() {
  const {web} = await command({command: "status"});
  const link = part("to-accuracy");
  link.hidden = !web.pages.includes(link.getAttribute("href").slice(1));
}

await beginPage(writeAll);
beginOrders();
beginKeys();
await refreshOffers();
offerMonitors(offers);
document.querySelector(`input[name=mode][value=${offers.chosen.mode}]`).checked = true;
writeAll();
follow({setup: hear}, {inBackground: true});  // or it would end when somebody looks something up
await linkFurther();
