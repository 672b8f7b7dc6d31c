/** A butterfly with its wings spread: thin bent cards with veins and a dark margin, and a body between them. */

import {
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  CatmullRomCurve3,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  type Texture,
  TubeGeometry,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import type { ShapeModel } from "./shape";
import { EXTENT, type Outline, smooth, wingMaps } from "./wing-maps";

/** The right side, seen from above: the root first, then around. Own drawing after the outline of a Morpho. */
const FORE: Outline = [
  [0.06, 0.12], [0.35, 0.55], [0.72, 0.86], [1.1, 0.98], [1.3, 0.92], [1.29, 0.72], [1.19, 0.45], [1.13, 0.2],
  [1.02, 0.03], [0.72, -0.04], [0.38, -0.06],
];
const HIND: Outline = [
  [0.06, 0.0], [0.42, 0.03], [0.78, 0.02], [0.99, -0.1], [1.04, -0.34], [0.94, -0.6], [0.76, -0.8], [0.55, -0.93],
  [0.38, -0.86], [0.24, -0.6], [0.12, -0.3],
];
const OUTWARDS = 16;
const TILT = -0.85; // the insect sits on a slope that faces the camera

export function wing(): ShapeModel {
  const cards = [card(HIND, 1, -0.03), card(HIND, -1, -0.03), card(FORE, 1, 0), card(FORE, -1, 0)];
  const geometry = mergeGeometries(cards).rotateX(TILT).translate(0, 0.06, 0);
  const { darkness, thickness } = wingMaps([FORE, HIND]);
  return {
    geometry,
    beside: [...body(), pigment(geometry, darkness)],
    thickness,
    thicknessScaleRange: [0.85, 1.15],
    isCard: true,
    shadow: { y: -0.98, radius: 1.2 },
  };
}

/** Veins and margin, black upon the film: also where it is seen through. */
function pigment(geometry: BufferGeometry, darkness: Texture): Mesh {
  const look = { color: 0x050404, alphaMap: darkness, transparent: true, side: DoubleSide, depthWrite: false };
  return new Mesh(geometry, new MeshBasicMaterial({ ...look, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4 }));
}

/** One wing, as rays from its root to its smooth outline. */
function card(outline: Outline, side: 1 | -1, below: number): BufferGeometry {
  const rim = smooth(outline);
  const [rootX, rootY] = outline[0]!;
  const positions: number[] = [];
  const uvs: number[] = [];
  for (const [rimX, rimY] of rim) {
    for (let step = 0; step <= OUTWARDS; step++) {
      const share = step / OUTWARDS;
      const [x, y] = [rootX + share * (rimX - rootX), rootY + share * (rimY - rootY)];
      positions.push(side * x, y, bend(x, y) + below);
      uvs.push(x / EXTENT, 0.5 + y / (2 * EXTENT));
    }
  }
  return surface(rim.length - 1, positions, uvs, side);
}

/** Height of a wing: raised from the body, and arched, as a membrane between veins is. */
function bend(x: number, y: number): number {
  return 0.42 * x - 0.2 * x * x + 0.012 * Math.sin(9 * Math.atan2(y + 0.05, x)) * x;
}

function surface(rays: number, positions: number[], uvs: number[], side: 1 | -1): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("uv", new BufferAttribute(new Float32Array(uvs), 2));
  const triangles: number[] = [];
  for (let ray = 0; ray < rays; ray++) {
    for (let step = 0; step < OUTWARDS; step++) {
      const [a, b] = [ray * (OUTWARDS + 1) + step, (ray + 1) * (OUTWARDS + 1) + step];
      // outlines go clockwise on the right: their mirror images the other way around
      triangles.push(...(side === 1 ? [a, b, a + 1, b, b + 1, a + 1] : [a, a + 1, b, b, a + 1, b + 1]));
    }
  }
  geometry.setIndex(triangles);
  geometry.computeVertexNormals();
  return geometry;
}

function body(): Object3D[] {
  const dark = new MeshBasicMaterial({ color: 0x0b0a0a });
  const thorax = new Mesh(new CapsuleGeometry(0.055, 0.62, 6, 16), dark);
  thorax.position.set(0, -0.1, 0.02);
  const feelers = [1, -1].map((side) => {
    const path = [[0, 0.22, 0.04], [0.1 * side, 0.5, 0.16], [0.24 * side, 0.72, 0.22]] as const;
    const curve = new CatmullRomCurve3(path.map((point) => new Vector3(...point)));
    return new Mesh(new TubeGeometry(curve, 24, 0.007, 6), dark);
  });
  const insect = [thorax, ...feelers];
  for (const part of insect) {
    part.geometry.translate(part.position.x, part.position.y, part.position.z);
    part.position.set(0, 0, 0);
    part.rotation.x = TILT;
  }
  return insect;
}
