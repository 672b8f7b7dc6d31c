/** The table of a spec, as its downloads have it: the quantity, and how many samples. */

import { type Change, setTable, type SpecDocument, type Table } from "./document";
import { asFilm, asLobe, quantityOf } from "./quantity";
import { roughen } from "./surface";

export type Quantity = ReturnType<typeof quantityOf>;

export const QUANTITIES: Readonly<Record<Quantity, string>> = {
  fresnel: "The film alone: R and T by angle and thickness",
  albedo: "Albedo: all light the rough surface returns",
  bsdf: "BSDF: light from each direction to each",
};

/** Light sources and observers that are often wanted; the service knows more. */
export const ILLUMINANTS = {
  D65: "D65, daylight",
  D50: "D50, warmer daylight",
  D75: "D75, northern sky",
  A: "A, tungsten lamp",
  E: "E, equal energy",
  FL2: "FL2, cool white fluorescent",
  FL11: "FL11, narrow-band fluorescent",
};
export const OBSERVERS = {
  "CIE 1931 2 Degree Standard Observer": "CIE 1931, 2 degrees",
  "CIE 1964 10 Degree Standard Observer": "CIE 1964, 10 degrees",
};
export const SPACES = { "Rec.709": "Rec.709", "Rec.2020": "Rec.2020", ACEScg: "ACEScg", XYZ: "XYZ" } as const;

const DEFAULT_COSINES = 64;

/** Factors on the thickness. */
export interface Scales {
  readonly start: number;
  readonly stop: number;
  readonly count: number;
}

/** A quantity, with a surface and axes that go with it. */
export function setQuantity(quantity: Quantity): Change {
  if (quantity === "fresnel") return asFilm;
  if (quantity === "bsdf") return asLobe;
  return (spec) => {
    const { wavelength_nm, cos_theta, thickness_scale, roughness, transmission } = spec.table ?? {};
    const table = given({ quantity, wavelength_nm, cos_theta, thickness_scale, roughness, transmission });
    return { ...(spec.surface ? spec : roughen(spec)), table };
  };
}

/** Number of cosines; nothing where the spec lists them. */
export function cosineCount({ table }: SpecDocument): number | undefined {
  const axis = table?.cos_theta ?? DEFAULT_COSINES;
  return typeof axis === "number" ? axis : undefined;
}

/** The factors on the thickness: a range, one thickness, or a list that is kept as it is. */
export function scalesOf({ table }: SpecDocument): Scales | "one" | "list" {
  const axis = table?.thickness_scale ?? 1;
  if (typeof axis === "number") return "one";
  if (Array.isArray(axis)) return "list";
  const { start, stop, step, count } = axis;
  return { start, stop, count: count ?? (step ? Math.round((stop - start) / step) + 1 : 2) };
}

export function setScales(scales: Scales | "one"): Change {
  return setTable({ thickness_scale: scales === "one" ? 1 : { ...scales } });
}

/** Known words, and one that the spec has brought along. */
export function including(known: Readonly<Record<string, string>>, value: string): Readonly<Record<string, string>> {
  return value in known ? known : { [value]: value, ...known };
}

function given(table: { [Field in keyof Table]: Table[Field] | undefined }): Table {
  return Object.fromEntries(Object.entries(table).filter(([, value]) => value !== undefined));
}
