// SPDX-License-Identifier: Apache-2.0
// What a calibration is worth: errors at the dots, and those to be expected all over the screen.
import {make, text} from "/shared/page.js";

const SPACE = "http://www.w3.org/2000/svg";
// mm of standard deviation, and colours on which dark figures can be read (4.5:1 and more).
const STEPS = [[1, "#7fdca4"], [2, "#c9e265"], [4, "#ffd166"], [8, "#ffab6b"], [Infinity, "#ff8a85"]];
const WIDTH = 480;

const part = (id) => document.getElementById(id);

function shape(tag, attributes, ...children) {
  const made = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const signed = (mm) => {
  const rounded = Math.abs(mm).toFixed(1);
  return `${rounded === "0.0" ? "" : mm < 0 ? "−" : "+"}${rounded} mm`;
};
const colourOf = (mm) => STEPS.find(([most]) => mm <= most)[1];

function stateOf(dot) {
  if (dot.skipped) return text("setup.dot_skipped");
  return text(dot.used ? "setup.dot_used" : "setup.dot_unused");
}

function dotRow(dot, number, repeat) {
  const again = make("button", {textContent: text("setup.repeat_one")});
  again.setAttribute("aria-label", text("setup.repeat_dot", {number: number + 1}));
  again.addEventListener("click", () => repeat([number]));
  const [x, y] = dot.error_mm ? dot.error_mm.map(signed) : ["–", "–"];
  return make("tr", {}, make("th", {scope: "row", textContent: String(number + 1)}), make("td", {className: "number", textContent: x}),
              make("td", {className: "number", textContent: y}), make("td", {}, stateOf(dot), " ", again));
}

// Of both directions together.
function fieldErrors({columns, rows, horizontal_mm, vertical_mm}) {
  return Array.from({length: rows}, (_, row) => Array.from({length: columns}, (__, column) => {
    const at = row * columns + column;
    return horizontal_mm[at] === null ? null : Math.hypot(horizontal_mm[at], vertical_mm[at]);
  }));
}

function drawMap(result, screen) {
  const fields = fieldErrors(result.errors);
  const height = WIDTH * screen.height_mm / screen.width_mm;
  const cell = {width: WIDTH / result.errors.columns, height: height / result.errors.rows};
  const parts = fields.flatMap((row, y) => row.flatMap((mm, x) => {
    if (mm === null) return [];
    const label = shape("text", {x: (x + 0.5) * cell.width, y: (y + 0.5) * cell.height});
    label.textContent = mm.toFixed(1);
    return [shape("rect", {x: x * cell.width, y: y * cell.height, width: cell.width, height: cell.height, fill: colourOf(mm)}),
            ...(cell.width >= 22 && cell.height >= 12 ? [label] : [])];
  }));
  const outline = result.reach.map(([x, y]) => `${x / screen.width_mm * WIDTH},${y / screen.height_mm * height}`);
  part("map").replaceChildren(shape("svg", {viewBox: `0 0 ${WIDTH} ${height}`, "aria-hidden": "true"}, ...parts,
                                    shape("polygon", {class: "reach", points: outline.join(" ")})));
  part("map-numbers").tBodies[0].replaceChildren(...fields.map((row) => make("tr", {}, ...row.map((mm) =>
    make("td", {textContent: mm === null ? text("setup.map_unseen") : `${mm.toFixed(1)} mm`})))));
}

// `state`: of the topic "setup", with a result. `repeat` is called with the numbers of dots to touch again.
export function showResult(state, repeat) {
  const {result, show} = state;
  part("dots").tBodies[0].replaceChildren(...result.dots.map((dot, number) => dotRow(dot, number, repeat)));
  part("faults").replaceChildren(...result.faults.map((fault) => make("li", {lang: "en", textContent: fault})));
  part("faults").hidden = result.faults.length === 0;
  part("remarks").replaceChildren(...result.remarks.map((remark) => make("li", {lang: "en", textContent: remark})));
  const known = result.errors.columns > 0;
  for (const id of ["map-title", "map", "map-numbers"]) part(id).hidden = !known;
  part("map").nextElementSibling.hidden = !known;
  if (known) drawMap(result, show);
}
