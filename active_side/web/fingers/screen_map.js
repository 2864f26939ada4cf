// SPDX-License-Identifier: Apache-2.0
// Where a place on the screen is on the page. Screens are measured in mm from the top-left corner of their picture, as
// touches are; pages in CSS pixels from their own top-left corner. Without a calibration the screen is taken for one of
// 96 pixels an inch, as CSS does.
const MM_PER_PX = 25.4 / 96;

// monitor: {left, top, width, height} and page: {left, top}, in CSS pixels of the desktop. size: {width_mm, height_mm} of
// the monitor's picture, or nothing.
export function screenMap(monitor, page, size) {
  const width_mm = size?.width_mm > 0 ? size.width_mm : monitor.width * MM_PER_PX;
  const height_mm = size?.height_mm > 0 ? size.height_mm : monitor.height * MM_PER_PX;
  const map = {
    width_mm,
    height_mm,
    x_px_per_mm: monitor.width / width_mm,
    y_px_per_mm: monitor.height / height_mm,
    left_px: monitor.left - page.left,
    top_px: monitor.top - page.top,
  };
  map.toPage = ({x_mm, y_mm}) => ({x: map.left_px + x_mm * map.x_px_per_mm, y: map.top_px + y_mm * map.y_px_per_mm});
  map.toScreen = ({x, y}) => ({x_mm: (x - map.left_px) / map.x_px_per_mm, y_mm: (y - map.top_px) / map.y_px_per_mm});
  return map;
}

// The monitor that the window is on. Its place among several is not told to pages; that of the part without the
// desktop's bars is, which only a bar on its left or top moves.
export function monitorOf(window) {
  const {screen} = window;
  return {left: screen.isExtended ? screen.availLeft : 0, top: screen.isExtended ? screen.availTop : 0,
          width: screen.width, height: screen.height};
}

// pointer: the last event of a mouse, which knows both places; without one the frame is guessed to be as wide on the left
// as on the right and below, and the rest of it above the page.
export function pageOf(window, pointer) {
  if (window.document.fullscreenElement) return monitorOf(window);
  if (pointer) return {left: pointer.screenX - pointer.clientX, top: pointer.screenY - pointer.clientY};
  const frame = Math.max(0, (window.outerWidth - window.innerWidth) / 2);
  return {left: window.screenX + frame,
          top: window.screenY + Math.max(0, window.outerHeight - window.innerHeight - frame)};
}
