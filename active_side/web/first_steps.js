// SPDX-License-Identifier: Apache-2.0
// What is to be done before anybody can be touched, and the way to the page for it.
import {make, text} from "/shared/page.js";

const part = document.getElementById("first");
const list = document.getElementById("steps");

const wearers = (status) => status.peers ?? [{...status.peer, pair: status.pair}];

// Who is there without a pair is on this PC, and needs none.
const isPaired = (status) => wearers(status).some((one) => one.pair || one.connected);

function steps(status) {
  return [
    {key: "calibrate", done: status.calibrated, page: "/setup.html", ask: "first.calibrate", go: "first.go_calibrate",
     byHand: "first.calibrate_by_hand", ready: "first.calibrated"},
    {key: "pair", done: isPaired(status), page: "/pairing.html", ask: "first.pair", go: "first.go_pair",
     byHand: "first.pair_by_hand", ready: "first.paired"},
  ];
}

// `pages`: the names of those that there are.
const isThere = (page, pages) => pages.includes(page.slice(1));

function row(step, pages) {
  if (step.done) return make("li", {className: "done", textContent: `✓ ${text(step.ready)}`});
  const way = isThere(step.page, pages) ? make("a", {href: step.page, textContent: text(step.go)})
                                        : make("span", {textContent: text(step.byHand)});
  return make("li", {}, make("div", {textContent: text(step.ask)}), way);
}

// Once a tab and step: whoever comes back from there wants to be here.
function lead(step, pages) {
  if (!isThere(step.page, pages) || sessionStorage.getItem(`led-${step.key}`)) return;
  sessionStorage.setItem(`led-${step.key}`, "yes");
  location.assign(step.page);
}

// Some are of use only once there is a calibration.
function showLinks(pages, calibrated) {
  for (const link of document.querySelectorAll("#pages a"))
    link.hidden = !isThere(link.getAttribute("href"), pages) || (link.className === "calibrated" && !calibrated);
}

// Leads to the page of the first step that is left. `begins`: the page has just been opened.
export function showFirstSteps(status, begins) {
  const pages = status.web.pages;
  const all = steps(status);
  const next = all.find((step) => !step.done);
  showLinks(pages, status.calibrated);
  part.hidden = next === undefined;
  const shown = JSON.stringify([document.documentElement.lang, all.map((step) => step.done)]);
  if (list.dataset.shown !== shown) {
    list.dataset.shown = shown;
    list.replaceChildren(...all.map((step) => row(step, pages)));
  }
  if (next && begins) lead(next, pages);
}
