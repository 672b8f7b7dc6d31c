/** The strip as a picture that one can point at: by mouse, by finger, and by the arrow keys. */

import type { LookupTexture } from "@nacreous/three";
import { useLayoutEffect } from "preact/hooks";

import { screenTable } from "../film/colour";
import { type Between, placeOn, rowColours } from "../film/lookup-colour";
import { type Size, useSize } from "./use-size";

/** A place on the strip. */
export interface StripPlace {
  readonly thetaDegrees: number;
  readonly scale: number;
}

interface StripPictureProps {
  readonly texture: LookupTexture;
  readonly chosen: StripPlace;
  /** The chosen place in words. */
  readonly described: string;
  readonly thicknessLabel: (scale: number) => string;
  readonly onChoose: (place: StripPlace) => void;
  readonly onHover: (place: StripPlace | undefined) => void;
}

const WIDEST_DEGREES = 90;
const STEPS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 0.01],
  ArrowDown: [0, -0.01],
  PageDown: [-10, 0],
  PageUp: [10, 0],
};

export function StripPicture({ texture, chosen, described, thicknessLabel, onChoose, onHover }: StripPictureProps) {
  const [canvas, size] = useSize<HTMLCanvasElement>();
  useLayoutEffect(() => {
    if (canvas.current && size.width > 0) draw(canvas.current, texture, size);
  }, [texture, size]);
  const [low, high] = texture.axes.y.range;
  const at = (event: PointerEvent) => placeAt(event, texture);
  return (
    <div class="strip-frame">
      <div class="strip-scales" aria-hidden="true">
        {[high, 1, low].map((scale) => <span key={scale}>{thicknessLabel(scale)}</span>)}
      </div>
      <div
        class="strip"
        role="slider"
        tabIndex={0}
        aria-label="Angle of incidence, and with the arrows up and down the thickness, on the strip of the film's colours"
        aria-valuemin={0}
        aria-valuemax={89}
        aria-valuenow={Math.round(chosen.thetaDegrees)}
        aria-valuetext={described}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          onChoose(at(event));
        }}
        onPointerMove={(event) => (event.buttons & 1 ? onChoose(at(event)) : onHover(at(event)))}
        onPointerLeave={() => onHover(undefined)}
        onKeyDown={(event) => {
          const step = STEPS[event.key];
          if (!step) return;
          event.preventDefault();
          onHover(undefined);
          onChoose({ thetaDegrees: chosen.thetaDegrees + step[0], scale: chosen.scale + step[1] });
        }}
      >
        <canvas ref={canvas} data-table={texture.id} data-size={`${texture.axes.x.count}x${texture.axes.y.count}`} />
        <span class="strip-line" style={{ top: percentage((high - 1) / (high - low)) }} />
        <span
          class="strip-mark"
          style={{
            left: percentage(chosen.thetaDegrees / WIDEST_DEGREES),
            top: percentage((high - chosen.scale) / (high - low)),
          }}
        />
      </div>
      <div class="strip-angles" aria-hidden="true">
        {[0, 30, 60, 90].map((theta) => <span key={theta}>{theta}°</span>)}
      </div>
      <p class="strip-axes" aria-hidden="true">Angle of incidence across, thickness upwards</p>
    </div>
  );
}

function percentage(share: number): string {
  return `${100 * share}%`;
}

function placeAt({ currentTarget, clientX, clientY }: PointerEvent, texture: LookupTexture): StripPlace {
  const { left, top, width, height } = (currentTarget as HTMLElement).getBoundingClientRect();
  const across = Math.min(Math.max((clientX - left) / width, 0), 1);
  const down = Math.min(Math.max((clientY - top) / height, 0), 1);
  const [low, high] = texture.axes.y.range;
  return { thetaDegrees: WIDEST_DEGREES * across, scale: high - down * (high - low) };
}

/** Angles from the left, thicknesses from the bottom; each pixel is read at its centre. */
function draw(canvas: HTMLCanvasElement, texture: LookupTexture, { width, height }: Size): void {
  canvas.width = Math.round(width * devicePixelRatio);
  canvas.height = Math.round(height * devicePixelRatio);
  const context = canvas.getContext("2d");
  if (!context) return;
  const picture = context.createImageData(canvas.width, canvas.height);
  const [low, high] = texture.axes.y.range;
  const columns = columnPlaces(texture, canvas.width);
  for (let y = 0; y < canvas.height; y++) {
    const down = placeOn(texture.axes.y, high - ((y + 0.5) / canvas.height) * (high - low));
    drawRow(picture.data.subarray(4 * y * canvas.width), rowColours(texture, down), columns);
  }
  context.putImageData(picture, 0, 0);
}

function columnPlaces({ axes }: LookupTexture, count: number): Between[] {
  return Array.from({ length: count }, (_, x) => placeOn(axes.x, Math.cos((((x + 0.5) / count) * Math.PI) / 2)));
}

function drawRow(pixels: Uint8ClampedArray, row: Float64Array, columns: readonly Between[]): void {
  const shown = screenTable();
  let at = 0;
  for (const { lower, part } of columns) {
    for (let left = 3 * lower; left < 3 * lower + 3; left++) {
      const [one = NaN, next = NaN] = [row[left], row[left + 3]];
      pixels[at++] = shown(one + part * (next - one));
    }
    pixels[at++] = 255;
  }
}
