// SPDX-License-Identifier: Apache-2.0
// What is behind the dots: a plain colour, or a picture from this PC, which is only ever drawn, never sent.
const THUMBNAIL_PX = 640;

function drawCovering(canvas, bitmap) {
  const scale = Math.max(canvas.width / bitmap.width, canvas.height / bitmap.height);
  const [width, height] = [bitmap.width * scale, bitmap.height * scale];
  canvas.getContext("2d").drawImage(bitmap, (canvas.width - width) / 2, (canvas.height - height) / 2, width, height);
}

export class Background {
  kind = "dark";  // "bright", "picture"
  #bitmap = null;

  get hasPicture() { return this.#bitmap !== null; }
  get shown() { return this.kind === "picture" && !this.hasPicture ? "dark" : this.kind; }

  // Throws if the file is no picture that the browser knows.
  async take(file) {
    this.#bitmap = await createImageBitmap(file);
  }

  // canvas: covers the whole page.
  draw(canvas, pixel_ratio) {
    canvas.hidden = this.shown !== "picture";
    if (canvas.hidden) return;
    canvas.width = Math.round(innerWidth * pixel_ratio);
    canvas.height = Math.round(innerHeight * pixel_ratio);
    drawCovering(canvas, this.#bitmap);
  }

  // A small copy as a data URL, cut as the screen did; null without a picture.
  thumbnail({width_mm, height_mm}) {
    if (this.shown !== "picture") return null;
    const canvas = document.createElement("canvas");
    canvas.width = THUMBNAIL_PX;
    canvas.height = Math.round(THUMBNAIL_PX * height_mm / width_mm);
    drawCovering(canvas, this.#bitmap);
    return canvas.toDataURL("image/jpeg", 0.7);
  }
}
