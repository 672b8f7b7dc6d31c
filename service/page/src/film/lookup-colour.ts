/** Colours of a lookup texture, read as a shader does: linear between the texels, clamped at the edges. */

import type { Axis, LookupTexture } from "@nacreous/three";

import { isOutOfGamut, type Rgb } from "./colour";

/** A place between two neighbouring texels. */
export interface Between {
  readonly lower: number;
  readonly part: number;
}

/** The film's linear colour at an angle and a thickness. */
export function colourAt(texture: LookupTexture, cosTheta: number, scale: number): Rgb {
  return texelColour(texture, placeOn(texture.axes.x, cosTheta), placeOn(texture.axes.y, scale));
}

export function placeOn(axis: Axis, value: number): Between {
  const texel = axis.mapping === "explicit" ? explicitTexel(axis.values ?? [], value) : linearTexel(axis, value);
  const lower = Math.min(Math.max(Math.floor(texel), 0), axis.count - 2);
  return { lower, part: texel - lower };
}

export function texelColour(texture: LookupTexture, across: Between, down: Between): Rgb {
  const row = rowColours(texture, down);
  const mixed = (channel: number) => {
    const [left = NaN, right = NaN] = [row[3 * across.lower + channel], row[3 * across.lower + 3 + channel]];
    return left + across.part * (right - left);
  };
  return [mixed(0), mixed(1), mixed(2)];
}

/** The colours of one thickness at every texel's angle: R, G and B by turns. */
export function rowColours({ texture }: LookupTexture, { lower, part }: Between): Float64Array {
  const { width, height, data } = texture.image as { width: number; height: number; data: Float32Array };
  const channels = data.length / (width * height);
  // The smallest scale is the file's top row and WebGL's last.
  const start = (height - 1 - lower) * width * channels;
  const row = new Float64Array(3 * width);
  for (let at = 0; at < row.length; at++) {
    const upper = start + Math.floor(at / 3) * channels + (at % 3);
    const [above = NaN, below = NaN] = [data[upper], data[upper - width * channels]];
    row[at] = above + part * (below - above);
  }
  return row;
}

/** Share of the texels whose colour no screen of this gamut can show. */
export function outOfGamutShare({ texture }: LookupTexture): number {
  const { width, height, data } = texture.image as { width: number; height: number; data: Float32Array };
  const channels = data.length / (width * height);
  let outside = 0;
  for (let at = 0; at < data.length; at += channels) {
    if (isOutOfGamut([data[at] ?? 0, data[at + 1] ?? 0, data[at + 2] ?? 0])) outside++;
  }
  return outside / (width * height);
}

function linearTexel({ range: [first, last], count }: Axis, value: number): number {
  const along = last === first ? 0 : (value - first) / (last - first);
  return Math.min(Math.max(along, 0), 1) * (count - 1);
}

function explicitTexel(values: readonly number[], value: number): number {
  const above = values.findIndex((sample) => sample >= value);
  if (above === -1) return values.length - 1;
  if (above === 0) return 0;
  const [low = 0, high = 1] = [values[above - 1], values[above]];
  return above - 1 + (value - low) / (high - low);
}
