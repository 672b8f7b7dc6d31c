import weights from "./colour-weights.json";

/** What each of a few wavelengths adds to a linear colour. */
export interface ColourWeights {
  readonly wavelengthNm: readonly number[];
  /** One triple (R, G, B) a wavelength; each channel sums to 1, so that a reflectance of 1 is white. */
  readonly rgb: readonly (readonly [number, number, number])[];
}

/** Where nearly all of a colour comes from: beyond lie 1e-4 of the observer's response to D65. */
const VISIBLE_NM = [380, 780] as const;

/**
 * Weights for wavelengths at equal steps over the visible.
 *
 * They integrate a cubic through the samples against the CIE 1931 observer under D65, in Rec.709: the fine weights of
 * colour-weights.json are shared among the four neighbours of each wavelength.
 */
export function colourWeights(samples: number): ColourWeights {
  const [first, last] = VISIBLE_NM;
  const step = (last - first) / (samples - 1);
  const wavelengthNm = Array.from({ length: samples }, (_, sample) => first + sample * step);
  const channels = [weights.r, weights.g, weights.b].map((fine) => normalised(shared(fine, wavelengthNm, step)));
  const [r = [], g = [], b = []] = channels;
  return { wavelengthNm, rgb: r.map((red, sample) => [red, g[sample] ?? NaN, b[sample] ?? NaN]) };
}

function shared(channel: readonly number[], wavelengthNm: readonly number[], step: number): number[] {
  return wavelengthNm.map((sampleNm) =>
    channel.reduce((sum, weight, fine) => {
      const nm = weights.first_nm + fine * weights.step_nm;
      return sum + weight * cubicConvolution(Math.abs(nm - sampleNm) / step);
    }, 0),
  );
}

/** R. G. Keys 1981, "Cubic convolution interpolation for digital image processing", equation 15. */
function cubicConvolution(distance: number): number {
  if (distance < 1) return (1.5 * distance - 2.5) * distance * distance + 1;
  if (distance < 2) return ((-0.5 * distance + 2.5) * distance - 4) * distance + 2;
  return 0;
}

function normalised(values: readonly number[]): number[] {
  const total = values.reduce((sum, value) => sum + value, 0);
  return values.map((value) => value / total);
}
