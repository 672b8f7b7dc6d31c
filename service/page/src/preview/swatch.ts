/** The film on a sphere without WebGL: its colours over the angle, in a white surrounding. */

import type { LookupTexture } from "@nacreous/three";

/** Fill a canvas with a disc that shows the film from n·v = 1 in the middle to 0 at the edge. */
export function drawSwatch(canvas: HTMLCanvasElement, film: LookupTexture): void {
  const context = canvas.getContext("2d");
  if (!context) return;
  const { width, height } = canvas;
  const image = context.createImageData(width, height);
  const radius = 0.46 * Math.min(width, height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const sine2 = ((x + 0.5 - width / 2) ** 2 + (y + 0.5 - height / 2) ** 2) / radius ** 2;
      if (sine2 < 1) image.data.set([...colour(film, Math.sqrt(1 - sine2)), 255], 4 * (y * width + x));
    }
  }
  context.putImageData(image, 0, 0);
}

/** sRGB of the nearest texel at the spec's own thickness, the middle row. */
function colour({ texture }: LookupTexture, cosTheta: number): number[] {
  const { data, width, height } = texture.image as { data: ArrayLike<number>; width: number; height: number };
  const texel = Math.floor(height / 2) * width + Math.round(cosTheta * (width - 1));
  return [0, 1, 2].map((channel) => 255 * encoded(data[4 * texel + channel] ?? 0));
}

/** IEC 61966-2-1. */
function encoded(linear: number): number {
  const inside = Math.min(Math.max(linear, 0), 1);
  return inside <= 0.0031308 ? 12.92 * inside : 1.055 * inside ** (1 / 2.4) - 0.055;
}
