/** A spec as one would write it by hand: what has its default is left out, and the table is the same. */

import type { SpecDocument } from "./document";

type Section = Readonly<Record<string, unknown>>;

/** Defaults of the service, by section. */
const DEFAULTS: Readonly<Record<string, Section>> = {
  layer: { thickness_sigma_nm: 0, coherent: true },
  surface: {
    masking: "v-cavity",
    specular_weight: 1,
    diffuse_weight: 0,
    diffuse_reflectance: 0,
    multiple_scattering: "none",
  },
  table: { transmission: "keep", ellipsometry: false },
  colour: { illuminant: "D65", observer: "CIE 1931 2 Degree Standard Observer", space: "Rec.709" },
  accuracy: { precision: "single" },
};

export function brief(spec: SpecDocument): SpecDocument {
  const stack = { ...spec.stack, layers: spec.stack.layers.map(briefEntry) };
  const sections = Object.entries({ ...spec, stack } as Section)
    .map(([name, value]) => [name, isSection(value) ? without(value, DEFAULTS[name] ?? {}) : value] as const)
    .filter(([, value]) => value !== "" && !(isSection(value) && Object.keys(value).length === 0));
  return withoutNulls(Object.fromEntries(sections)) as SpecDocument;
}

function briefEntry(entry: SpecDocument["stack"]["layers"][number]): SpecDocument["stack"]["layers"][number] {
  const shorter = "layers" in entry ? { ...entry, layers: entry.layers.map(briefEntry) } : without({ ...entry }, DEFAULTS["layer"] ?? {});
  return shorter as unknown as typeof entry;
}

function without(section: Section, defaults: Section): Section {
  const kept = Object.entries(section).filter(([name, value]) => value !== null && value !== defaults[name]);
  return Object.fromEntries(kept);
}

/** A null says that a field is left out, which TOML can say in no other way. */
function withoutNulls(value: unknown): unknown {
  if (Array.isArray(value)) return value.map(withoutNulls);
  if (!isSection(value)) return value;
  const kept = Object.entries(value).filter(([, inner]) => inner !== null && inner !== undefined);
  return Object.fromEntries(kept.map(([name, inner]) => [name, withoutNulls(inner)]));
}

function isSection(value: unknown): value is Section {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
