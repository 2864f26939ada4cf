// SPDX-License-Identifier: Apache-2.0
// The remote person as telehug sees them: the face and the numbered boxes, without any picture of the screen. Drawn in
// face heights from the chin, so that it stays where it is while the person moves about.
import {text} from "/shared/page.js";

const UNIT = 100;  // of the svg a face height
const SPACE = "http://www.w3.org/2000/svg";
const LEFT = -1.75;
const TOP = -1.45;
const BOX = 0.5;
const LEAST_NUMBER = 0.08;  // high: smaller ones can't be read

const place = document.getElementById("picture");
let drawn = "";
let mirrored = false;
let contacts = [];

function shape(tag, attributes, ...children) {
  const made = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(attributes))
    made.setAttribute(name, typeof value === "number" ? Math.round(value * UNIT) : value);
  made.append(...children);
  return made;
}

const box = (left, top, right, bottom) => ({x: left, y: top, width: right - left, height: bottom - top});

// From the monitor's pixels: edges of a place, in face heights from the middle of the chin; to a twentieth, so that a
// breath does not draw everything anew.
function edges(rect, places) {
  const {grid, columns, face} = places;
  const fh = {x: grid.w / columns / BOX, y: face.h};
  const rounded = (value) => Math.round(20 * value) / 20;
  return {left: rounded((rect.x - grid.x - grid.w / 2) / fh.x), right: rounded((rect.x + rect.w - grid.x - grid.w / 2) / fh.x),
          top: rounded((rect.y - grid.y) / fh.y), bottom: rounded((rect.y + rect.h - grid.y) / fh.y)};
}

// Only where a box is not cut so low that it can't be read.
function numberIn(number, left, top, right, bottom) {
  const high = Math.min(0.2, 0.6 * (bottom - top));
  if (high < LEAST_NUMBER) return [];
  const label = shape("text", {x: (left + right) / 2, y: (top + bottom) / 2, "font-size": high});
  label.textContent = number;
  return [label];
}

function boxes(places, visible) {
  const {columns, rows} = places;
  const all = [];
  for (let number = 1; number <= columns * rows; ++number) {
    const fromLeft = (number - 1) % columns;
    const column = places.mirrored ? columns - 1 - fromLeft : fromLeft;
    const row = Math.floor((number - 1) / columns);
    const left = Math.max((column - columns / 2) * BOX, visible.left);
    const right = Math.min((column + 1 - columns / 2) * BOX, visible.right);
    const top = Math.max(row * BOX, visible.top);
    const bottom = Math.min((row + 1) * BOX, visible.bottom);
    if (left >= right || top >= bottom) continue;
    all.push(shape("g", {class: "box", "data-box": String(number)}, shape("rect", box(left, top, right, bottom)),
                   ...numberIn(number, left, top, right, bottom)));
  }
  return all;
}

function person(face, outline) {
  const middle = (face.left + face.right) / 2;
  const body = `M -25 -30 V 15 C -90 25 -110 45 -115 110 V 2000 H 115 V 110 C 110 45 90 25 25 15 V -30 Z`;
  return shape("g", {class: "person", "clip-path": "url(#chat)"},
               shape("clipPath", {id: "chat"}, shape("rect", box(outline.left, outline.top, outline.right, outline.bottom))),
               shape("path", {d: body}),
               shape("ellipse", {cx: middle, cy: (face.top + face.bottom) / 2, rx: (face.right - face.left) / 2,
                                 ry: (face.bottom - face.top) / 2}));
}

// As far as the chat's picture reaches, where that is near enough to be seen here.
function outlineOf(visible, grid) {
  return {left: visible.left > grid.left ? visible.left : LEFT + 0.05, top: TOP + 0.05,
          right: visible.right < grid.right ? visible.right : -LEFT - 0.05, bottom: visible.bottom};
}

function draw(places) {
  const visible = edges(places.visible, places);
  const face = edges(places.face, places);
  const outline = outlineOf(visible, edges(places.grid, places));
  const height = visible.bottom - TOP + 0.05;
  place.replaceChildren(shape(
      "svg", {viewBox: [LEFT, TOP, -2 * LEFT, height].map((value) => Math.round(value * UNIT)).join(" "), "aria-hidden": "true"},
      shape("rect", {class: "outline", ...box(outline.left, outline.top, outline.right, outline.bottom)}),
      person(face, outline),
      shape("rect", {class: "face", ...box(face.left, face.top, face.right, face.bottom)}), ...boxes(places, visible),
      shape("g", {class: "fingers"})));
}

function drawNobody() {
  const note = shape("text", {class: "nobody", x: 0, y: 0, "font-size": 0.22});
  note.textContent = text("picture.nobody");
  place.replaceChildren(shape("svg", {viewBox: "-175 -100 350 200"},
                              shape("rect", {class: "outline", ...box(-1.7, -0.95, 1.7, 0.95)}), note));
}

// `places`: places_px of the status' face; undefined: nobody is seen.
export function showPlaces(places) {
  const key = places ? JSON.stringify([edges(places.visible, places), edges(places.face, places), places.rows, places.mirrored])
                     : text("picture.nobody");
  if (key === drawn) return;
  drawn = key;
  mirrored = places?.mirrored ?? false;
  if (places) draw(places);
  else drawNobody();
  showContacts(contacts);
}

const isFelt = (contact) => contact.answers.some((answer) => answer.outcome === "driven");

function showFingers(group) {
  while (group.children.length > contacts.length) group.lastChild.remove();
  while (group.children.length < contacts.length) group.append(shape("circle", {class: "finger", r: 0.06}));
  contacts.forEach((contact, i) => {
    group.children[i].setAttribute("cx", Math.round((mirrored ? -contact.x_fh : contact.x_fh) * UNIT));
    group.children[i].setAttribute("cy", Math.round(contact.y_fh * UNIT));
  });
}

function showBox(group, fingers) {
  const on = contacts.filter((contact) => contact.box === Number(group.dataset.box));
  const felt = on.some(isFelt);
  const looks = on.length === 0 ? "box" : felt ? "box touched felt" : "box touched";
  if (group.getAttribute("class") === looks) return;
  group.setAttribute("class", looks);
  const number = group.querySelector("text");
  if (number) number.textContent = felt ? `${group.dataset.box} ✓` : group.dataset.box;
  if (on.length > 0) group.parentNode.insertBefore(group, fingers);  // its outline lies above its neighbours'
}

// Those of the topic "touch".
export function showContacts(newest) {
  contacts = newest;
  const fingers = place.querySelector(".fingers");
  for (const group of place.querySelectorAll("[data-box]")) showBox(group, fingers);
  if (fingers) showFingers(fingers);
}
