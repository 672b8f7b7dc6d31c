/** From a spectrum to a colour: the CIE 1931 observer under D65 in linear Rec.709, a weight for each 5 nm. */

import weights from "../../../../clients/threejs/src/colour-weights.json";
import { brightened, chromaticity, type Rgb, type Xy } from "./colour";

const CHANNELS = [weights.r, weights.g, weights.b] as const;
/** Between these the weights have enough digits for a chromaticity. */
const LOCUS_NM = [390, 700] as const;

/** The spectral locus: chromaticities of single wavelengths. The illuminant's factor on each does not change them. */
export function spectralLocus(): { readonly nm: number; readonly xy: Xy }[] {
  return weights.r
    .map((_, at) => weights.first_nm + at * weights.step_nm)
    .filter((nm) => nm >= LOCUS_NM[0] && nm <= LOCUS_NM[1])
    .map((nm) => ({ nm, xy: chromaticity(fineWeight(nm)) }));
}

/** What each of a few ascending wavelengths adds to a colour: the spectrum is linear between them, and level beyond. */
export function colourWeights(wavelengthNm: readonly number[]): Rgb[] {
  const shared = wavelengthNm.map(() => [0, 0, 0] as [number, number, number]);
  weights.r.forEach((_, at) => share(shared, wavelengthNm, at));
  const totals = [0, 1, 2].map((channel) => shared.reduce((sum, weight) => sum + (weight[channel] ?? 0), 0));
  return shared.map(([r, g, b]) => [r / (totals[0] ?? 1), g / (totals[1] ?? 1), b / (totals[2] ?? 1)]);
}

/** A colour for a wavelength, within what a screen shows. */
export function wavelengthColour(nm: number): Rgb {
  return brightened(fineWeight(nm));
}

function fineWeight(nm: number): Rgb {
  const place = (nm - weights.first_nm) / weights.step_nm;
  const below = Math.min(Math.max(Math.floor(place), 0), weights.r.length - 2);
  const part = Math.min(Math.max(place - below, 0), 1);
  const [r, g, b] = CHANNELS.map((channel) => (1 - part) * (channel[below] ?? 0) + part * (channel[below + 1] ?? 0));
  return [r ?? 0, g ?? 0, b ?? 0];
}

function share(shared: [number, number, number][], wavelengthNm: readonly number[], at: number): void {
  const nm = weights.first_nm + at * weights.step_nm;
  const after = wavelengthNm.findIndex((sample) => sample >= nm);
  const above = after === -1 ? wavelengthNm.length - 1 : after;
  const below = after === -1 ? above : Math.max(after - 1, 0);
  const [first = 0, last = 0] = [wavelengthNm[below], wavelengthNm[above]];
  const part = last > first ? (nm - first) / (last - first) : 0;
  for (const channel of [0, 1, 2] as const) {
    const weight = CHANNELS[channel][at] ?? 0;
    const [low, high] = [shared[below], shared[above]];
    if (low) low[channel] += (1 - part) * weight;
    if (high) high[channel] += part * weight;
  }
}
