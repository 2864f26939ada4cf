// SPDX-License-Identifier: Apache-2.0
// The wearer tries actuators: one, or all motors one after the other.
import {command, make, onPress, text, write} from "/shared/page.js";

const SECONDS = 0.8;
const REST_MS = 400;
const ANSWER_MS = 50;  // how often it is asked what became of a trial
const MOST_ANSWERS = 40;

const which = document.getElementById("trial-which");
const note = document.getElementById("trial-note");
const identify = document.getElementById("identify");
let actuators = [];
let identifying = false;

const wait = (ms) => new Promise((done) => setTimeout(done, ms));

// Throws if it was not driven.
async function tryOne(actuator) {
  const {trial} = await command({command: "jacket_trial", id: actuator.id, seconds: SECONDS});
  write(note, text("trial.runs", {name: actuator.name}));
  await wait(1000 * SECONDS);
  for (let asked = 0; asked < MOST_ANSWERS; ++asked) {
    const jacket = await command({command: "jacket"});
    if (jacket.trial?.number > trial) break;  // another page tries, too
    if (jacket.trial?.number === trial) {
      if (jacket.trial.outcome === "driven") break;
      throw new Error(text("trial.refused", {name: actuator.name, why: jacket.trial.outcome}));
    }
    await wait(ANSWER_MS);
  }
  write(note, "");
}

async function identifyAll() {
  if (identifying) return;
  identifying = true;
  writeTrial();
  try {
    for (const actuator of actuators.filter((one) => one.enabled && one.kind === "motor")) {
      if (!identifying) break;
      await tryOne(actuator);
      await wait(REST_MS);
    }
  } finally {
    identifying = false;
    write(note, "");
    writeTrial();
  }
}

export function writeTrial() {
  write(identify, text(identifying ? "trial.cease" : "trial.identify"));
}

// What the command "jacket" tells.
export function offerTrials(jacket) {
  actuators = jacket.actuators;
  which.replaceChildren(...actuators.filter((one) => one.enabled).map((one) =>
    make("option", {value: one.id, textContent: `${one.id} ${one.name}`})));
}

export function beginTrials() {
  onPress(document.getElementById("trial"),
          () => tryOne(actuators.find((one) => one.id === Number(which.value))));
  identify.addEventListener("click", (event) => {
    if (!identifying) return;
    identifying = false;  // after the one that runs
    event.stopImmediatePropagation();
  });
  onPress(identify, identifyAll);
}
