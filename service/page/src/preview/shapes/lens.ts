/** A biconvex lens in front of a ruled card. */

import { CanvasTexture, DoubleSide, LatheGeometry, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace, Vector2 } from "three";

import type { ShapeModel } from "./shape";

const APERTURE = 1.02;
const SAGITTA = 0.3;
const EDGE = 0.05;
const STEPS = 40;

export function lens(): ShapeModel {
  const geometry = new LatheGeometry(profile(), 128);
  geometry.rotateX(Math.PI / 2).rotateX(-0.12).rotateY(0.42).translate(0, 0.05, 0);
  return { geometry, beside: [ruledCard()], glass: { ior: 1.5, thickness: 0.7 }, shadow: { y: -1.02, radius: 0.7 } };
}

/** From the middle of the back over the rim to the middle of the front; a lathe's outside is on the right. */
function profile(): Vector2[] {
  const radius = (APERTURE ** 2 + SAGITTA ** 2) / (2 * SAGITTA);
  const half = Math.asin(APERTURE / radius);
  const cap = Array.from({ length: STEPS }, (_, step) => {
    const angle = (half * step) / (STEPS - 1);
    return new Vector2(radius * Math.sin(angle), radius * (Math.cos(angle) - Math.cos(half)) + EDGE);
  });
  const rim = [-0.6, 0, 0.6].map((share) => new Vector2(APERTURE + 0.02 * Math.cos(share), EDGE * share));
  return [...cap.map(({ x, y }) => new Vector2(x, -y)), ...rim, ...cap.reverse()];
}

function ruledCard(): Mesh {
  const card = new Mesh(new PlaneGeometry(2.3, 1.6), new MeshBasicMaterial({ map: ruling(), side: DoubleSide }));
  card.position.set(0.35, -0.22, -1.15);
  card.rotation.set(-0.08, -0.12, 0);
  return card;
}

/** Lines at equal distances, every fifth a heavy one, as on a test chart. */
function ruling(): CanvasTexture {
  const canvas = Object.assign(document.createElement("canvas"), { width: 920, height: 640 });
  const draw = canvas.getContext("2d")!;
  draw.fillStyle = "#a9a9a6";
  draw.fillRect(0, 0, canvas.width, canvas.height);
  draw.strokeStyle = "#3a3a3b";
  for (let x = 0; x * 32 <= canvas.width; x++) rule(draw, x, [x * 32 + 12, 0], [x * 32 + 12, canvas.height]);
  for (let y = 0; y * 32 <= canvas.height; y++) rule(draw, y, [0, y * 32], [canvas.width, y * 32]);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 4;
  return texture;
}

function rule(draw: CanvasRenderingContext2D, which: number, from: readonly [number, number], to: readonly [number, number]): void {
  draw.lineWidth = which % 5 === 0 ? 5 : 1.6;
  draw.beginPath();
  draw.moveTo(...from);
  draw.lineTo(...to);
  draw.stroke();
}
