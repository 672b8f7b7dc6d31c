/** The film on a shape, in light. */

import { effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

import { Choice } from "./choice";
import "./preview.css";
import { NoWebGLError } from "./no-webgl";
import type { Stage } from "./stage";
import { drawSwatch } from "./swatch";
import { turnBy } from "./turning";
import { spec } from "../state/editor";
import { type Lookup, lookup } from "../state/lookup";
import { theme } from "../state/theme";
import { type Light, LIGHTS, light, type Shape, SHAPES, shape } from "../state/view";

const CALLED: Readonly<Record<Shape, string>> = { sphere: "a sphere", teapot: "a teapot", wing: "butterfly wings", lens: "a lens" };
const LIT: Readonly<Record<Light, string>> = { studio: "studio light", overcast: "an overcast sky", sunset: "sunset" };

/** Why nothing can be drawn in three dimensions; empty where it can. */
const missing = signal("");

export function Preview() {
  return (
    <section class="preview" aria-labelledby="preview-title">
      <h2 id="preview-title" class="preview-title">
        Preview
      </h2>
      {missing.value ? <Flat /> : <Solid />}
      <div class="preview-choices">
        <Choice legend="Shape" values={SHAPES} chosen={shape} />
        <Choice legend="Light" values={LIGHTS} chosen={light} />
      </div>
    </section>
  );
}

function Solid() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => staged(canvas.current!), []);
  return (
    <>
      <canvas
        ref={canvas}
        class="preview-canvas"
        role="img"
        tabIndex={0}
        aria-label={`${spec.value.name || "The film"} on ${CALLED[shape.value]}, ${LIT[light.value]}`}
        aria-describedby="preview-hint"
      />
      <p id="preview-hint" class="preview-hint">
        Drag or use the arrow keys to turn. Home turns back.
      </p>
    </>
  );
}

/** Why there is no solid shape, and the colours as they are. */
function Flat() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const film = lookup.value.answer?.reflectance;
  useEffect(() => {
    if (film && canvas.current) drawSwatch(canvas.current, film);
  }, [film]);
  return (
    <div class="preview-flat">
      <canvas ref={canvas} width={320} height={320} role="img" aria-label={`Colours of ${spec.value.name || "the film"} over the angle`} />
      <p role="status">
        {missing.value} The disc shows the colours of the film from straight ahead in the middle to grazing at its edge.
      </p>
    </div>
  );
}

/** Keep a canvas drawn until the returned function is called. */
function staged(canvas: HTMLCanvasElement): () => void {
  const ended = new AbortController();
  import("./stage").then(({ Stage }) => {
    if (!ended.signal.aborted) perform(new Stage(canvas, (drawn) => note(canvas, drawn)), canvas, ended.signal);
  }).catch((error: unknown) => {
    missing.value = error instanceof NoWebGLError ? error.message : "The preview could not be loaded: reload the page to try again.";
    effect(() => void (isSettled(lookup.value.answer) && setReady()));
  });
  return () => ended.abort();
}

function perform(stage: Stage, canvas: HTMLCanvasElement, signal: AbortSignal): void {
  const sizes = new ResizeObserver(() => stage.resize(canvas.clientWidth, canvas.clientHeight));
  sizes.observe(canvas);
  turnBy(canvas, stage, signal);
  const stops = [
    effect(() => stage.show({ shape: shape.value, light: light.value, theme: theme.value })),
    wearing(stage),
    () => sizes.disconnect(),
    () => stage.dispose(),
  ];
  signal.addEventListener("abort", () => stops.forEach((stop) => stop()));
}

/** Put every film that comes on the shape, until the returned function is called. */
function wearing(stage: Stage): () => void {
  let worn: Lookup | undefined;
  return effect(() => {
    const { answer, problem } = lookup.value;
    if (problem) setReady();
    if (!answer || answer === worn) return;
    worn = answer;
    stage.wear(answer, answer.pace === "resting" ? "fine" : "coarse");
  });
}

/** What has been drawn, for whoever cannot see it. */
function note(canvas: HTMLCanvasElement, { table, size, pace }: Lookup): void {
  canvas.dataset.table = table.id;
  canvas.dataset.size = `${size.cosTheta}x${size.scales}`;
  if (pace === "resting") setReady();
}

function setReady(): void {
  document.documentElement.dataset.ready = "";
}

function isSettled(answer: Lookup | undefined): boolean {
  return answer?.pace === "resting" || lookup.value.problem !== undefined;
}

