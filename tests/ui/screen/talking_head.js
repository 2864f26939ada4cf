// SPDX-License-Identifier: Apache-2.0
//
// A talking head made from one picture: the head sways and nods in front of its background, the mouth opens and closes,
// the light flickers and the camera's noise runs over it all. Every motion is a sum of sines whose phases come from
// the seed, and begins when the head is made. Lengths within the picture are px of the image file.
'use strict';

// Evenly spread numbers of [0, 1) that are the same for the same seed.
function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  };
}

// A function of the time in s whose values stay within -1 and 1.
function slowWave(random, frequencies_hz) {
  const parts = frequencies_hz.map((hz) => ({hz: hz * (0.85 + 0.3 * random()), phase: 2 * Math.PI * random()}));
  return (time_s) =>
      parts.reduce((sum, part) => sum + Math.sin(2 * Math.PI * part.hz * time_s + part.phase), 0) / parts.length;
}

// The part of the picture within an ellipse, which fades out to its edge.
function softPart(image, middle, radius) {
  const part = document.createElement('canvas');
  part.width = Math.ceil(2 * radius.x);
  part.height = Math.ceil(2 * radius.y);
  const context = part.getContext('2d');
  context.drawImage(image, middle.x - radius.x, middle.y - radius.y, part.width, part.height, 0, 0, part.width,
                    part.height);
  context.globalCompositeOperation = 'destination-in';
  context.setTransform(radius.x, 0, 0, radius.y, radius.x, radius.y);
  const fade = context.createRadialGradient(0, 0, 0.75, 0, 0, 1);
  fade.addColorStop(0, 'rgba(0, 0, 0, 1)');
  fade.addColorStop(1, 'rgba(0, 0, 0, 0)');
  context.fillStyle = fade;
  context.fillRect(-1, -1, 2, 2);
  return {canvas: part, x: middle.x - radius.x, y: middle.y - radius.y, radius};
}

// Grains of a camera's noise, light and dark.
function noiseTile(random) {
  const tile = document.createElement('canvas');
  tile.width = tile.height = 192;
  const context = tile.getContext('2d');
  const grains = context.createImageData(tile.width, tile.height);
  for (let i = 0; i < grains.data.length; i += 4) {
    grains.data.fill(random() < 0.5 ? 0 : 255, i, i + 3);
    grains.data[i + 3] = Math.floor(14 * random());
  }
  context.putImageData(grains, 0, 0);
  return tile;
}

class TalkingHead {
  // `person`: {picture: {x, y, w, h}, face: {x, y, w, h}}, the face from hairline to chin.
  constructor(image, person, seed) {
    this.began_ms = performance.now();
    this.image = image;
    this.person = person;
    this.random = randomNumbers(seed);
    const face = person.face;
    const middle_x = face.x + face.w / 2;
    this.head = softPart(image, {x: middle_x, y: face.y + 0.42 * face.h}, {x: 0.75 * face.h, y: 0.85 * face.h});
    this.mouth = softPart(image, {x: middle_x, y: face.y + 0.8 * face.h}, {x: 0.28 * face.h, y: 0.18 * face.h});
    this.noise = noiseTile(this.random);
    this.sway = slowWave(this.random, [0.13, 0.29]);
    this.nod = slowWave(this.random, [0.21, 0.47]);
    this.tilt = slowWave(this.random, [0.11, 0.23]);
    this.speech = slowWave(this.random, [2.1, 3.7]);
    this.pause = slowWave(this.random, [0.17, 0.31]);
    this.light = slowWave(this.random, [0.4, 1.9]);
  }

  // `liveliness`: 1 for one who talks, 0 for one who holds still.
  draw(canvas, liveliness) {
    const time_s = (performance.now() - this.began_ms) / 1000;
    const context = canvas.getContext('2d', {alpha: false});
    const picture = this.person.picture;
    const scale_x = canvas.width / picture.w;
    const scale_y = canvas.height / picture.h;
    context.setTransform(scale_x, 0, 0, scale_y, -picture.x * scale_x, -picture.y * scale_y);
    context.drawImage(this.image, picture.x, picture.y, picture.w, picture.h, picture.x, picture.y, picture.w,
                      picture.h);
    this.drawHead(context, time_s, liveliness);
    this.drawLight(canvas, context, time_s);
  }

  // The head sways by 2 % of the face's height to each side and nods by 1.5 %, turning about the neck.
  drawHead(context, time_s, liveliness) {
    const face = this.person.face;
    const neck = {x: face.x + face.w / 2, y: face.y + 1.2 * face.h};
    context.save();
    context.translate(neck.x + 0.02 * face.h * liveliness * this.sway(time_s),
                      neck.y + 0.015 * face.h * liveliness * this.nod(time_s));
    context.rotate(0.012 * liveliness * this.tilt(time_s));
    context.translate(-neck.x, -neck.y);
    context.drawImage(this.head.canvas, this.head.x, this.head.y);
    const open = this.pause(time_s) > -0.4 ? liveliness * Math.max(0, this.speech(time_s)) : 0;
    const mouth = this.mouth;
    context.drawImage(mouth.canvas, mouth.x - 0.05 * open * mouth.radius.x, mouth.y,
                      2 * mouth.radius.x * (1 + 0.05 * open), 2 * mouth.radius.y * (1 + 0.35 * open));
    context.restore();
  }

  drawLight(canvas, context, time_s) {
    context.setTransform(1, 0, 0, 1, 0, 0);
    const light = this.light(time_s);
    context.fillStyle = light > 0 ? `rgba(255, 255, 255, ${0.03 * light})` : `rgba(0, 0, 0, ${-0.05 * light})`;
    context.fillRect(0, 0, canvas.width, canvas.height);
    const offset = {x: -Math.floor(192 * this.random()), y: -Math.floor(192 * this.random())};
    context.setTransform(1, 0, 0, 1, offset.x, offset.y);
    context.fillStyle = context.createPattern(this.noise, 'repeat');
    context.fillRect(0, 0, canvas.width + 192, canvas.height + 192);
  }
}
