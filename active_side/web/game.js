// SPDX-License-Identifier: Apache-2.0
// Pop the balloons: with the fingers, a mouse, or the key of their number.
import {beginPage, make, onPress, text, write} from "/shared/page.js";
import {BALLOONS, Balloons} from "./drawing/balloons.js";
import {Fingers} from "./fingers/fingers.js";
import {palettes} from "./drawing/palette.js";
import {ScreenPlace} from "./fingers/screen_place.js";

const LONGEST_STEP_S = 0.1;  // a page that was hidden does not leap

const KEYS = {run: "s", full: "f"};  // by the button's id

const part = (id) => document.getElementById(id);
const canvas = part("paper");
const balloons = new Balloons(Math.random);
let map;
let drawn;  // when
const place = new ScreenPlace(lookAgain);

function lookAgain() {
  map = place.map;
  canvas.width = Math.round(innerWidth * devicePixelRatio);
  canvas.height = Math.round(innerHeight * devicePixelRatio);
}

function showScore(number) {
  if (number) write(part("score"), text("game.score", {count: balloons.popped}));
}

const hit = (point) => showScore(balloons.hit(point, map));
const hands = {down: (_, point) => hit(point), move: (_, point) => hit(point), up: () => {}};
const fingers = new Fingers(hands, (size) => place.resize(size));

function draw(now) {
  balloons.step(Math.min(LONGEST_STEP_S, (now - (drawn ?? now)) / 1000), map);
  drawn = now;
  const {paper, colours} = palettes.dark;
  const context = canvas.getContext("2d");
  context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
  context.fillStyle = paper;
  context.fillRect(0, 0, innerWidth, innerHeight);
  context.font = "bold 28px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const balloon of balloons.all) {
    const {x, y} = map.toPage(balloon);
    context.fillStyle = colours[balloon.colour];
    context.beginPath();
    context.ellipse(x, y, balloon.radius_mm * map.x_px_per_mm, balloon.radius_mm * map.y_px_per_mm, 0, 0, 2 * Math.PI);
    context.fill();
    context.fillStyle = paper;
    context.fillText(String(balloon.number), x, y);
  }
  requestAnimationFrame(draw);
}

function writeAgain() {
  document.title = `${text("game.title")} - telehug`;
  write(part("score"), text("game.score", {count: balloons.popped}));
  fingers.writeAgain();
}

await beginPage(writeAgain);
lookAgain();
await fingers.begin();
balloons.begin(map);
for (const [id, key] of Object.entries(KEYS)) {
  part(id).setAttribute("aria-keyshortcuts", key);
  part(id).append(" ", make("kbd", {textContent: key.toUpperCase()}));
}
writeAgain();
onPress(part("full"), () =>
  document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen());
canvas.addEventListener("pointerdown", (event) => {
  if (event.pointerType !== "touch" || !fingers.on) hit(map.toScreen({x: event.offsetX, y: event.offsetY}));
});
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest("select")) return;
  const number = Number(event.key);
  for (const id of Object.keys(KEYS)) if (event.key.toLowerCase() === KEYS[id]) part(id).click();
  if (number >= 1 && number <= BALLOONS) showScore(balloons.pop(number, map));
});
requestAnimationFrame(draw);
