/** The shapes: what of them wears the film, and what stands beside it. */

import { type BufferGeometry, type Object3D, SphereGeometry, type Texture } from "three";
import { TeapotGeometry } from "three/addons/geometries/TeapotGeometry.js";

import { lens } from "./lens";
import { wing } from "./wing";
import type { Shape } from "../../state/view";

export interface ShapeModel {
  readonly geometry: BufferGeometry;
  /** Things that have no film. */
  readonly beside?: readonly Object3D[];
  /** Multiplies the thickness, over `thicknessScaleRange`: the green channel. */
  readonly thickness?: Texture;
  readonly thicknessScaleRange?: readonly [number, number];
  /** A card is seen from behind as well. */
  readonly isCard?: true;
  /** Seen through even where it is of another medium than the air: this index and thickness bend what lies behind. */
  readonly glass?: { readonly ior: number; readonly thickness: number };
  /** Height of what it stands on, and how wide its shadow is. */
  readonly shadow: { readonly y: number; readonly radius: number };
}

const MODELS: Readonly<Record<Shape, () => ShapeModel>> = { sphere, teapot, wing, lens };
const made = new Map<Shape, ShapeModel>();

/** Each is made when it is first looked at. */
export function shapeModel(shape: Shape): ShapeModel {
  const model = made.get(shape) ?? MODELS[shape]();
  made.set(shape, model);
  return model;
}

/** Of radius 1, around the origin. */
function sphere(): ShapeModel {
  return { geometry: new SphereGeometry(1, 96, 64), shadow: { y: -1.02, radius: 0.9 } };
}

function teapot(): ShapeModel {
  const geometry = new TeapotGeometry(0.74, 12);
  geometry.rotateY(-0.5);
  return { geometry, shadow: { y: -0.75, radius: 1.25 } };
}
