// SPDX-License-Identifier: Apache-2.0
// The wearer's picture as the daemon draws it (jacket/body_svg.hpp), with the boxes laid over it.
import {command, make, onPress, text} from "/shared/page.js";

const BOXES = 25;  // of the picture's five rows
const COLUMNS = 5;

const place = document.getElementById("picture");
let shapes = new Map();  // by an actuator's id
let running = new Set();
let muted = new Set();

// The svg's own style is for files; here the page's counts, and is the only one that is permitted.
function parsed(svg) {
  const plain = svg.replace(/<style>.*?<\/style>/s, "");
  const picture = new DOMParser().parseFromString(plain, "image/svg+xml").documentElement;
  picture.setAttribute("aria-hidden", "true");
  picture.removeAttribute("role");
  return document.importNode(picture, true);
}

function laidOver(grid, picture, body) {
  const [x, y, width, height] = body.dataset.grid.split(" ").map(Number);
  const whole = picture.viewBox.baseVal;
  Object.assign(grid.style, {
    left: `${100 * x / whole.width}%`, top: `${100 * y / whole.height}%`,
    width: `${100 * width / whole.width}%`, height: `${100 * height / whole.height}%`,
  });
  return grid;
}

function boxButton(number, refresh) {
  const button = make("button", {type: "button", tabIndex: number === 1 ? 0 : -1});
  button.dataset.box = number;
  onPress(button, async () => {
    await command({command: muted.has(number) ? "unmute" : "mute", boxes: [number]});
    await refresh();
  });
  return button;
}

// One stop of the tab key; arrows move within.
function moveByArrows(grid) {
  const steps = {ArrowLeft: -1, ArrowRight: 1, ArrowUp: -COLUMNS, ArrowDown: COLUMNS};
  grid.addEventListener("keydown", (event) => {
    const from = Number(document.activeElement.dataset.box);
    const to = from + (steps[event.key] ?? 0);
    if (!steps[event.key] || !from || to < 1 || to > BOXES) return;
    event.preventDefault();
    document.activeElement.tabIndex = -1;
    const next = grid.querySelector(`[data-box="${to}"]`);
    next.tabIndex = 0;
    next.focus();
  });
}

function grids(picture, refresh) {
  const laid = [];
  for (const body of picture.querySelectorAll("[data-grid]")) {
    const front = body.dataset.side === "front";
    const grid = laidOver(make("div", {className: "boxes"}), picture, body);
    for (let number = 1; number <= BOXES; ++number) {
      const box = front ? boxButton(number, refresh) : make("div");
      box.dataset.box = number;
      grid.append(box);
    }
    if (front) {
      grid.setAttribute("role", "group");
      grid.dataset.label = "picture.boxes";
      moveByArrows(grid);
    } else {
      grid.setAttribute("aria-hidden", "true");
      grid.style.pointerEvents = "none";
    }
    laid.push(grid);
  }
  return laid;
}

// `jacket`: what the command "jacket" answers with svg. `refresh` is called after a box was muted or unmuted.
export function drawPicture(jacket, refresh) {
  const picture = parsed(jacket.svg);
  shapes = new Map([...picture.querySelectorAll("[data-actuator]")].map((group) =>
    [Number(group.dataset.actuator), group.querySelector("circle, rect")]));
  place.replaceChildren(picture, ...grids(picture, refresh));
  writePicture();
  showRunning([...running]);
  showMuted([...muted]);
}

// What in it is text of the page's language.
export function writePicture() {
  for (const body of place.querySelectorAll("[data-side]"))
    body.querySelector(".caption").textContent = text(`picture.${body.dataset.side}`);
  for (const grid of place.querySelectorAll("[data-label]"))
    grid.setAttribute("aria-label", text(grid.dataset.label));
  showMuted([...muted]);
}

export function showRunning(ids) {
  running = new Set(ids);
  for (const [id, shape] of shapes)
    if (!shape.classList.contains("off")) shape.setAttribute("class", running.has(id) ? "runs" : "rests");
}

export function showMuted(boxes) {
  muted = new Set(boxes);
  for (const box of place.querySelectorAll("[data-box]")) {
    const isMuted = muted.has(Number(box.dataset.box));
    box.classList.toggle("muted", isMuted);
    if (box.tagName !== "BUTTON") continue;
    box.setAttribute("aria-pressed", isMuted);
    box.setAttribute("aria-label",
                     text(isMuted ? "picture.box_muted" : "picture.box_open", {number: box.dataset.box}));
  }
}
