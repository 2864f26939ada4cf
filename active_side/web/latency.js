// SPDX-License-Identifier: Apache-2.0
// How long each stage takes, as numbers and bars.
import {make, text} from "/shared/page.js";

const SPACE = "http://www.w3.org/2000/svg";
// On the way of a touch, in its order; what else there is stands as the daemon calls it.
const STAGES = ["camera", "frame_check", "finger", "touch", "box", "publish", "frame_to_published"];
const TOTAL = "frame_to_published";

const rows = document.querySelector("#latency tbody");

function bar(attributes) {
  const made = document.createElementNS(SPACE, "rect");
  for (const [name, value] of Object.entries({y: 1, height: 8, x: 0, ...attributes})) made.setAttribute(name, value);
  return made;
}

function bars(stage, longest) {
  const svg = document.createElementNS(SPACE, "svg");
  svg.setAttribute("viewBox", "0 0 100 10");
  svg.setAttribute("preserveAspectRatio", "none");
  svg.setAttribute("aria-hidden", "true");
  const width = (ms) => Math.min(100, Math.max(0.5, 100 * ms / longest));
  svg.append(bar({class: "usual", width: width(stage.p50)}), bar({class: "slow", width: width(stage.p99)}));
  return svg;
}

const inMs = (ms) => `${ms < 1 ? ms.toFixed(2) : ms.toFixed(1)} ms`;

function row(name, stage, longest) {
  return make("tr", {className: name === TOTAL ? "total" : ""},
              make("th", {scope: "row", textContent: STAGES.includes(name) ? text(`stage.${name}`) : name}),
              make("td", {textContent: inMs(stage.p50)}), make("td", {textContent: inMs(stage.p99)}),
              make("td", {}, bars(stage, longest)));
}

// latency_ms of the status, and how long it takes to the other side if that is known.
export function showLatency(stages, oneWayMs) {
  const known = STAGES.filter((name) => stages[name]?.count > 0);
  const shown = known.map((name) => [name, stages[name]]);
  const longest = Math.max(0.001, ...shown.map(([, stage]) => stage.p99));
  rows.replaceChildren(...shown.map(([name, stage]) => row(name, stage, longest)));
  if (shown.length === 0) rows.append(make("tr", {}, make("td", {colSpan: 4, textContent: text("latency.none")})));
  if (oneWayMs !== undefined)
    rows.append(make("tr", {}, make("th", {scope: "row", textContent: text("latency.one_way")}),
                     make("td", {textContent: inMs(oneWayMs)}), make("td", {colSpan: 2})));
}
