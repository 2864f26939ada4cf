// SPDX-License-Identifier: Apache-2.0
// Whether what the page draws lies where it should on the calibrated screen.
const SAME_SHAPE = 0.03;
const ROUNDING_PX = 2;

// What keeps a window's screen from being the calibrated one: "" or the key of a sentence. screen: {width, height} in CSS
// pixels; touchScreen: as the status tells it.
export function otherScreen({width, height}, {width_mm, height_mm}) {
  return Math.abs(width / height / (width_mm / height_mm) - 1) > SAME_SHAPE ? "accuracy.other_shape" : "";
}

// The same shape, but not as many pixels: another screen, or the calibrated one set to another resolution.
export function otherPixels({width, height}, pixel_ratio, {width_px, height_px}) {
  if (!(width_px > 0 && height_px > 0)) return "";
  const differs = (css, px) => Math.abs(css * pixel_ratio - px) > ROUNDING_PX * Math.max(1, pixel_ratio);
  return differs(width, width_px) || differs(height, height_px) ? "accuracy.other_pixels" : "";
}

// The page is as large as the whole screen.
export function covers({innerWidth, innerHeight, screen}) {
  return Math.abs(innerWidth - screen.width) <= ROUNDING_PX && Math.abs(innerHeight - screen.height) <= ROUNDING_PX;
}
