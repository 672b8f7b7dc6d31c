/** What is drawn on a wing: veins and a margin that are dark, and a membrane of uneven thickness. */

import { CanvasTexture, CatmullRomCurve3, Vector3 } from "three";

/** Points (x, y) around a wing, its root first. */
export type Outline = readonly (readonly [number, number])[];

const AROUND = 96;

/** Points on the smooth curve through an outline; the last one is the first again. */
export function smooth(outline: Outline): [number, number][] {
  const curve = new CatmullRomCurve3(outline.map(([x, y]) => new Vector3(x, y, 0)), true, "centripetal");
  return curve.getPoints(AROUND).map(({ x, y }) => [x, y]);
}

/** Half the width and height of what the maps span: u from the body outwards, v upwards. */
export const EXTENT = 1.4;

const PIXELS = 512;

export interface WingMaps {
  readonly darkness: CanvasTexture;
  readonly thickness: CanvasTexture;
}

export function wingMaps(outlines: readonly Outline[]): WingMaps {
  return { darkness: drawn(outlines, dark), thickness: drawn(outlines, thick) };
}

type Draw = CanvasRenderingContext2D;

function drawn(outlines: readonly Outline[], paint: (draw: Draw, outline: Outline) => void): CanvasTexture {
  const canvas = Object.assign(document.createElement("canvas"), { width: PIXELS, height: 2 * PIXELS });
  const draw = canvas.getContext("2d")!;
  draw.fillStyle = "#808080";
  draw.fillRect(0, 0, canvas.width, canvas.height);
  draw.lineCap = draw.lineJoin = "round";
  for (const outline of [...outlines].reverse()) paint(draw, outline); // the fore wing lies above
  const texture = new CanvasTexture(canvas);
  texture.anisotropy = 4;
  return texture;
}

function pixel([x, y]: readonly [number, number]): [number, number] {
  return [(x / EXTENT) * PIXELS, (1 - y / EXTENT) * PIXELS];
}

function dark(draw: Draw, outline: Outline): void {
  draw.fillStyle = "#000";
  draw.save();
  trace(draw, smooth(outline));
  draw.fill();
  draw.clip();
  draw.strokeStyle = "rgb(255 255 255 / 17%)";
  for (let width = 6; width <= 96; width += 5) stroked(draw, margin(outline), width);
  draw.strokeStyle = "rgb(255 255 255 / 60%)";
  for (const vein of veins(outline)) line(draw, vein, 2.2);
  draw.restore();
}

/** Thinner towards the margin, and thicker along the veins. */
function thick(draw: Draw, outline: Outline): void {
  draw.save();
  trace(draw, smooth(outline));
  draw.clip();
  draw.strokeStyle = "rgb(60 60 60 / 8%)";
  for (let width = 20; width <= 260; width += 24) stroked(draw, margin(outline), width);
  draw.strokeStyle = "rgb(190 190 190 / 12%)";
  for (const vein of veins(outline)) for (const width of [34, 22, 12]) line(draw, vein, width);
  draw.restore();
}

/** The edge away from the body. */
function margin(outline: Outline): Outline {
  const points = smooth(outline);
  return points.slice(Math.round(0.24 * points.length), Math.round(0.78 * points.length));
}

/** From the root towards the outline, between the second and the last but one of its points. */
function veins(outline: Outline): [number, number][][] {
  const [rootX, rootY] = outline[0]!;
  return outline.slice(2, -1).map(([x, y], which) => {
    const middle: [number, number] = [rootX + 0.55 * (x - rootX), rootY + 0.55 * (y - rootY) + 0.03 * Math.cos(which)];
    return [[rootX, rootY], middle, [x, y]];
  });
}

function trace(draw: Draw, points: Outline): void {
  draw.beginPath();
  for (const point of points) draw.lineTo(...pixel(point));
}

function stroked(draw: Draw, points: Outline, width: number): void {
  draw.lineWidth = width;
  trace(draw, points);
  draw.stroke();
}

function line(draw: Draw, vein: [number, number][], width: number): void {
  const [from, middle, to] = vein.map(pixel);
  draw.lineWidth = width;
  draw.beginPath();
  draw.moveTo(...from!);
  draw.quadraticCurveTo(...middle!, ...to!);
  draw.stroke();
}
