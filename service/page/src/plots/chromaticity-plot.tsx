/** The film's colour as the eye places it: CIE 1931 x and y, over the angle and over the thickness. */

import type { LookupTexture } from "@nacreous/three";
import { useId, useState } from "preact/hooks";

import { Numbers, Plot, PlotState } from "./plot";
import { chromaticity, D65, hex, PRIMARIES, type Rgb, type Xy } from "../film/colour";
import { spectralLocus } from "../film/colour-weights";
import { colourAt } from "../film/lookup-colour";
import { degrees } from "../film/numbers";
import { SCALES } from "../film/views";
import { lookup } from "../state/lookup";
import { thetaDegrees } from "../state/view";
import "./chromaticity-plot.css";

const LOCUS = spectralLocus();
const NAMED_NM = [460, 480, 500, 520, 540, 560, 580, 600, 620];
const LARGEST_DEGREES = 89;
const THICKNESSES = 129;

/** What is seen of the plane: the corner at the lower left, and the size. */
interface Window {
  readonly x: number;
  readonly y: number;
  readonly size: number;
}

const WHOLE: Window = { x: -0.075, y: -0.06, size: 0.96 };
const SMALLEST = 0.06;

interface Spot {
  readonly xy: Xy;
  readonly rgb: Rgb;
}

export function ChromaticityPlot() {
  const { answer } = lookup.value;
  return (
    <Plot title="Chromaticity" class="chromaticity-plot">
      {answer ? <Diagram texture={answer.reflectance} /> : <div class="chromaticity-picture" />}
      <PlotState asking={lookup.value} waiting="The colours are being computed." />
    </Plot>
  );
}

function Diagram({ texture }: { readonly texture: LookupTexture }) {
  const [isNear, setNear] = useState(false);
  const id = useId();
  const overAngle = path(LARGEST_DEGREES + 1, (at) => spot(texture, at, 1));
  const { start, stop } = SCALES;
  const theta = thetaDegrees.value;
  const overScale = path(THICKNESSES, (at) => spot(texture, theta, start + (at / (THICKNESSES - 1)) * (stop - start)));
  const current = spot(texture, theta, 1);
  const view = isNear ? around([...overAngle, ...overScale].map(({ xy }) => xy)) : WHOLE;
  return (
    <>
      <div class="chromaticity-picture" role="img" aria-label={labelOf(overAngle, current, theta)}>
        <svg viewBox={`${view.x} ${-view.y - view.size} ${view.size} ${view.size}`} aria-hidden="true">
          <Axes view={view} />
          <polygon class="locus" points={points(LOCUS)} />
          <polygon class="gamut" points={points(PRIMARIES.map((xy) => ({ xy })))} />
          {!isNear && LOCUS.filter(({ nm }) => NAMED_NM.includes(nm)).map((each) => <LocusLabel key={each.nm} {...each} />)}
          <polyline class="path thin" points={points(overScale)} />
          <polyline class="path" points={points(overAngle)} />
          {overAngle.filter((_, at) => at % 15 === 0).map((each, at) => <Dot key={at} spot={each} radius={0.007 * view.size} />)}
          <Cross at={D65} size={0.012 * view.size} />
          <Dot spot={current} radius={0.015 * view.size} name="current" />
        </svg>
      </div>
      <p class="reading">
        <span class="swatch" style={{ background: hex(current.rgb) }} /> x <b>{current.xy[0].toFixed(4)}</b>, y{" "}
        <b>{current.xy[1].toFixed(4)}</b> at {degrees(theta)}
      </p>
      <p class="chromaticity-key">
        <label for={id}>
          <input id={id} type="checkbox" checked={isNear} onChange={({ currentTarget }) => setNear(currentTarget.checked)} />{" "}
          Close-up
        </label>
        <span>Thick: over the angle. Thin: over 0.5 to 1.5 times the thickness. Triangle: sRGB. Cross: white, D65.</span>
      </p>
      <Numbers caption="Chromaticity over the angle of incidence" heads={["Angle", "x", "y", "Shown as"]} rows={rowsOf(overAngle)} />
    </>
  );
}

function Axes({ view: { x, y, size } }: { readonly view: Window }) {
  const step = size > 0.5 ? 0.2 : size > 0.25 ? 0.1 : size > 0.1 ? 0.05 : 0.02;
  const ticks = (from: number) => {
    const first = Math.ceil(Math.max(from, 0) / step);
    return Array.from({ length: Math.floor((from + size) / step) - first + 1 }, (_, at) => (first + at) * step);
  };
  const text = 0.034 * size;
  return (
    <g class="axes" font-size={text}>
      {ticks(x).map((at) => (
        <g key={at}>
          <line x1={at} x2={at} y1={-y} y2={-y - size} />
          <text x={at + 0.3 * text} y={-y - 0.4 * text}>{at.toFixed(2).replace(/0$/, "")}</text>
        </g>
      ))}
      {ticks(y).map((at) => (
        <g key={at}>
          <line x1={x} x2={x + size} y1={-at} y2={-at} />
          {at - y > 2 * text && <text x={x + 0.3 * text} y={-at - 0.3 * text}>{at.toFixed(2).replace(/0$/, "")}</text>}
        </g>
      ))}
      <text class="name" x={x + size - 0.8 * text} y={-y - 2 * text}>x</text>
      <text class="name" x={x + 0.3 * text} y={-y - size + text}>y</text>
    </g>
  );
}

function LocusLabel({ nm, xy: [x, y] }: { readonly nm: number; readonly xy: Xy }) {
  const away = 1 + 0.03 / Math.hypot(x - D65[0], y - D65[1]);
  const [labelX, labelY] = [D65[0] + away * (x - D65[0]), D65[1] + away * (y - D65[1])];
  return (
    <g class="locus-label" font-size="0.03">
      <circle cx={x} cy={-y} r="0.004" />
      <text x={labelX} y={-labelY + 0.008} text-anchor={x < D65[0] ? "end" : "start"}>{nm}</text>
    </g>
  );
}

function Dot({ spot: { xy, rgb }, radius, name = "" }: { readonly spot: Spot; readonly radius: number; readonly name?: string }) {
  return <circle class={`spot ${name}`} cx={xy[0]} cy={-xy[1]} r={radius} fill={hex(rgb)} />;
}

function Cross({ at: [x, y], size }: { readonly at: Xy; readonly size: number }) {
  return <path class="white" d={`M${x - size} ${-y}h${2 * size}M${x} ${-y - size}v${2 * size}`} />;
}

function path(count: number, at: (index: number) => Spot): Spot[] {
  return Array.from({ length: count }, (_, index) => at(index));
}

function spot(texture: LookupTexture, theta: number, scale: number): Spot {
  const rgb = colourAt(texture, Math.cos((theta * Math.PI) / 180), scale);
  return { xy: chromaticity(rgb), rgb };
}

/** A square around places, with some air. */
function around(places: readonly Xy[]): Window {
  const [xs, ys] = [places.map(([x]) => x), places.map(([, y]) => y)];
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const size = Math.max(1.25 * Math.max(right - left, high - low), SMALLEST);
  return { x: (left + right - size) / 2, y: (low + high - size) / 2, size };
}

function points(spots: readonly { readonly xy: Xy }[]): string {
  return spots.map(({ xy: [x, y] }) => `${x.toFixed(5)},${(-y).toFixed(5)}`).join(" ");
}

function labelOf(overAngle: readonly Spot[], { xy: [x, y], rgb }: Spot, theta: number): string {
  const last = overAngle.at(-1)?.xy ?? D65;
  const first = overAngle[0]?.xy ?? D65;
  const ends = `from x ${first[0].toFixed(3)}, y ${first[1].toFixed(3)} at 0° to x ${last[0].toFixed(3)}, y ${last[1].toFixed(3)} at 89°`;
  return `Chromaticity of the film ${ends}; at ${degrees(theta)} x ${x.toFixed(3)}, y ${y.toFixed(3)}, shown as ${hex(rgb)}`;
}

function rowsOf(overAngle: readonly Spot[]): string[][] {
  return overAngle
    .map(({ xy: [x, y], rgb }, theta) => [`${theta}°`, x.toFixed(4), y.toFixed(4), hex(rgb)])
    .filter((_, theta) => theta % 5 === 0 || theta === LARGEST_DEGREES);
}
