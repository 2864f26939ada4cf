// SPDX-License-Identifier: Apache-2.0
// Drawing and writing on the screen with the fingers, a mouse, a pen or the keys.
import {beginPage, make, onPress, text, write} from "/shared/page.js";
import {Drawing} from "./drawing/drawing.js";
import {Fingers} from "./fingers/fingers.js";
import {KeyboardPen} from "./drawing/keyboard_pen.js";
import {palettes} from "./drawing/palette.js";
import {ScreenPlace} from "./fingers/screen_place.js";
import {drawStrokes, StrokeCanvas} from "./drawing/stroke_canvas.js";
import {svgOfDrawing} from "./drawing/svg_of_drawing.js";

const WIDTHS_MM = [1, 2, 4, 7, 12];

const part = (id) => document.getElementById(id);
const canvas = part("paper");
const drawing = new Drawing();
const shown = new StrokeCanvas(canvas, drawing);
const pen = new KeyboardPen();
const place = new ScreenPlace(lookAgain);
let paper = "dark";
let looks = {colour: 0, width_mm: WIDTHS_MM[2]};
let map;

const palette = () => palettes[paper];

// What is done is said to screen readers, too.
function say(key, values) {
  write(part("said"), text(key, values));
}

function refresh() {
  shown.refresh();
  part("undo").disabled = !drawing.canUndo;
  part("redo").disabled = !drawing.canRedo;
}

function placePen() {
  part("pen").hidden = pen.place === null;
  if (pen.place === null) return;
  const {x, y} = map.toPage(pen.place);
  Object.assign(part("pen").style, {left: `${x}px`, top: `${y}px`});
  part("pen").style.borderColor = palette().colours[looks.colour];
  part("pen").style.background = pen.isDown ? palette().colours[looks.colour] : "";
}

function lookAgain() {
  map = place.map;
  canvas.className = paper;
  const reach = place.size?.reach_mm ?? [];
  part("reach").hidden = reach.length === 0;
  shown.show(map, palette(), reach.map(([x_mm, y_mm]) => ({x_mm, y_mm})));
  placePen();
  for (const [i, button] of [...part("colours").children].entries())
    button.querySelector("i").style.background = palette().colours[i];
}

function choose(colour) {
  looks = {...looks, colour};
  for (const [i, button] of [...part("colours").children].entries())
    button.setAttribute("aria-pressed", String(i === colour));
  placePen();
  say("draw.now_colour", {name: text(`colour.${colour + 1}`)});
}

function widen(steps) {
  const at = WIDTHS_MM.indexOf(looks.width_mm) + steps;
  looks = {...looks, width_mm: WIDTHS_MM[Math.min(WIDTHS_MM.length - 1, Math.max(0, at))]};
  write(part("width"), text("draw.width", {mm: looks.width_mm}));
}

function change(act, key) {
  act();
  pen.isDown = false;
  placePen();
  refresh();
  say(key);
}

function save(blob, ending) {
  const link = make("a", {href: URL.createObjectURL(blob), download: `telehug.${ending}`});
  link.click();
  URL.revokeObjectURL(link.href);
  say("draw.saved");
}

function saveSvg() {
  save(new Blob([svgOfDrawing(drawing.strokes, map, palette())], {type: "image/svg+xml"}), "svg");
}

async function savePng() {
  const picture = make("canvas", {width: place.size?.width_px || screen.width,
                                  height: place.size?.height_px || screen.height});
  const context = picture.getContext("2d");
  context.fillStyle = palette().paper;
  context.fillRect(0, 0, picture.width, picture.height);
  const whole = {x_px_per_mm: picture.width / map.width_mm, y_px_per_mm: picture.height / map.height_mm, left_px: 0,
                 top_px: 0};
  drawStrokes(context, drawing.strokes, whole, 1, palette().colours);
  save(await new Promise((made) => picture.toBlob(made)), "png");
}

async function turnFullScreen() {
  if (document.fullscreenElement) return document.exitFullscreen();
  return document.documentElement.requestFullscreen();
}

const hand = (id) => `finger ${id}`;
const fingers = new Fingers({
  down: (id, point) => {
    drawing.begin(hand(id), point, looks);
    refresh();
  },
  move: (id, point) => {
    drawing.extend(hand(id), point);
    refresh();
  },
  up: (id) => {
    drawing.end(hand(id));
    refresh();
  },
}, (size) => place.resize(size));

// By the button's id; the key that does the same.
const actions = {
  run: ["s"],
  undo: ["z", () => change(() => drawing.undo(), "draw.undone")],
  redo: ["y", () => change(() => drawing.redo(), "draw.redone")],
  "other-paper": ["b", () => {
    paper = paper === "dark" ? "light" : "dark";
    lookAgain();
    writeAgain();
  }],
  clear: ["c", () => change(() => drawing.clear(), "draw.cleared")],
  thinner: ["-", () => widen(-1)],
  wider: ["+", () => widen(1)],
  png: ["p", savePng],
  svg: ["v", saveSvg],
  full: ["f", turnFullScreen],
  bar: ["h", () => {
    part("tools").hidden = !part("tools").hidden;
    part("bar").setAttribute("aria-expanded", String(!part("tools").hidden));
  }],
};

function usePen(event) {
  const did = pen.press(event.key, event.shiftKey, map);
  if (!did) return false;
  if (did === "down") drawing.begin("pen", pen.place, looks);
  if (did === "moved") drawing.extend("pen", pen.place);
  if (did === "up") drawing.end("pen");
  if (did !== "moved") say(did === "down" ? "draw.pen_down" : "draw.pen_up");
  placePen();
  refresh();
  return true;
}

function onKey(event) {
  if (event.altKey || event.metaKey || event.target.closest("select")) return;
  const key = event.key.toLowerCase();
  const undoes = event.ctrlKey && ["z", "y"].includes(key);
  if (event.ctrlKey && !undoes) return;
  if (event.target === canvas && usePen(event)) {
    event.preventDefault();
    return;
  }
  const id = undoes && event.shiftKey ? "redo" : Object.keys(actions).find((one) => actions[one][0] === key);
  if (id) {
    event.preventDefault();
    part(id).click();
  } else if (key >= "1" && key <= "8" && key.length === 1) {
    choose(Number(key) - 1);
  }
}

function beginPointers() {
  const at = (event) => map.toScreen({x: event.offsetX, y: event.offsetY});
  const id = (event) => `pointer ${event.pointerId}`;
  canvas.addEventListener("pointerdown", (event) => {
    // A touchscreen that telehug itself feeds would draw everything twice.
    if (event.button !== 0 || (event.pointerType === "touch" && fingers.on)) return;
    canvas.setPointerCapture(event.pointerId);
    drawing.begin(id(event), at(event), looks);
    refresh();
  });
  canvas.addEventListener("pointermove", (event) => {
    const all = event.getCoalescedEvents?.() ?? [];
    for (const one of all.length > 0 ? all : [event]) drawing.extend(id(event), at(one));
    if (event.buttons !== 0) refresh();
  });
  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, (event) => {
      drawing.end(id(event));
      refresh();
    });
  }
}

function makeColours() {
  part("colours").replaceChildren(...palette().colours.map((_, i) => {
    const button = make("button", {}, make("i"), make("span", {className: "only-read"}), " ",
                        make("kbd", {textContent: String(i + 1)}));
    button.addEventListener("click", () => choose(i));
    return button;
  }));
}

function writeAgain() {
  for (const [i, button] of [...part("colours").children].entries())
    write(button.querySelector("span"), text(`colour.${i + 1}`));
  write(part("other-paper").querySelector("span"), text(`draw.to_${paper === "dark" ? "light" : "dark"}`));
  document.title = `${text("draw.title")} - telehug`;
  widen(0);
  fingers.writeAgain();
}

await beginPage(writeAgain);
makeColours();
for (const [id, [key, act]] of Object.entries(actions)) {
  if (act) onPress(part(id), act);
  part(id).setAttribute("aria-keyshortcuts", key);
  part(id).append(" ", make("kbd", {textContent: key.toUpperCase()}));
}
lookAgain();
await fingers.begin();
choose(0);
writeAgain();
beginPointers();
document.addEventListener("keydown", onKey);
refresh();
canvas.focus();
