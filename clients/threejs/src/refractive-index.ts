/**
 * A refractive index n + ik, k >= 0: a number, one pair for all wavelengths, or samples that are interpolated linearly
 * and held beyond their ends.
 */
export type RefractiveIndex =
  | number
  | { readonly n: number; readonly k?: number }
  | { readonly wavelengthNm: readonly number[]; readonly n: readonly number[]; readonly k?: readonly number[] };

/** n and k at a wavelength. */
export function indexAt(index: RefractiveIndex, wavelengthNm: number): readonly [number, number] {
  if (typeof index === "number") return [index, 0];
  if (!("wavelengthNm" in index)) return [index.n, index.k ?? 0];
  const { wavelengthNm: at, n, k } = index;
  return [interpolate(wavelengthNm, at, n), k ? interpolate(wavelengthNm, at, k) : 0];
}

/** Piecewise linear through (at, values), `at` ascending; held beyond both ends. */
function interpolate(x: number, at: readonly number[], values: readonly number[]): number {
  const next = at.findIndex((sample) => sample > x);
  if (next === 0) return values[0] ?? NaN;
  if (next < 0) return values.at(-1) ?? NaN;
  const [left, right] = [at[next - 1] ?? NaN, at[next] ?? NaN];
  const [below, above] = [values[next - 1] ?? NaN, values[next] ?? NaN];
  return below + ((x - left) / (right - left)) * (above - below);
}
