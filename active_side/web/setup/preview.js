// SPDX-License-Identifier: Apache-2.0
// What the camera sees, with the green band, the screen's edge, the triangle's vertex and the finger drawn over it.
// Pictures are asked for one after the other, and only while this can be seen.
import {text} from "/shared/page.js";

const SPACE = "http://www.w3.org/2000/svg";
const PAUSE_MS = 100;

function shape(tag, attributes) {
  const made = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

const view = document.createElement("div");
view.className = "preview";
view.setAttribute("role", "img");
const picture = document.createElement("canvas");
const overlay = shape("svg", {preserveAspectRatio: "none", "aria-hidden": "true"});
view.append(picture, overlay);

let runs = false;

async function drawNewest() {
  const response = await fetch("/picture/setup.jpg");
  if (response.status !== 200) return;
  const newest = await createImageBitmap(await response.blob());
  picture.width = newest.width;
  picture.height = newest.height;
  picture.getContext("2d").drawImage(newest, 0, 0);
  newest.close();
}

async function goOn() {
  while (runs) {
    await drawNewest().catch(() => {});  // that the daemon is gone is said by follow()
    await new Promise((done) => setTimeout(done, PAUSE_MS));
  }
}

// Nothing: it is not shown anywhere.
export function placePreview(container) {
  if (container && view.parentNode !== container) container.append(view);
  if (!container) view.remove();
  const begins = !runs && container !== null;
  runs = container !== null;
  if (begins) goOn();
}

// `state`: of the topic "setup".
export function drawOverlay(state) {
  const {width_px: width, height_px: height} = state.image;
  if (width === 0) {
    overlay.replaceChildren();
    return;
  }
  view.setAttribute("aria-label", text("setup.preview"));
  view.parentNode?.style.setProperty("aspect-ratio", `${width} / ${height}`);
  overlay.setAttribute("viewBox", `-0.5 -0.5 ${width} ${height}`);
  const parts = [];
  const {green_band: band, border, finger} = state;
  if (band) parts.push(shape("rect", {class: "band", x: 0, width: width - 1, y: band.top_px, height: band.bottom_px - band.top_px}));
  if (border) {
    parts.push(shape("polyline", {class: border.in_band ? "edge in" : "edge", points: border.points.map((point) => point.join(",")).join(" ")}));
    // Without the triangle on the screen it is something else's corner.
    if (border.vertex && state.show.page === "triangle") parts.push(shape("circle", {class: "vertex", cx: border.vertex[0], cy: border.vertex[1], r: 14}));
  }
  if (finger) parts.push(shape("circle", {class: "finger", cx: finger[0], cy: finger[1], r: 18}));
  overlay.replaceChildren(...parts);
}
