/** Maps of thickness, drawn by a few sines: how a film drains, streams or was dipped. */

import { DataTexture, LinearFilter, RepeatWrapping, RGBAFormat, UnsignedByteType } from "three";

const SIZE = 512;

/** A share of the range of thickness, 0 to 1, at (u, v). */
type Thickness = (u: number, v: number) => number;

/** Thin at the top, with slow waves: a bubble some seconds after it was blown. */
export const drained: Thickness = (u, v) => 0.92 - 0.82 * v ** 0.8 + 0.035 * waves(u, v, 3) * (1 - v);

/** Streams that fold into each other. */
export const streaming: Thickness = (u, v) => 0.5 + 0.38 * waves(u + 0.08 * waves(v, u, 2), v, 2);

/** Dipped and drawn out: bands from pole to pole, hardly uneven. */
export const dipped: Thickness = (u, v) => 1.1 - 1.15 * v + 0.012 * waves(u, v, 4);

function waves(u: number, v: number, octaves: number): number {
  const turn = 2 * Math.PI;
  let sum = 0;
  for (let octave = 1; octave <= octaves; ++octave) {
    const bend = Math.sin(turn * (octave * v + 0.37 * octave));
    sum += Math.sin(turn * (octave * u + 0.31 * octave) + 2.2 * bend + 3.1 * v) / octave;
  }
  return sum / 1.6;
}

/** Draw a map; it closes around the sphere in u. */
export function thicknessMap(thickness: Thickness): DataTexture {
  const data = new Uint8Array(4 * SIZE * SIZE);
  for (let row = 0; row < SIZE; ++row) {
    for (let column = 0; column < SIZE; ++column) {
      const share = thickness(column / SIZE, row / (SIZE - 1));
      data[4 * (row * SIZE + column) + 1] = Math.round(255 * Math.min(Math.max(share, 0), 1));
    }
  }
  const texture = new DataTexture(data, SIZE, SIZE, RGBAFormat, UnsignedByteType);
  texture.wrapS = RepeatWrapping;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
