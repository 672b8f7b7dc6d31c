/** The tables that the page looks at: each the film of the spec, over axes that a view needs. */

import type { SpecDocument } from "./document";

/** Texels of a lookup texture: over the cosine, and over the thickness. */
export interface Size {
  readonly cosTheta: number;
  readonly scales: number;
}

/** While a slider moves, and when it rests. */
export const COARSE: Size = { cosTheta: 32, scales: 9 };
export const MIDDLE: Size = { cosTheta: 64, scales: 17 };
export const FINE: Size = { cosTheta: 128, scales: 65 };
/** Factors on the thickness that a lookup texture of the page spans. */
export const SCALES = { start: 0.5, stop: 1.5 } as const;

/** The smooth film's colours over angle and thickness; the thicknesses of the spec are in the middle. */
export function lookupSpec(spec: SpecDocument, { cosTheta, scales }: Size): SpecDocument {
  return {
    stack: spec.stack,
    colour: { ...spec.colour, space: "Rec.709" },
    table: {
      ...wavelengths(spec),
      quantity: "fresnel",
      cos_theta: cosTheta,
      thickness_scale: { ...SCALES, count: scales },
    },
  };
}

/** R and T over the wavelength at one angle, s and p apart. */
export function spectrumSpec(spec: SpecDocument, thetaDegrees: number): SpecDocument {
  const cosTheta = Math.cos((thetaDegrees * Math.PI) / 180);
  return {
    stack: spec.stack,
    table: { ...wavelengths(spec), quantity: "fresnel", cos_theta: aroundCosine(cosTheta), thickness_scale: 1 },
  };
}

/** A list needs two samples: the cosine asked for, and one beside it that nobody reads. */
function aroundCosine(cosTheta: number): number[] {
  return cosTheta < 0.5 ? [cosTheta, 1] : [0, cosTheta];
}

function wavelengths({ table }: SpecDocument): Pick<NonNullable<SpecDocument["table"]>, "wavelength_nm"> {
  return table?.wavelength_nm === undefined ? {} : { wavelength_nm: table.wavelength_nm };
}
