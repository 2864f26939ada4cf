// SPDX-License-Identifier: Apache-2.0
// The full screen with the dots. Its picture is measured in mm, since it covers the whole calibrated screen.
const SVG = "http://www.w3.org/2000/svg";
const DOT_MM = 3;
const UNSEEN_MM = 1.5;
const FOUND_MM = 2;
const RING_MM = 8;
const CROSS_MM = 3;
const SETTLES_MS = 1500;

const part = (id) => document.getElementById(id);

function shape(tag, kind, values) {
  const made = document.createElementNS(SVG, tag);
  made.setAttribute("class", kind);
  for (const [name, value] of Object.entries(values)) made.setAttribute(name, value);
  return made;
}
const circle = (kind, {x_mm, y_mm}, r) => shape("circle", kind, {cx: x_mm, cy: y_mm, r});
const cross = ({x_mm, y_mm}) => shape("path", "missed", {
  d: `M${x_mm - CROSS_MM} ${y_mm - CROSS_MM}l${2 * CROSS_MM} ${2 * CROSS_MM}m0 ${-2 * CROSS_MM}l${-2 * CROSS_MM} ${2 * CROSS_MM}`});

function shapesOf({dot, outcome, place}) {
  if (outcome === "skipped") return [circle("unseen", dot, UNSEEN_MM)];
  if (outcome === "missed") return [circle("dot", dot, DOT_MM), cross(dot)];
  return [circle("dot", dot, DOT_MM), ...(outcome === "found" ? [circle("found", place, FOUND_MM)] : [])];
}

// unseen: dots that are not touched. The ring is around the dot that is to be touched now, which goes out while it is
// touched; the panel keeps away from it.
export function drawDots({width_mm, height_mm}, unseen, check, isTouched) {
  const svg = part("dots");
  svg.setAttribute("viewBox", `0 0 ${width_mm} ${height_mm}`);
  svg.replaceChildren(...unseen.map((dot) => circle("unseen", dot, UNSEEN_MM)),
                      ...check.results.flatMap((result) => isTouched && result.dot === check.dot ? [] : shapesOf(result)));
  if (check.dot === null) return;
  if (!isTouched) svg.append(circle("ring-back", check.dot, RING_MM), circle("ring", check.dot, RING_MM));
  part("panel").classList.toggle("below", check.dot.y_mm < height_mm / 2);
}

export function clearDots() {
  part("dots").replaceChildren();
}

// Waits until `isCovering`, which becomes true some time after the browser has agreed.
async function settled(isCovering) {
  const end = performance.now() + SETTLES_MS;
  while (!isCovering()) {
    if (performance.now() > end) return false;
    await new Promise((drawn) => requestAnimationFrame(drawn));
  }
  return true;
}

// False: the browser refused, or its window does not cover the screen.
export async function fillScreen(isCovering) {
  part("stage").hidden = false;
  try {
    await part("stage").requestFullscreen({navigationUI: "hide"});
    if (await settled(isCovering)) return true;
  } catch {
    // What is said is the same.
  }
  await leaveScreen();
  return false;
}

export async function leaveScreen() {
  part("stage").hidden = true;
  if (document.fullscreenElement) await document.exitFullscreen();
}
