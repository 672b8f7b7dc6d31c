/** What a certificate says, in plain words: a sentence for each figure that applies. */

import { counted, decimals, percent } from "./numbers";

export type Certificate = Readonly<Record<string, unknown>>;

type Figures = Readonly<Record<string, number>>;
type Sentence = (value: number, figures: Figures) => string;

/** CIEDE2000 that an eye just sees between two patches side by side. */
const JUST_SEEN = 1;

/** In the order in which they are read. What a sentence has said with another figure has none of its own. */
const SENTENCES: Readonly<Record<string, Sentence>> = {
  delta_e_max: (value, { delta_e_p99 }) =>
    `Colours between the samples are within Delta E ${decimals(value)} of the exact film${nearly(delta_e_p99)}. ${judged(value)}`,
  delta_e_grazing: (value) => `In the last degree before grazing incidence they are within ${decimals(value)}.`,
  intensity_error_max: (value, { intensity_error_p99 }) =>
    `R and T read between the samples are within ${percent(value)} of the incident light${nearly(intensity_error_p99, percent)}.`,
  albedo_error_max: (value, { albedo_error_p99 }) =>
    `The light that comes back in all, read between the samples, is within ${percent(value)}${nearly(albedo_error_p99, percent)}.`,
  bsdf_error_max: (value, { bsdf_error_p99, bsdf_max }) =>
    `Light to one direction, read between the samples, is within ${decimals(value)} per steradian${nearly(bsdf_error_p99)}` +
    `; the brightest is ${decimals(bsdf_max ?? NaN)}.`,
  rounding_error_max: (value) => `At the samples themselves the precision costs ${value === 0 ? "nothing" : `${percent(value)} at most`}.`,
  texel_error_max: (value) => `At the samples themselves facets and precision cost ${percent(value)} at most.`,
  sample_error_max: (value) => `A sample itself, where it is not dark, is within ${percent(value)}.`,
  film_error: (value) => `What the facets read of R and T is within ${percent(value)}.`,
  reciprocity_error_max: (value) => `With light and eye exchanged it is the same within ${percent(value)}.`,
  energy_max: (value, figures) => energyWords(value, "intensity_error_max" in figures),
  out_of_gamut: (value) =>
    value === 0
      ? "All colours are within the gamut."
      : `${percent(value)} of the colours lie outside of the gamut. The files hold them as they are; a screen clips them.`,
  quadrature_error: (value) => `Halving the steps over the wavelength changes a colour by ${percent(value)} at most.`,
  held_out_points: (value, { colour_cells }) =>
    `Measured, not estimated: against the film in double precision, at ${counted(value)} points between the samples` +
    `${colour_cells ? ` and ${counted(colour_cells)} for the colours` : ""}.`,
};

/** The sentences of the figures that there are. */
export function certificateSentences(certificate: Certificate): string[] {
  const figures = numbersOf(certificate);
  return Object.entries(SENTENCES).flatMap(([name, sentence]) => {
    const value = figures[name];
    return value === undefined ? [] : [sentence(value, figures)];
  });
}

/** The figures as they are, without those that do not apply. */
export function numbersOf(certificate: Certificate): Figures {
  const applying = Object.entries(certificate).filter((entry): entry is [string, number] => typeof entry[1] === "number");
  return Object.fromEntries(applying);
}

function nearly(value: number | undefined, shown: (value: number) => string = decimals): string {
  return value === undefined ? "" : `, and within ${shown(value)} in 99 of 100 places`;
}

function judged(deltaE: number): string {
  if (deltaE < JUST_SEEN) return "1 is what an eye just sees, so nobody sees the difference.";
  if (deltaE < 3) return "1 is what an eye just sees side by side: a difference that hardly anybody notices.";
  return "1 is what an eye just sees: a finer grid of angles or thicknesses brings it down.";
}

function energyWords(most: number, isFilm: boolean): string {
  const kept = most <= 1 + 1e-4 ? "No light is made up" : "More light leaves than comes";
  const all = isFilm ? `R + T is ${most.toFixed(4)} at most` : `all that leaves is ${percent(most)} of what came at most`;
  return `${kept}: ${all}.`;
}
