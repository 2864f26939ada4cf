// SPDX-License-Identifier: Apache-2.0
// The wearer's own quiet hours: a row of two times of day each.
import {command, make, onPress, text, write, writeProblem} from "/shared/page.js";

const list = document.getElementById("quiet-rows");
const add = document.getElementById("quiet-add");
const MOST = 8;  // as the daemon takes

// "20:30-07:00,13:00-14:00" as [["20:30", "07:00"], ...]. Times that end at midnight end at 00:00 here.
const spansOf = (hours) => (hours ? hours.split(",").map((span) => span.split("-")) : []);

const rows = () => [...list.querySelectorAll("li")];
const versionOf = (hours) => JSON.stringify([document.documentElement.lang, hours]);

let told = () => {};

// "20:30-07:00". While a row is half typed it is what it was before: "" if it is a new one.
function spanOf(row) {
  const times = [...row.querySelectorAll("input")].map((input) => input.value);
  if (!times.includes("")) row.dataset.span = times.join("-");
  return row.dataset.span ?? "";
}

async function tell() {
  add.disabled = rows().length >= MOST;
  const hours = rows().map(spanOf).filter(Boolean).join(",");
  if (hours === list.dataset.kept) return;
  try {
    await command({command: "quiet", hours});
    list.dataset.kept = hours;
    list.dataset.shown = versionOf(hours);
    write(document.getElementById("refusal"), "");
    await told();
  } catch (problem) {
    writeProblem(document.getElementById("refusal"), problem);
  }
}

function timeInput(label, value) {
  const input = make("input", {type: "time", value, ariaLabel: text(label)});
  input.addEventListener("change", tell);
  return input;
}

function row([begin, end]) {
  const remove = make("button", {textContent: text("quiet.remove")});
  const item = make("li", {className: "span"}, timeInput("quiet.from", begin), "–", timeInput("quiet.to", end), remove);
  spanOf(item);
  onPress(remove, async () => {
    item.remove();
    add.focus();
    await tell();
  });
  return item;
}

// `consent`: of the status. What the person is typing is left alone.
export function showQuietHours(consent) {
  const fixed = consent.quiet_hours;
  write(document.getElementById("quiet-fixed"), fixed ? text("quiet.fixed", {hours: fixed}) : "");
  const hours = consent.own_quiet_hours ?? "";
  const shown = versionOf(hours);
  if (list.dataset.shown === shown || list.contains(document.activeElement)) return;
  list.dataset.shown = shown;
  list.dataset.kept = hours;
  list.replaceChildren(...spansOf(hours).map(row));
  add.disabled = list.children.length >= MOST;
}

// `refresh`: called when the daemon has taken them.
export function beginQuietHours(refresh) {
  told = refresh;
  onPress(add, async () => {
    const item = row(["", ""]);
    list.append(item);
    add.disabled = list.children.length >= MOST;
    item.querySelector("input").focus();
  });
}
