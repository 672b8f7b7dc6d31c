/** How the surface scatters light in the plane of incidence, in polar form; of a smooth one, its mirror ray. */

import { useEffect, useRef } from "preact/hooks";

import { AngleSlider } from "./angle-slider";
import { Numbers, Plot, PlotState } from "./plot";
import { brightened, hex, luminance, type Rgb } from "../film/colour";
import { isRough, type LobeSample } from "../film/lobe";
import { colourAt } from "../film/lookup-colour";
import { decimals, degrees, percent } from "../film/numbers";
import { spec } from "../state/editor";
import { followLobe, isLobeSeen, lobe, type Lobe } from "../state/lobe";
import { lookup } from "../state/lookup";
import { thetaDegrees } from "../state/view";
import "./lobe-plot.css";

/** Powers of ten between the middle and the rim. */
const DECADES = 4;
/** Within a screen of what is seen, so that the lobe is there when the reader is. */
const NEARLY_SEEN = "100% 0px";
const VIEW = "-1.12 -1.16 2.24 1.22";

export function LobePlot() {
  const place = useRef<HTMLDivElement>(null);
  useEffect(followLobe, []);
  useEffect(() => {
    const seen = ([entry]: IntersectionObserverEntry[]) => (isLobeSeen.value = entry?.isIntersecting ?? false);
    const observer = new IntersectionObserver(seen, { rootMargin: NEARLY_SEEN });
    if (place.current) observer.observe(place.current);
    return () => observer.disconnect();
  }, []);
  return (
    <Plot title="Scattering lobe" class="lobe-plot">
      <AngleSlider />
      <div class="lobe-place" ref={place}>
        {isRough(spec.value) ? <RoughLobe /> : <MirrorRay />}
      </div>
    </Plot>
  );
}

function RoughLobe() {
  const waiting = "The lobe is being computed.";
  const { answer } = lobe.value;
  return (
    <>
      {answer ? <Drawn lobe={answer} /> : <Polar label={waiting} theta={thetaDegrees.value} />}
      <PlotState asking={lobe.value} waiting={waiting} />
    </>
  );
}

function Drawn({ lobe: { samples, thetaDegrees: theta } }: { readonly lobe: Lobe }) {
  const peak = peakOf(samples);
  const words = `f_r in the plane of incidence for light at ${degrees(theta)}: largest at ${degrees(peak.thetaDegrees)}, ${decimals(peak.value)} per steradian`;
  return (
    <>
      <Polar label={words} theta={theta}>
        {samples.slice(1).map((sample, at) => (
          <Sector key={at} from={samples[at] ?? sample} to={sample} most={peak.value} />
        ))}
        <polyline class="lobe-outline" points={samples.map((sample) => corner(sample, peak.value)).join(" ")} />
      </Polar>
      <p class="reading">
        Largest at <b>{degrees(peak.thetaDegrees)}</b>: <b>{decimals(peak.value)} sr⁻¹</b>, mirror direction{" "}
        {degrees(theta)}. Each ring inwards is a tenth.
      </p>
      <Numbers caption="f_r in the plane of incidence" heads={["Angle", "f_r in 1/sr", "Hue"]} rows={rowsOf(samples)} />
    </>
  );
}

function MirrorRay() {
  const { answer } = lookup.value;
  const theta = thetaDegrees.value;
  const rgb: Rgb = answer ? colourAt(answer.reflectance, Math.cos((theta * Math.PI) / 180), 1) : [0, 0, 0];
  const [x, y] = polar(theta, 1);
  const words = `The surface is smooth: all reflected light leaves at ${degrees(theta)}`;
  return (
    <>
      <Polar label={`${words}, R ${percent(luminance(rgb))}, colour ${hex(rgb)}`} theta={theta}>
        <line class="mirror-edge" x1="0" y1="0" x2={x} y2={y} />
        <line class="mirror" x1="0" y1="0" x2={x} y2={y} stroke={hex(brightened(rgb))} />
      </Polar>
      <p class="reading">
        {words}, <span class="swatch" style={{ background: hex(rgb) }} /> <b>{hex(rgb)}</b>, R <b>{percent(luminance(rgb))}</b>. A
        surface with roughness has a lobe.
      </p>
    </>
  );
}

interface PolarProps {
  readonly label: string;
  readonly theta: number;
  readonly children?: preact.ComponentChildren;
}

function Polar({ label, theta, children }: PolarProps) {
  const [x, y] = polar(-theta, 0.98);
  return (
    <div class="lobe-picture" role="img" aria-label={label}>
      <svg viewBox={VIEW} aria-hidden="true">
        {Array.from({ length: DECADES }, (_, at) => 1 - at / DECADES).map((radius) => (
          <path key={radius} class="ring" d={`M${-radius} 0A${radius} ${radius} 0 0 1 ${radius} 0`} />
        ))}
        {[-60, -30, 0, 30, 60].map((angle) => <Spoke key={angle} angle={angle} />)}
        {children}
        <line class="ground" x1="-1.1" y1="0" x2="1.1" y2="0" />
        <line class="incoming" x1={x} y1={y} x2="0" y2="0" />
        <path class="incoming-head" d="M0 0L-0.025 -0.07L0.025 -0.07Z" transform={`rotate(${-theta})`} />
      </svg>
    </div>
  );
}

function Spoke({ angle }: { readonly angle: number }) {
  const [x, y] = polar(angle, 1);
  const [labelX, labelY] = polar(angle, 1.07);
  return (
    <g>
      <line class="ring" x1="0" y1="0" x2={x} y2={y} />
      <text x={labelX} y={labelY + 0.02} text-anchor="middle" font-size="0.065">{Math.abs(angle)}°</text>
    </g>
  );
}

/** What lies between two directions, in the hue of its light. */
function Sector({ from, to, most }: { readonly from: LobeSample; readonly to: LobeSample; readonly most: number }) {
  const colour = hex(brightened(from.value > to.value ? from.rgb : to.rgb));
  return <polygon points={`0,0 ${corner(from, most)} ${corner(to, most)}`} fill={colour} stroke={colour} />;
}

function corner({ thetaDegrees: theta, value }: LobeSample, most: number): string {
  const radius = value > 0 ? Math.max(0, 1 + Math.log10(value / most) / DECADES) : 0;
  return polar(theta, radius)
    .map((coordinate) => coordinate.toFixed(4))
    .join(",");
}

/** From the normal, which points up; y counts downwards. */
function polar(theta: number, radius: number): [number, number] {
  const angle = (theta * Math.PI) / 180;
  return [radius * Math.sin(angle), -radius * Math.cos(angle)];
}

function peakOf(samples: readonly LobeSample[]): LobeSample {
  const dark: LobeSample = { thetaDegrees: 0, rgb: [0, 0, 0], value: 0 };
  return samples.reduce((peak, sample) => (sample.value > peak.value ? sample : peak), dark);
}

function rowsOf(samples: readonly LobeSample[]): string[][] {
  return samples.map(({ thetaDegrees: theta, value, rgb }) => [
    `${theta.toFixed(2)}°`,
    value.toPrecision(4),
    value > 0 ? hex(brightened(rgb)) : "dark",
  ]);
}
