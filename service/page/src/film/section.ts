/** The film cut open: which material lies where, its periods written out. */

import { type Entry, isGroup, type SpecDocument } from "./document";
import { described } from "./material";
import type { Layer } from "../service/answers";

/** Periods of a group that a picture can show. */
const MOST_PERIODS = 24;
/** The thinnest layer that is still seen, as a share of the whole. */
const LEAST_SHARE = 0.012;
const SHADES = 6;

export interface Band {
  readonly material: string;
  /** Share of the picture's height. */
  readonly share: number;
}

/** The bands of a stack from the incident medium inwards, as thick as the layers are to each other. */
export function bands({ stack }: SpecDocument): readonly Band[] {
  const layers = stack.layers.flatMap(periods).filter(({ thickness_nm }) => thickness_nm > 0);
  const total = layers.reduce((sum, { thickness_nm }) => sum + thickness_nm, 0) || 1;
  const shares = layers.map(({ thickness_nm }) => Math.max(thickness_nm / total, LEAST_SHARE));
  const drawn = shares.reduce((sum, share) => sum + share, 0) || 1;
  return layers.map(({ material }, at) => ({ material: described(material), share: (shares[at] ?? 0) / drawn }));
}

/** A shade from 0 for each material of the stack, the same wherever the material lies. */
export function shades({ stack }: SpecDocument): (material: string) => number {
  const layers = stack.layers.flatMap((entry) => (isGroup(entry) ? entry.layers : [entry]));
  const all = [stack.incident, ...layers.map(({ material }) => material), stack.substrate].map(described);
  const known = [...new Set(all)];
  return (material) => Math.max(known.indexOf(material), 0) % SHADES;
}

function periods(entry: Entry): readonly Layer[] {
  if (!isGroup(entry)) return [entry];
  return Array.from({ length: Math.min(entry.repeat, MOST_PERIODS) }, () => entry.layers).flat();
}
