/** R and T over the wavelength, s and p apart and their mean, at the angle that is looked at. */

import { useEffect, useMemo, useState } from "preact/hooks";
import type uPlot from "uplot";

import { AngleSlider } from "./angle-slider";
import { Numbers, Plot, PlotState } from "./plot";
import { type Curve, type XyAxis, XyPlot } from "./xy-plot";
import { hex } from "../film/colour";
import { wavelengthColour } from "../film/colour-weights";
import { decimals, incidence, percent } from "../film/numbers";
import { followSpectrum, spectrum, type Spectrum } from "../state/spectrum";
import { saveFile } from "../state/taken-file";
import "./spectrum-plot.css";

const AXES: readonly XyAxis[] = [{ label: "Wavelength in nm" }, { label: "Share of the light in %" }];
const DASH = [6, 4];
const BAND_PX = 5;
const VISIBLE_NM = [380, 750] as const;

export function SpectrumPlot() {
  useEffect(followSpectrum, []);
  const [showsT, setShowsT] = useState(false);
  const { answer } = spectrum.value;
  return (
    <Plot title="Spectrum" class="spectrum-plot">
      <AngleSlider />
      <ul class="plot-keys">
        <Key name="R" stroke="--plot-r" />
        <Key name="s" stroke="--plot-s" />
        <Key name="p" stroke="--plot-p" />
        <li>
          <label>
            <input type="checkbox" checked={showsT} onChange={({ currentTarget }) => setShowsT(currentTarget.checked)} />{" "}
            Show T
          </label>
        </li>
        {showsT && <Key name="T, dashed" stroke="--plot-t" dashed="6 4" />}
      </ul>
      {answer ? <Curves answer={answer} showsT={showsT} /> : <div class="xy-plot" />}
      <PlotState asking={spectrum.value} waiting="The spectrum is being computed." />
    </Plot>
  );
}

function Key({ name, stroke, dashed }: { readonly name: string; readonly stroke: string; readonly dashed?: string }) {
  return (
    <li>
      <svg viewBox="0 0 24 12" aria-hidden="true">
        <line x1="0" y1="6" x2="24" y2="6" stroke={`var(${stroke})`} stroke-width="2.5" stroke-dasharray={dashed ?? "none"} />
      </svg>
      {name}
    </li>
  );
}

function Curves({ answer, showsT }: { readonly answer: Spectrum; readonly showsT: boolean }) {
  const [cursor, setCursor] = useState<number>();
  const data = useMemo(() => plotted(answer), [answer]);
  const curves = useMemo(() => curvesOf(showsT), [showsT]);
  const scales: uPlot.Scales = { x: { time: false }, y: { range: (_, __, most) => [0, niceTop(most)] } };
  return (
    <>
      <XyPlot
        label={labelOf(answer)}
        data={data}
        axes={AXES}
        curves={curves}
        scales={scales}
        underlay={drawBand}
        onCursor={setCursor}
      />
      <Reading answer={answer} at={cursor} />
      <Numbers caption={`R and T in % at ${incidence(answer.thetaDegrees)}`} heads={HEADS} rows={rowsOf(answer)} />
      <p>
        <button type="button" onClick={() => saveFile(new Blob([answer.csv], { type: "text/csv" }), "spectrum.csv")}>
          Save as CSV
        </button>
      </p>
    </>
  );
}

/** The values under the cursor, or the largest reflectance. */
function Reading({ answer, at }: { readonly answer: Spectrum; readonly at: number | undefined }) {
  if (at === undefined) return <p class="reading">{labelOf(answer)}</p>;
  const { wavelengthNm, R_s, R_p, T_s, T_p } = answer;
  const value = (values: readonly number[]) => values[at] ?? NaN;
  return (
    <p class="reading">
      <b>{value(wavelengthNm)} nm</b>: R <b>{percent((value(R_s) + value(R_p)) / 2)}</b> (s {percent(value(R_s))}, p{" "}
      {percent(value(R_p))}), T <b>{percent((value(T_s) + value(T_p)) / 2)}</b> (s {percent(value(T_s))}, p{" "}
      {percent(value(T_p))})
    </p>
  );
}

/** The essential numbers, in words. */
function labelOf({ thetaDegrees, wavelengthNm, R_s, R_p }: Spectrum): string {
  const R = mean(R_s, R_p);
  const most = Math.max(...R);
  const range = `${decimals(100 * Math.min(...R))} to ${percent(most)}`;
  return `Reflectance at ${incidence(thetaDegrees)}: ${range}, largest at ${wavelengthNm[R.indexOf(most)]} nm`;
}

const HEADS = ["nm", "R", "R s", "R p", "T", "T s", "T p"] as const;

function rowsOf({ wavelengthNm, R_s, R_p, T_s, T_p }: Spectrum): string[][] {
  const columns = [mean(R_s, R_p), R_s, R_p, mean(T_s, T_p), T_s, T_p];
  return wavelengthNm.map((nm, at) => [String(nm), ...columns.map((values) => (100 * (values[at] ?? NaN)).toFixed(2))]);
}

function plotted({ wavelengthNm, R_s, R_p, T_s, T_p }: Spectrum): uPlot.AlignedData {
  const curves = [R_s, R_p, mean(R_s, R_p), T_s, T_p, mean(T_s, T_p)];
  return [[...wavelengthNm], ...curves.map((values) => values.map((value) => 100 * value))];
}

function curvesOf(showsT: boolean): Curve[] {
  const reflected: Curve[] = [{ stroke: "--plot-s" }, { stroke: "--plot-p" }, { stroke: "--plot-r", width: 2.5 }];
  const strokes = ["--plot-s", "--plot-p", "--plot-t"] as const;
  return [...reflected, ...strokes.map((stroke) => ({ stroke, dash: DASH, show: showsT, width: stroke === "--plot-t" ? 2.5 : 1.5 }))];
}

function mean(s: readonly number[], p: readonly number[]): number[] {
  return s.map((value, at) => (value + (p[at] ?? NaN)) / 2);
}

/** A little above the largest value, and 100 % at most. */
function niceTop(most: number): number {
  const step = 10 ** Math.floor(Math.log10(Math.max(most, 0.1)));
  return Math.min(100, Math.ceil((1.02 * most) / step) * step);
}

/** The colours of the wavelengths, along the axis. */
function drawBand({ ctx, bbox, posToVal, valToPos }: uPlot): void {
  const height = BAND_PX * devicePixelRatio;
  for (let x = 0; x < bbox.width; x++) {
    const nm = posToVal(x / devicePixelRatio, "x");
    if (nm < VISIBLE_NM[0] || nm > VISIBLE_NM[1]) continue;
    ctx.fillStyle = hex(wavelengthColour(nm));
    ctx.globalAlpha = visibility(nm);
    ctx.fillRect(valToPos(nm, "x", true), bbox.top + bbox.height, 1.5, height);
  }
  ctx.globalAlpha = 1;
}

/** Light fades towards the ends of what the eye sees. */
function visibility(nm: number): number {
  return Math.min(1, (nm - VISIBLE_NM[0]) / 40, (VISIBLE_NM[1] - nm) / 80);
}
