/** The rough surface of a spec, in words, and changes that keep it a surface the service knows. */

import { type Change, setSurface, type SpecDocument } from "./document";
import type { Surface } from "../service/answers";

export type Distribution = NonNullable<Surface["distribution"]>;
export type Masking = NonNullable<Surface["masking"]>;
export type MultipleScattering = NonNullable<Surface["multiple_scattering"]>;

export const DISTRIBUTIONS: Readonly<Record<Distribution, string>> = {
  ggx: "GGX: long tails, as most real surfaces",
  beckmann: "Beckmann: a bell curve of slopes",
  "ashikhmin-shirley": "Ashikhmin-Shirley: brushed, the paper's own",
  blinn: "Blinn: the same in every direction",
  phong: "Phong: a lobe about the mirror direction",
};
export const MASKINGS: Readonly<Record<Masking, string>> = {
  smith: "Smith, height-correlated",
  "smith-separable": "Smith, separable",
  "v-cavity": "V-shaped grooves, the paper's own",
};
export const SCATTERINGS: Readonly<Record<MultipleScattering, string>> = {
  none: "Light that hits one facet only",
  "kulla-conty": "Light that hits several facets as well",
};

const FIRST: Surface = { distribution: "ggx", alpha_x: 0.2, masking: "smith" };
const DEFAULTS = { distribution: "ashikhmin-shirley", masking: "v-cavity", multiple_scattering: "none" } as const;
const SAME_ALL_ROUND: readonly Distribution[] = ["blinn", "phong"];

/** Roughness along x and y, however the surface gives it; nothing where a table's axis alone does. */
export function alphas({ surface }: SpecDocument): readonly [x: number, y: number] | undefined {
  const x = alphaOf(surface?.alpha_x, surface?.exponent_x);
  return x === undefined ? undefined : [x, alphaOf(surface?.alpha_y, surface?.exponent_y) ?? x];
}

export function hasOwnY({ surface }: SpecDocument): boolean {
  return isNumber(surface?.alpha_y) || isNumber(surface?.exponent_y);
}

export function canBeBrushed({ surface }: SpecDocument): boolean {
  return !SAME_ALL_ROUND.includes(surface?.distribution ?? DEFAULTS.distribution);
}

export function choice<Field extends keyof typeof DEFAULTS>({ surface }: SpecDocument, field: Field) {
  return surface?.[field] ?? DEFAULTS[field];
}

/** Masking and scattering that go with the distribution; one that is the same all round loses its y. */
export function setDistribution(distribution: Distribution): Change {
  const round = SAME_ALL_ROUND.includes(distribution) ? { alpha_y: null, exponent_y: null } : {};
  const lobe = distribution === "phong" ? ({ masking: "v-cavity", multiple_scattering: "none" } as const) : {};
  return setSurface({ distribution, ...round, ...lobe });
}

/** Give the roughness as alphas; `undefined` along y makes it the same all round. */
export function setAlphas(alpha_x: number, alpha_y: number | undefined): Change {
  return setSurface({ alpha_x, alpha_y: alpha_y ?? null, exponent_x: null, exponent_y: null });
}

/** A surface to begin with. */
export const roughen: Change = (spec) => ({ ...spec, surface: { ...FIRST, ...spec.surface } });

/** An ideally smooth surface has no lobe: a table of it is one of the film alone. */
export const smoothen: Change = (spec) => {
  const { wavelength_nm, cos_theta, thickness_scale } = spec.table ?? {};
  const kept = Object.entries({ wavelength_nm, cos_theta, thickness_scale }).filter(([, value]) => value !== undefined);
  return { ...spec, surface: null, table: Object.fromEntries(kept) };
};

/** Walter et al. 2007, section 5.2: exponent = 2 / alpha^2 - 2. */
function alphaOf(alpha: number | null | undefined, exponent: number | null | undefined): number | undefined {
  if (isNumber(alpha)) return alpha;
  return isNumber(exponent) ? Number(Math.sqrt(2 / (exponent + 2)).toPrecision(4)) : undefined;
}

function isNumber(value: unknown): value is number {
  return typeof value === "number";
}
