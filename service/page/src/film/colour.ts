/** Linear Rec.709, the colours of the lookup textures: on a screen, and in the eye. */

export type Rgb = readonly [number, number, number];
export type Xy = readonly [number, number];

/** Rows X, Y and Z: the primaries of ITU-R BT.709-6 with white D65 at 0.3127, 0.3290. */
const TO_XYZ = [
  [0.4123908, 0.3575843, 0.1804808],
  [0.212639, 0.7151687, 0.0721923],
  [0.0193308, 0.1191948, 0.9505322],
] as const;
/** Corners of Rec.709 and sRGB. */
export const PRIMARIES: readonly Xy[] = [
  [0.64, 0.33],
  [0.3, 0.6],
  [0.15, 0.06],
];
export const D65: Xy = [0.3127, 0.329];
/** What a component may be beyond 0 or 1 by and still count as rounded: as in the service's certificates. */
const ROUNDING = 1e-5;

/** Share of light that the eye counts: Y, which is 1 for white. */
export function luminance(rgb: Rgb): number {
  return dot(TO_XYZ[1], rgb);
}

export function chromaticity(rgb: Rgb): Xy {
  const [x, y, z] = [dot(TO_XYZ[0], rgb), dot(TO_XYZ[1], rgb), dot(TO_XYZ[2], rgb)];
  const sum = x + y + z;
  return sum > 0 ? [x / sum, y / sum] : D65;
}

/** What a screen can show of a linear component, 0 to 255: IEC 61966-2-1. */
export function screenByte(linear: number): number {
  const shown = Math.min(Math.max(linear, 0), 1);
  const encoded = shown <= 0.0031308 ? 12.92 * shown : 1.055 * shown ** (1 / 2.4) - 0.055;
  return Math.round(255 * encoded);
}

/** Steps between 0 and 1 that are fine enough for a byte where the curve is steepest: 0.05 of it. */
const SCREEN_STEPS = 32_768;
let table: Uint8ClampedArray | undefined;

/** `screenByte` for pictures: looked up. */
export function screenTable(): (linear: number) => number {
  const bytes = (table ??= Uint8ClampedArray.from({ length: SCREEN_STEPS + 1 }, (_, at) => screenByte(at / SCREEN_STEPS)));
  return (linear) => bytes[Math.round(Math.min(Math.max(linear, 0), 1) * SCREEN_STEPS)] ?? 0;
}

/** The colour as a screen shows it, such as #3a6ea5. */
export function hex(rgb: Rgb): string {
  return `#${rgb.map((component) => screenByte(component).toString(16).padStart(2, "0")).join("")}`;
}

/** The same hue and saturation, as bright as a screen can show it. */
export function brightened([r, g, b]: Rgb): Rgb {
  const [red, green, blue] = [Math.max(r, 0), Math.max(g, 0), Math.max(b, 0)];
  const most = Math.max(red, green, blue);
  return most > 0 ? [red / most, green / most, blue / most] : [0, 0, 0];
}

/** Whether no screen of this gamut can show the colour. */
export function isOutOfGamut(rgb: Rgb): boolean {
  return rgb.some((component) => component < -ROUNDING || component > 1 + ROUNDING);
}

function dot(row: Rgb, [r, g, b]: Rgb): number {
  return row[0] * r + row[1] * g + row[2] * b;
}
