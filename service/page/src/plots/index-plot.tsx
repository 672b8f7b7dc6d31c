/** A material's refractive index n + ik over the wavelength: n on the left, k on the right. */

import { useMemo } from "preact/hooks";

import { type Curve, type XyAxis, XyPlot } from "./xy-plot";
import { decimals } from "../film/numbers";
import type { Samples } from "../service/answers";

const AXES: readonly XyAxis[] = [
  { label: "Wavelength in nm" },
  { label: "n", scale: "n" },
  { label: "k, dashed", scale: "k", side: 1 },
];
const CURVES: readonly Curve[] = [
  { stroke: "--plot-r", scale: "n", width: 2 },
  { stroke: "--plot-t", scale: "k", width: 2, dash: [6, 4] },
];
const SCALES = {
  x: { time: false },
  n: { range: (_: unknown, least: number, most: number) => spread(least, most) },
  k: { range: (_: unknown, __: number, most: number) => [0, Math.max(1.1 * most, 1e-3)] as [number, number] },
};

export function IndexPlot({ samples }: { readonly samples: Samples }) {
  const { wavelength_nm, n, k } = samples;
  const data = useMemo(() => [wavelength_nm, n, k] as [number[], number[], number[]], [samples]);
  return <XyPlot label={labelOf(samples)} data={data} axes={AXES} curves={CURVES} scales={SCALES} />;
}

/** Room above and below, also about a constant. */
function spread(least: number, most: number): [number, number] {
  const air = Math.max(0.1 * (most - least), 0.02);
  return [least - air, most + air];
}

function labelOf({ wavelength_nm, n, k }: Samples): string {
  const range = (values: readonly number[]) => `${decimals(Math.min(...values))} to ${decimals(Math.max(...values))}`;
  return `Refractive index from ${wavelength_nm[0]} to ${wavelength_nm.at(-1)} nm: n ${range(n)}, k ${range(k)}`;
}
