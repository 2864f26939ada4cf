// SPDX-License-Identifier: Apache-2.0
//
// Shows the remote person and the own picture as the test orders, and answers with where they are, once they were
// drawn. An order: {id, remote: {image, person, seed, liveliness, x, y, w, h}, own: the same without a place,
// slide_ms}; places are CSS px of the page.
'use strict';

const frame_ms = 40;
const own_size = {w: 160, h: 120};  // at most
const remote = {canvas: document.getElementById('remote'), head: null, liveliness: 0};
const own = {canvas: document.getElementById('own'), head: null, liveliness: 0.5};

const images = new Map();
async function load(name) {
  if (!images.has(name)) {
    const image = new Image();
    image.src = name;
    await image.decode();
    images.set(name, image);
  }
  return images.get(name);
}

// On whole px of the monitor, so that what the page answers is where it is drawn.
function place(view, rect) {
  const ratio = window.devicePixelRatio;
  const edge = (css_px) => Math.round(css_px * ratio);
  const left = edge(rect.x);
  const top = edge(rect.y);
  const width = edge(rect.x + rect.w) - left;
  const height = edge(rect.y + rect.h) - top;
  if (view.canvas.width !== width || view.canvas.height !== height) {
    view.canvas.width = width;
    view.canvas.height = height;
  }
  Object.assign(view.canvas.style, {
    left: `${left / ratio}px`, top: `${top / ratio}px`, width: `${width / ratio}px`, height: `${height / ratio}px`});
  view.rect = {...rect};
}

function draw(view) {
  if (view.head) view.head.draw(view.canvas, view.liveliness);
}

const nextFrame = () => new Promise((resolve) => requestAnimationFrame(resolve));

async function slide(view, to, duration_ms) {
  const from = view.rect;
  const started = performance.now();
  for (let share = 0; share < 1;) {
    await nextFrame();
    share = Math.min(1, (performance.now() - started) / duration_ms);
    const between = (key) => from[key] + share * (to[key] - from[key]);
    place(view, {x: between('x'), y: between('y'), w: between('w'), h: between('h')});
    draw(view);
  }
}

async function show(order) {
  const image = await load(order.remote.image);
  const own_image = await load(order.own.image);
  if (remote.name !== order.remote.image) {
    remote.head = new TalkingHead(image, order.remote.person, order.remote.seed);
    remote.name = order.remote.image;
  }
  if (own.name !== order.own.image) {
    own.head = new TalkingHead(own_image, order.own.person, order.own.seed);
    own.name = order.own.image;
    const ratio = window.devicePixelRatio;
    const picture = order.own.person.picture;
    const scale = Math.min(own_size.w / picture.w, own_size.h / picture.h);
    own.canvas.width = Math.round(scale * picture.w * ratio);
    own.canvas.height = Math.round(scale * picture.h * ratio);
    Object.assign(own.canvas.style, {width: `${scale * picture.w}px`, height: `${scale * picture.h}px`});
  }
  remote.liveliness = order.remote.liveliness;
  const to = {x: order.remote.x, y: order.remote.y, w: order.remote.w, h: order.remote.h};
  if (order.slide_ms > 0 && remote.rect) {
    await slide(remote, to, order.slide_ms);
  } else {
    place(remote, to);
    draw(remote);
  }
  draw(own);
  // The first of these frames shows what was drawn; when the second begins, the first was handed to the screen.
  await nextFrame();
  await nextFrame();
  answer(order.id);
}

function complain(error) {
  fetch('/answer', {method: 'POST', body: JSON.stringify({problem: String(error)})});
}

function answer(id) {
  const {left, top, width, height} = remote.canvas.getBoundingClientRect();
  fetch('/answer', {method: 'POST', body: JSON.stringify({
    id,
    remote: {x: left, y: top, w: width, h: height},
    page: {w: window.innerWidth, h: window.innerHeight},
    device_pixel_ratio: window.devicePixelRatio,
  })});
}

function drawMarker() {
  const context = document.getElementById('marker').getContext('2d');
  ['#fe01fd', '#02fe03', '#0304fc', '#fdfe05'].forEach((colour, i) => {
    context.fillStyle = colour;
    context.fillRect(i % 2, i >> 1, 1, 1);
  });
}

drawMarker();
setInterval(() => {
  draw(remote);
  draw(own);
}, frame_ms);
new EventSource('/orders').onmessage = (message) => show(JSON.parse(message.data)).catch(complain);
