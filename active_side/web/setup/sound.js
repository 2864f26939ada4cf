// SPDX-License-Identifier: Apache-2.0
// Short sounds, made here: who touches a dot looks at the finger.

const GAIN = 0.15;
const choice = document.getElementById("sounds");
let context = null;

choice.checked = localStorage.getItem("sounds") !== "off";
choice.addEventListener("change", () => localStorage.setItem("sounds", choice.checked ? "on" : "off"));

// Browsers let a page sound only after it was pressed: called then.
export function wakeSounds() {
  context ??= new AudioContext();
  context.resume();
}

// One tone after the other, in Hz.
export function play(...tones) {
  if (!choice.checked || context === null || context.state !== "running") return;
  tones.forEach((hertz, number) => {
    const begin = context.currentTime + 0.14 * number;
    const oscillator = new OscillatorNode(context, {frequency: hertz});
    const volume = new GainNode(context, {gain: 0});
    volume.gain.setTargetAtTime(GAIN, begin, 0.01);
    volume.gain.setTargetAtTime(0, begin + 0.1, 0.02);
    oscillator.connect(volume).connect(context.destination);
    oscillator.start(begin);
    oscillator.stop(begin + 0.3);
  });
}
