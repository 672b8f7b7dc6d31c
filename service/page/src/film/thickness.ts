/** The thicknesses of a spec as a whole. */

import { type Change, type Entry, isGroup, type SpecDocument } from "./document";
import type { Layer } from "../service/answers";

/** Thickness of the film's one layer in nm; undefined where there are more. */
export function onlyThicknessNm({ stack }: SpecDocument): number | undefined {
  const [only, ...others] = stack.layers;
  return only && others.length === 0 && !isGroup(only) ? only.thickness_nm : undefined;
}

/** Multiply the thickness of every layer, as a texture's thickness scale does. */
export function scaleThicknesses(factor: number): Change {
  const scaled = (layer: Layer): Layer => ({ ...layer, thickness_nm: rounded(layer.thickness_nm * factor) });
  const changed = (entry: Entry): Entry =>
    isGroup(entry) ? { ...entry, layers: entry.layers.map(scaled) } : scaled(entry);
  return (spec) => ({ ...spec, stack: { ...spec.stack, layers: spec.stack.layers.map(changed) } });
}

/** To a hundredth of a nanometre, which no eye and no oven tells apart. */
function rounded(nm: number): number {
  return Math.round(nm * 100) / 100;
}
