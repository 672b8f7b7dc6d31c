/** The light that a rough surface scatters in the plane of incidence: what to ask for, and what came. */

import { colourWeights } from "./colour-weights";
import { luminance, type Rgb } from "./colour";
import { column, parseCsv } from "./csv-table";
import type { SpecDocument } from "./document";

/** Where f_r has been computed, from the incoming light's side, below 0, to that of its mirror image. */
export interface LobeSample {
  readonly thetaDegrees: number;
  /** Linear colour of f_r under D65, in 1/sr. */
  readonly rgb: Rgb;
  /** Luminous f_r in 1/sr. */
  readonly value: number;
}

const SAMPLES_NM = 24;
const SEEN_NM = [390, 710] as const;
const LARGEST_THETA = 1.5707;
const WIDE_STEP_DEGREES = 1.5;
const WIDEST_DEGREES = 89;
const NARROW_DEGREES = [0, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4, 5, 6, 8];

/** Whether the surface spreads light, and so has a lobe. */
export function isRough({ surface, table }: SpecDocument): boolean {
  return roughnessOf(table?.roughness) !== undefined || (!!surface && [surface.alpha_x, surface.exponent_x].some(isNumber));
}

/** f_r of the spec's film and surface at one angle of incidence. */
export function lobeSpec(spec: SpecDocument, thetaDegrees: number): SpecDocument {
  const roughness = roughnessOf(spec.table?.roughness);
  return {
    stack: spec.stack,
    surface: spec.surface ?? null,
    table: {
      quantity: "bsdf",
      wavelength_nm: wavelengthsNm(spec),
      theta_i: [radians(thetaDegrees)],
      theta_o: around(thetaDegrees).map(radians),
      phi: [0, Math.PI],
      ...(isIsotropic(spec) ? {} : { phi_i: [0] }),
      ...(roughness === undefined ? {} : { roughness: [roughness] }),
    },
  };
}

/** The samples in order of their angle. */
export function lobeSamples(csv: string): LobeSample[] {
  const columns = parseCsv(csv);
  const [theta, phi, nm, f] = ["theta_o", "phi", "wavelength_nm", "f_r"].map((name) => column(columns, name));
  if (!theta || !phi || !nm || !f) return [];
  const count = new Set(nm).size;
  const weights = colourWeights(nm.slice(0, count));
  const samples = Array.from({ length: f.length / count }, (_, at) => {
    const row = at * count;
    const side = (phi[row] ?? 0) > 1 ? 1 : -1;
    const rgb = [0, 1, 2].map((channel) => weighted(weights, f, row, channel)) as unknown as Rgb;
    return { thetaDegrees: (side * (theta[row] ?? 0) * 180) / Math.PI, rgb, value: luminance(rgb) };
  });
  return samples.sort((one, other) => one.thetaDegrees - other.thetaDegrees);
}

function weighted(weights: readonly Rgb[], f: readonly number[], row: number, channel: number): number {
  return weights.reduce((sum, weight, at) => sum + (weight[channel] ?? 0) * (f[row + at] ?? 0), 0);
}

/** Directions all over, and more of them about the mirror image. */
function around(thetaDegrees: number): number[] {
  const wide = Array.from({ length: Math.floor(WIDEST_DEGREES / WIDE_STEP_DEGREES) + 1 }, (_, at) => at * WIDE_STEP_DEGREES);
  const near = NARROW_DEGREES.flatMap((away) => [thetaDegrees - away, thetaDegrees + away]);
  const all = new Set([...wide, ...near].filter((theta) => theta >= 0 && theta <= WIDEST_DEGREES));
  return [...all].sort((one, other) => one - other);
}

function wavelengthsNm({ table }: SpecDocument): number[] {
  const axis = table?.wavelength_nm ?? { start: 350, stop: 750 };
  const [first, last] = Array.isArray(axis) ? [axis[0] ?? 0, axis.at(-1) ?? 0] : [axis.start, axis.stop];
  const [start, stop] = [Math.max(first, SEEN_NM[0]), Math.min(last, SEEN_NM[1])];
  return Array.from({ length: SAMPLES_NM }, (_, at) => start + (at / (SAMPLES_NM - 1)) * (stop - start));
}

function isIsotropic({ surface }: SpecDocument): boolean {
  const { alpha_x, alpha_y, exponent_x, exponent_y } = surface ?? {};
  return (alpha_y ?? alpha_x) === alpha_x && (exponent_y ?? exponent_x) === exponent_x;
}

/** The middle one of the table's roughnesses; undefined where the surface's own is meant. */
function roughnessOf(axis: NonNullable<SpecDocument["table"]>["roughness"]): number | undefined {
  if (!axis) return undefined;
  return Array.isArray(axis) ? axis[Math.floor(axis.length / 2)] : (axis.start + axis.stop) / 2;
}

function isNumber(value: unknown): value is number {
  return typeof value === "number";
}

function radians(theta: number): number {
  return Math.min((theta * Math.PI) / 180, LARGEST_THETA);
}
