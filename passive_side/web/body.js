// SPDX-License-Identifier: Apache-2.0
// The wearer's page: what is felt, what they want, who may touch, how the jacket is.
import {beginPage, command, follow, make, onPress, showProblems, text, write, writeProblem} from "/shared/page.js";
import {drawPicture, showMuted, showRunning, writePicture} from "/body_picture.js";
import {beginQuietHours, showQuietHours} from "/quiet_hours.js";
import {beginTrials, offerTrials, writeTrial} from "/trial.js";

const part = (id) => document.getElementById(id);
const slider = part("strength");
let status = null;
let sliding = false;

const isPaused = () => status?.consent.name === "paused";

function pauseNote(consent) {
  if (consent.name === "quiet hours") return text("pause.quiet", {time: consent.until ?? ""});
  if (consent.name !== "paused") return text("pause.none");
  return consent.until ? text("pause.until", {time: consent.until}) : text("pause.open_end");
}

function showWishes(consent) {
  write(part("pause"), text(isPaused() ? "pause.end" : "pause.begin"));
  write(part("pause-note"), pauseNote(consent));
  showQuietHours(consent);
  if (!sliding) slider.value = Math.round(100 * (consent.strength ?? 1));
  showStrength();
  const muted = consent.muted_boxes ?? [];
  const count = muted.length + (consent.muted_actuators ?? []).length;
  showMuted(muted);
  write(part("muted-count"), count ? text("picture.count_muted", {count}) : text("picture.none_muted"));
  part("unmute-all").hidden = count === 0;
}

function showStrength() {
  const value = text("strength.value", {percent: slider.value});
  write(part("strength-value"), value);
  slider.setAttribute("aria-valuetext", value);
}

function showOthers() {
  const all = status.peers ?? [{...status.peer, pair: status.pair}];
  const rows = all.filter((one) => one.pair || one.connected).map((one) => {
    const name = one.pair?.name ?? text("others.unnamed");
    return [text(one.connected ? "others.here" : "others.away", {name}), one.connected];
  });
  if (rows.length === 0) rows.push([text("others.nobody"), false]);
  showList(part("others"), rows);
}

// Rows of [text, whether it stands out]; written only if they have changed.
function showList(list, rows) {
  const shown = JSON.stringify(rows);
  if (list.dataset.shown === shown) return;
  list.dataset.shown = shown;
  list.replaceChildren(...rows.map(([content, here]) =>
    make("li", {textContent: content, className: here ? "here" : ""})));
}

function showJacket(jacket, heaters) {
  write(part("jacket-state"), text(`jacket.${jacket.state}`, {name: jacket.name}));
  part("jacket-supply").hidden = jacket.supply_v === undefined;
  if (jacket.supply_v !== undefined)
    write(part("jacket-supply"), text("jacket.supply", {volts: jacket.supply_v.toFixed(1)}));
  part("heaters").hidden = heaters.length === 0;
  showList(part("heaters"), heaters.map((heater) => [
    heater.celsius === undefined ? text("heater.unknown", {name: heater.name})
                                 : text("heater.now", {name: heater.name, celsius: heater.celsius.toFixed(0)}),
    false,
  ]));
}

function showStatus(newest) {
  status = newest;
  document.title = `${text("title")} - telehug`;
  write(part("state"), text(`state.${status.state}`));
  part("stopped").hidden = status.state !== "stopped";
  showWishes(status.consent);
  showOthers();
  const {touches, since} = status.today;
  write(part("today"), since ? text("today.since", {count: touches, time: since}) : text("today.count", {count: touches}));
  showJacket(status.jacket, status.heaters ?? []);
  showProblems(part("problems"), status.problems);
  part("problems-part").hidden = status.problems.length === 0;
}

async function refresh() {
  showStatus(await command({command: "status"}));
}

// A button that orders something of the daemon.
function onOrder(id, order) {
  onPress(part(id), async () => {
    await command(order());
    await refresh();
  });
}

function beginOrders() {
  onOrder("stop", () => ({command: "stop", reason: "the wearer's page"}));
  onOrder("resume", () => ({command: "resume"}));
  onOrder("pause", () => ({command: isPaused() ? "unpause" : "pause"}));
  onOrder("hug", () => ({command: "hug"}));
  onOrder("unmute-all", () => ({command: "unmute", all: true}));
  slider.addEventListener("input", () => {
    sliding = true;
    showStrength();
  });
  slider.addEventListener("change", async () => {
    try {
      await command({command: "strength", strength: Number(slider.value) / 100});
      sliding = false;
      await refresh();
    } catch (problem) {
      sliding = false;
      writeProblem(part("refusal"), problem);
    }
  });
}

function writeAll() {
  writePicture();
  writeTrial();
  part("problems").dataset.shown = "";
  if (status) showStatus(status);
}

await beginPage(writeAll);
beginOrders();
beginTrials();
beginQuietHours(refresh);
const jacket = await command({command: "jacket", svg: true});
drawPicture(jacket, refresh);
offerTrials(jacket);
writeTrial();
await refresh();
follow({status: showStatus, running: (news) => showRunning(news.actuators)});
