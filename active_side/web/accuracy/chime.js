// SPDX-License-Identifier: Apache-2.0
// A short soft tone: the touch was taken, though the hand hides it.
const HERTZ = 880;
const SECONDS = 0.15;

let context = null;

export function chime() {
  context ??= new AudioContext();
  const tone = context.createOscillator();
  const loudness = context.createGain();
  const now = context.currentTime;
  tone.frequency.value = HERTZ;
  loudness.gain.setValueAtTime(0.2, now);
  loudness.gain.exponentialRampToValueAtTime(0.001, now + SECONDS);
  tone.connect(loudness).connect(context.destination);
  tone.start(now);
  tone.stop(now + SECONDS);
}
