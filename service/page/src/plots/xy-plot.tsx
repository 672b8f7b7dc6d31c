/** A plot of curves over x, as wide as its place: uPlot in the page's colours. */

import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import { plotFont, token } from "./tokens";
import { useSize } from "./use-size";
import "./xy-plot.css";
import { theme } from "../state/theme";

export interface XyAxis {
  readonly label: string;
  readonly scale?: string;
  readonly side?: 1 | 2 | 3;
}

export interface Curve {
  readonly stroke: `--${string}`;
  readonly width?: number;
  readonly dash?: number[];
  readonly scale?: string;
  readonly show?: boolean;
}

interface XyPlotProps {
  readonly label: string;
  readonly data: uPlot.AlignedData;
  readonly axes: readonly XyAxis[];
  readonly curves: readonly Curve[];
  readonly scales: uPlot.Scales;
  /** Draws below the curves. */
  readonly underlay?: (plot: uPlot) => void;
  readonly onCursor?: (index: number | undefined) => void;
}

export function XyPlot(props: XyPlotProps) {
  const [place, { width, height }] = useSize<HTMLDivElement>();
  const plot = useRef<uPlot>(undefined);
  const dressing = JSON.stringify([props.axes, props.curves, theme.value]);
  useEffect(() => {
    if (!place.current || width === 0) return undefined;
    plot.current = new uPlot(options(props, width, height), props.data, place.current);
    place.current.dataset["ink"] = token("--ink"); // that of the theme it has been drawn in
    return () => plot.current?.destroy();
  }, [dressing, width > 0]);
  useEffect(() => plot.current?.setData(props.data), [props.data]);
  useEffect(() => {
    if (width > 0) plot.current?.setSize({ width, height });
  }, [width, height]);
  return <div class="xy-plot" role="img" aria-label={props.label} ref={place} />;
}

function options({ axes, curves, scales, underlay, onCursor }: XyPlotProps, width: number, height: number): uPlot.Options {
  return {
    width,
    height,
    legend: { show: false },
    cursor: { y: false, drag: { setScale: false, x: false, y: false }, points: { size: 7 } },
    scales,
    axes: axes.map(axis),
    series: [{}, ...curves.map(series)],
    hooks: {
      drawClear: underlay ? [underlay] : [],
      setCursor: [({ cursor }) => onCursor?.(cursor.idx ?? undefined)],
    },
  };
}

function axis({ label, scale, side }: XyAxis, at: number): uPlot.Axis {
  const [ink, line] = [token("--ink-soft"), token("--plot-grid")];
  return {
    label,
    labelFont: plotFont(),
    labelSize: 20,
    font: plotFont(),
    stroke: ink,
    size: at === 0 ? 32 : 46,
    grid: { show: side !== 1, stroke: line, width: 1 },
    ticks: { stroke: line, width: 1, size: 4 },
    ...(scale ? { scale } : {}),
    ...(side === undefined ? {} : { side }),
  };
}

function series({ stroke, width = 1.5, dash, scale, show = true }: Curve): uPlot.Series {
  return { stroke: token(stroke), width, show, points: { show: false }, ...(dash ? { dash } : {}), ...(scale ? { scale } : {}) };
}
