// SPDX-License-Identifier: Apache-2.0
// Which monitor the camera looks along, and how large it is.
import {make, text, write} from "/shared/page.js";

const CARD_MM = {width: 85.6, height: 53.98};  // ISO/IEC 7810 ID-1

const part = (id) => document.getElementById(id);
const fields = {width: part("width"), height: part("height")};
const card = part("card");
const slider = part("card-slider");
let monitors = [];

const screenPx = () => ({width: Math.round(screen.width * devicePixelRatio), height: Math.round(screen.height * devicePixelRatio)});

// Nothing if no monitor is known.
export const chosenMonitor = () => monitors.find((monitor) => monitor.name === part("monitors").value);

function monitorPx() {
  const monitor = chosenMonitor();
  return monitor ? {width: monitor.width_px, height: monitor.height_px} : screenPx();
}

// Millimetres of a CSS pixel across, by the width in its field.
const mmPerPx = () => Number(fields.width.value) / monitorPx().width * devicePixelRatio;

function drawCard() {
  const mm = mmPerPx();
  if (!(mm > 0)) return;
  card.style.width = `${CARD_MM.width / mm}px`;
  card.style.height = `${CARD_MM.height / mm}px`;
  slider.value = String(CARD_MM.width / mm);
}

function setSize(width_mm, height_mm) {
  fields.width.value = width_mm > 0 ? width_mm.toFixed(1) : "";
  fields.height.value = height_mm > 0 ? height_mm.toFixed(1) : "";
  drawCard();
}

// The card's width in pixels tells how large a pixel is, and so all of the screen.
function sizeByCard() {
  const mm = CARD_MM.width / Number(slider.value) / devicePixelRatio;
  const px = monitorPx();
  setSize(px.width * mm, px.height * mm);
}

export function writeMonitors() {
  const names = part("monitors");
  const chosen = names.value;
  names.replaceChildren(...monitors.map((monitor) => make("option", {
    value: monitor.name, textContent: `${monitor.name}: ${monitor.width_px} × ${monitor.height_px}`})));
  if (monitors.length === 0) names.append(make("option", {value: "", textContent: text("setup.monitor_this")}));
  if (monitors.some((monitor) => monitor.name === chosen)) names.value = chosen;
  sayWhence();
}

function sayWhence() {
  const monitor = chosenMonitor();
  write(part("size-from"), text(`setup.size_${monitor ? monitor.size_from : "nowhere"}`));
}

function choose() {
  const monitor = chosenMonitor();
  if (monitor) setSize(monitor.width_mm, monitor.height_mm);
  sayWhence();
}

// `offers`: what the order "list" answers.
export function offerMonitors(offers) {
  monitors = offers.monitors;
  writeMonitors();
  const {monitor, width_mm, height_mm} = offers.chosen;
  const before = monitors.find((one) => one.name === monitor);
  if (monitors.length > 0) part("monitors").value = (before ?? monitors.find((one) => one.primary) ?? monitors[0]).name;
  choose();
  // What a person has measured is better than what a monitor says of itself.
  if (width_mm > 0 && height_mm > 0 && (before || monitors.length === 0)) setSize(width_mm, height_mm);
  sayWhence();
}

// As a set-up that runs was begun with.
export function restoreScreen({monitor, width_mm, height_mm}) {
  if (monitors.some((one) => one.name === monitor)) part("monitors").value = monitor;
  setSize(width_mm, height_mm);
  sayWhence();
}

// Of the visible screen; NaN where nothing sensible is written.
export const chosenSize = () => ({width_mm: fields.width.valueAsNumber, height_mm: fields.height.valueAsNumber});

// Why this window does not cover the monitor, as far as the browser tells; "" if it seems to. `canvas` has device pixels.
export function whyNotCovered(canvas, isWhole) {
  const monitor = chosenMonitor();
  if (!isWhole) return text("setup.not_whole");
  const wanted = monitor ? monitorPx() : screenPx();
  if (Math.abs(canvas.width - wanted.width) > 1 || Math.abs(canvas.height - wanted.height) > 1)
    return text("setup.other_pixels", {has: `${canvas.width} × ${canvas.height}`, wants: `${wanted.width} × ${wanted.height}`,
                                       name: monitor?.name ?? text("setup.monitor_this")});
  // Not every browser tells where its screen is.
  const {isExtended, left, top} = screen;
  const elsewhere = isExtended && monitor && left !== undefined &&
      (Math.abs(left * devicePixelRatio - monitor.x_px) > 2 || Math.abs(top * devicePixelRatio - monitor.y_px) > 2);
  return elsewhere ? text("setup.other_monitor", {name: monitor.name}) : "";
}

part("monitors").addEventListener("change", choose);
for (const field of Object.values(fields)) field.addEventListener("input", drawCard);
slider.addEventListener("input", sizeByCard);
