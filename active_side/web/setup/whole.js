// SPDX-License-Identifier: Apache-2.0
// The set-up on the whole screen: what the camera is to see, and on the upper third what the person is to do.
import {text, write, writeWithSaid} from "/shared/page.js";
import {drawShown} from "/setup/pages.js";
import {placePreview} from "/setup/preview.js";
import {whyNotCovered} from "/setup/screen.js";

const SETTLED_MS = 300;
const LONGEST_MS = 5000;
const RING_STEPS = 8;  // it is still for most of the time: what moves can be seen in the pictures

const part = (id) => document.getElementById(id);
const whole = part("whole");
const canvas = part("shown");
const ring = document.querySelector("#ring .done");
let drawn = "";
let uncovered = "";     // why the window does not cover the monitor, while that is asked about
let answer = () => {};  // to that
let whenResized = () => {};

const pixels = () => ({width_px: canvas.width, height_px: canvas.height});

// In the screen's own pixels, whatever the zoom.
new ResizeObserver(([entry]) => {
  const box = entry.devicePixelContentBoxSize?.[0];
  canvas.width = box?.inlineSize ?? Math.round(innerWidth * devicePixelRatio);
  canvas.height = box?.blockSize ?? Math.round(innerHeight * devicePixelRatio);
  drawn = "";
  whenResized();
  whole.dispatchEvent(new Event("resized"));
}).observe(canvas);

// Also a window that somebody has made as large as the screen (F11), where the browser lets no page do so.
const coversScreen = () => innerWidth >= screen.width && innerHeight >= screen.height;
let inWindow = false;

export const isWhole = () => document.fullscreenElement === whole || (inWindow && coversScreen());

// Frames are drawn, or, where they come slowly or the window can't be seen, some time has passed.
const nextFrame = () => new Promise((done) => {
  requestAnimationFrame(done);
  setTimeout(done, 100);
});

// Until the window is drawn, and has been as large as it is for a while.
async function settled() {
  const end = performance.now() + LONGEST_MS;
  for (let before = "", since = performance.now(); performance.now() < end;) {
    await nextFrame();
    const now = canvas.width > 0 ? JSON.stringify(pixels()) : "";
    if (now !== before || now === "") since = performance.now();
    before = now;
    if (performance.now() - since > SETTLED_MS) return;
  }
}

// A window that was moved, or has grown only now, needs no answer any more.
function askAgain(ask) {
  uncovered = whyNotCovered(canvas, isWhole());
  if (uncovered === "") answer(true);
  else ask();
}

// To be called when a button was pressed. How many pixels the whole screen has; nothing if the person has left it.
// `ask`: shows the question why the window does not cover the monitor.
export async function enterWhole(ask) {
  whole.hidden = false;
  try {
    await whole.requestFullscreen({navigationUI: "hide"});
  } catch {
    inWindow = coversScreen();
    whole.hidden = !inWindow;
    if (!inWindow) throw new Error(text("setup.no_whole"));
    ask();
  }
  part("panel").focus();
  await settled();
  uncovered = whyNotCovered(canvas, isWhole());
  if (uncovered !== "") {
    ask();
    const anyway = await new Promise((done) => {
      answer = done;
      whenResized = () => askAgain(ask);
    });
    whenResized = () => {};
    uncovered = "";
    if (!anyway) return undefined;
  }
  return isWhole() ? pixels() : undefined;
}

export async function leaveWhole() {
  if (document.fullscreenElement === whole) await document.exitFullscreen();
  else if (inWindow) leftWindow();
}

function leftWindow() {
  inWindow = false;
  left();
  whole.dispatchEvent(new Event("resized"));
}

function left() {
  if (isWhole()) return;
  whole.hidden = true;
  answer(false);
}

function showProgress(part) {
  const step = Math.round(part * RING_STEPS) / RING_STEPS;
  ring.setAttribute("stroke-dasharray", `${100 * step} 100`);
}

// `words`: title, advice, and the daemon's refusal of the last order. `shows`: of the topic "setup"; `can`: what can be done.
export function showWhole(state, words) {
  whole.hidden = !isWhole();
  if (whole.hidden) return;
  const asks = uncovered !== "";
  const {show, can} = state;
  const page = asks ? "none" : show.page;
  whole.dataset.page = page;
  const newest = JSON.stringify([page, show, canvas.width, canvas.height]);
  if (newest !== drawn) {
    drawn = newest;
    drawShown(canvas, {...show, page, dots: asks ? [] : show.dots});
  }
  const bright = page === "triangle";
  part("whole-picture").hidden = !bright;
  placePreview(bright ? part("whole-picture") : null);
  write(part("whole-title"), asks ? text("setup.not_covered") : words.title);
  writeWithSaid(part("whole-advice"), asks ? uncovered : words.advice, asks ? "" : words.refusal);
  showProgress(asks ? 0 : state.progress);
  part("ring").toggleAttribute("hidden", asks);
  part("anyway").hidden = !asks;
  part("confirm").hidden = asks || !can.confirm;
  part("look-again").hidden = asks || !can.confirm;
  part("back").hidden = asks || !can.back || can.confirm;
  part("skip").hidden = asks || !can.skip;
}

part("anyway").addEventListener("click", () => answer(true));
part("leave").addEventListener("click", leaveWhole);
document.addEventListener("fullscreenchange", left);
window.addEventListener("resize", () => {
  if (inWindow && !coversScreen()) leftWindow();
});
document.addEventListener("keydown", (event) => {
  if (inWindow && event.key === "Escape") leftWindow();
});
