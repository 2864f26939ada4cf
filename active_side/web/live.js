// SPDX-License-Identifier: Apache-2.0
// The parent's page: whom they touch, where, and what of it is felt.
import {beginPage, command, follow, make, onPress, showProblems, text, write} from "/shared/page.js";
import {showContacts, showPlaces} from "/chat_picture.js";
import {showFirstSteps} from "/first_steps.js";
import {showLatency} from "/latency.js";
import {nearMiss} from "/near_miss.js";

// Why touches don't go out, as the status says it.
const WHY_NOT = {"switched off": "why.off", "a page uses the fingers": "why.used_here",
                 "the pinned window is not seen": "why.not_seen",
                 "another window covers the pinned one": "why.covered", "no window is pinned": "why.never_pinned",
                 "not calibrated": "why.not_calibrated"};
const NEAR_MS = 5000;
const HUG_S = 10;

const part = (id) => document.getElementById(id);
let status = null;
let touch = {contacts: []};
let near = {key: null, until: 0};

function nameOf(wearer) {
  return wearer || text("wearers.unnamed");
}

function outcomeText({outcome, box, wearer}) {
  return text(`outcome.${outcome.replaceAll(" ", "_")}`, {box, wearer: nameOf(wearer)});
}

function showTouch(newest) {
  touch = newest;
  showContacts(touch.contacts);
  const last = touch.contacts.at(-1);
  if (last && last.answers.length > 0)
    write(part("answer"), last.answers.map((answer) => outcomeText({...answer, box: last.box})).join(" "));
  else if (last) write(part("answer"), text("outcome.waits", {box: last.box}));
  else if (touch.answer) write(part("answer"), text("outcome.last", {answer: outcomeText(touch.answer)}));
  else write(part("answer"), text("outcome.none"));
}

// A finger that touched nobody is told for a while.
function showNear(counters) {
  const before = status?.counters;
  const now = performance.now();
  const key = before && nearMiss(before, counters);
  if (key) near = {key, until: now + NEAR_MS};
  write(part("near"), near.key && now < near.until ? text(near.key) : "");
}

function wearerText(wearer) {
  const name = nameOf(wearer.pair?.name);
  if (!wearer.connected) return text("wearers.away", {name});
  if (wearer.stopped) return text("wearers.stopped", {name});
  return text(wearer.ready === false ? "wearers.not_ready" : "wearers.here", {name});
}

function showWearers() {
  const all = (status.peers ?? [{...status.peer, pair: status.pair}]).filter((one) => one.pair || one.connected);
  const rows = all.map((one) => ({line: wearerText(one), here: one.connected && one.ready !== false,
                                  why: one.connected ? one.reason : ""}));
  if (rows.length === 0) rows.push({line: text("wearers.nobody"), here: false});
  const shown = JSON.stringify(rows);
  if (part("wearers").dataset.shown === shown) return;
  part("wearers").dataset.shown = shown;
  part("wearers").replaceChildren(...rows.map(({line, here, why}) => make(
      "li", {className: here ? "here" : ""}, line, ...(why ? [" ", make("span", {lang: "en", textContent: why})] : []))));
}

function showSending({name, on, why}) {
  for (const button of document.querySelectorAll("[data-mode]"))
    button.setAttribute("aria-pressed", button.dataset.mode === name);
  write(part("sending"), on ? text("sending.goes_out") : text("sending.held", {why: text(WHY_NOT[why])}));
}

function showHugs(hug) {
  const fresh = hug && hug.s_ago < HUG_S;
  write(part("hugged"), fresh ? text("hug.got", {name: hug.from}) : "");
}

function showStatus(newest) {
  const begins = status === null;
  showNear(newest.counters);
  status = newest;
  document.title = `${text("title")} - telehug`;
  write(part("state"), text(`state.${status.state}`));
  part("stopped").hidden = status.state !== "stopped";
  showFirstSteps(status, begins);
  part("picture-part").hidden = !status.calibrated;
  showPlaces(status.face.places_px);
  showWearers();
  showSending(status.sending);
  showHugs(status.last_hug);
  part("other-face").hidden = status.face.others === 0;
  showLatency(status.latency_ms, status.peer?.one_way_ms);
  showProblems(part("problems"), status.problems);
  part("problems-part").hidden = status.problems.length === 0;
}

async function refresh() {
  showStatus(await command({command: "status"}));
}

// A button that orders something of the daemon.
function onOrder(button, order) {
  onPress(button, async () => {
    await command(order);
    await refresh();
  });
}

function beginOrders() {
  onOrder(part("stop"), {command: "stop", reason: "the parent's page"});
  onOrder(part("resume"), {command: "resume"});
  onOrder(part("other-face"), {command: "face", order: "next"});
  for (const button of document.querySelectorAll("[data-mode]"))
    onOrder(button, {command: "send", mode: button.dataset.mode});
  onPress(part("hug"), async () => {
    write(part("hug-note"), "");
    await command({command: "hug"});
    write(part("hug-note"), text("hug.sent"));
  });
}

function writeAll() {
  part("problems").dataset.shown = "";
  write(part("hug-note"), "");
  showTouch(touch);
  if (status) showStatus(status);
}

await beginPage(writeAll);
beginOrders();
showTouch(touch);
await refresh();
follow({status: showStatus, touch: showTouch});
