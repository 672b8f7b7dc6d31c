/**
 * What the shapes mirror: skies and lamps as formulas, each already blurred as a rough surface sees it.
 *
 * three would prefilter a drawn scene by 256 samples for every texel, which takes seconds without a GPU. Lamps here are
 * rectangles and the sky is three colours, which blur in closed form: every level of the cube is drawn once.
 */

import {
  BackSide,
  BoxGeometry,
  CubeCamera,
  HalfFloatType,
  LinearMipmapLinearFilter,
  LinearSRGBColorSpace,
  Mesh,
  ShaderMaterial,
  type Texture,
  Vector3,
  WebGLCubeRenderTarget,
  type WebGLRenderer,
} from "three";

import environmentGLSL from "./environment.glsl?raw";
import type { Light } from "../state/view";

type Colour = readonly [number, number, number];

/** A rectangle of light, seen from the middle of the scene. Lengths are tangents of angles. */
interface Lamp {
  readonly towards: Colour;
  readonly halfSize: readonly [number, number];
  readonly radiance: Colour;
}

interface Surroundings {
  readonly zenith: Colour;
  readonly horizon: Colour;
  readonly ground: Colour;
  readonly lamps: readonly Lamp[];
  /** How blurred the edges of lamps are: the standard deviation of a tangent. */
  readonly softness: number;
}

const LAMPS = 5; // as many as environment.glsl has room for
const NO_LAMP: Lamp = { towards: [0, 1, 0], halfSize: [0, 0], radiance: [0, 0, 0] };
const SIZE = 256; // texels of a cube's edge
/** log2 of the edge of three's roughest level, from PMREMGenerator of r187. */
const ROUGHEST = 3;

const SURROUNDINGS: Readonly<Record<Light, Surroundings>> = {
  studio: {
    softness: 0.012,
    zenith: [0.86, 0.88, 0.92],
    horizon: [0.5, 0.51, 0.53],
    ground: [0.2, 0.197, 0.204],
    lamps: [
      { towards: [-0.62, 0.62, 0.5], halfSize: [0.42, 0.3], radiance: [4.6, 4.5, 4.3] },
      { towards: [0.93, 0.28, 0.25], halfSize: [0.13, 0.6], radiance: [3, 3.1, 3.3] },
      { towards: [-0.9, 0.05, -0.4], halfSize: [0.12, 0.6], radiance: [2.6, 2.6, 2.7] },
      { towards: [0.15, 0.85, -0.5], halfSize: [0.7, 0.18], radiance: [3.4, 3.4, 3.5] },
      { towards: [0.35, -0.2, 0.92], halfSize: [0.3, 0.12], radiance: [0.5, 0.5, 0.52] },
    ],
  },
  overcast: {
    softness: 0.3,
    zenith: [1.35, 1.38, 1.42],
    horizon: [0.78, 0.8, 0.83],
    ground: [0.34, 0.335, 0.325],
    lamps: [{ towards: [-0.3, 0.9, 0.35], halfSize: [0.9, 0.9], radiance: [0.55, 0.54, 0.5] }],
  },
  sunset: {
    softness: 0.03,
    zenith: [0.24, 0.34, 0.6],
    horizon: [1.1, 0.56, 0.3],
    ground: [0.16, 0.12, 0.115],
    lamps: [
      { towards: [-0.8, 0.16, 0.45], halfSize: [0.06, 0.06], radiance: [60, 32, 12] },
      { towards: [-0.8, 0.14, 0.45], halfSize: [0.55, 0.16], radiance: [2.6, 1.15, 0.4] },
      { towards: [0.75, 0.42, -0.35], halfSize: [0.6, 0.1], radiance: [0.75, 0.36, 0.42] },
      { towards: [0.2, 0.3, 0.9], halfSize: [0.7, 0.06], radiance: [0.5, 0.34, 0.42] },
    ],
  },
};

/** An environment that three takes as prefiltered: level by level for rougher surfaces. */
export function environment(renderer: WebGLRenderer, light: Light): Texture {
  const target = cube();
  const { softness } = SURROUNDINGS[light];
  const room = new Mesh(new BoxGeometry(5, 5, 5), material(SURROUNDINGS[light]));
  const camera = new CubeCamera(1, 10, target);
  const roughest = target.texture.mipmaps.length - 1;
  for (let level = 0; level <= roughest; level++) {
    room.material.uniforms.blur!.value = Math.hypot(softness, blurAt(level / roughest));
    drawLevel(renderer, camera, room, level);
  }
  room.geometry.dispose();
  room.material.dispose();
  return target.texture;
}

function cube(): WebGLCubeRenderTarget {
  const target = new WebGLCubeRenderTarget(SIZE, {
    minFilter: LinearMipmapLinearFilter,
    generateMipmaps: false,
    type: HalfFloatType,
    colorSpace: LinearSRGBColorSpace,
    depthBuffer: false,
  });
  for (let edge = SIZE; edge >= 1 << ROUGHEST; edge /= 2) target.texture.mipmaps.push({ width: edge, height: edge } as never);
  target.texture.isPMREMTexture = true;
  return target;
}

function drawLevel(renderer: WebGLRenderer, camera: CubeCamera, room: Mesh, level: number): void {
  const { renderTarget } = camera;
  const edge = SIZE >> level;
  camera.activeMipmapLevel = level;
  renderTarget.viewport.set(0, 0, edge, edge);
  camera.update(renderer, room as never);
}

/**
 * Width of the blur at a level, as the standard deviation of a tangent.
 *
 * three: level / roughest = 1 - (1 - roughness)^2. Half of the facets of a GGX surface lie within atan(alpha), and a
 * mirrored ray turns twice as far: for a Gaussian half lies within 1.18 standard deviations.
 */
function blurAt(share: number): number {
  const roughness = 1 - Math.sqrt(1 - share);
  return (2 / 1.18) * roughness ** 2;
}

function material({ zenith, horizon, ground, lamps }: Surroundings): ShaderMaterial {
  const all = Array.from({ length: LAMPS }, (_, which) => lamps[which] ?? NO_LAMP);
  return new ShaderMaterial({
    side: BackSide,
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    uniforms: {
      blur: { value: 0 },
      zenith: { value: new Vector3(...zenith) },
      horizon: { value: new Vector3(...horizon) },
      ground: { value: new Vector3(...ground) },
      lampTowards: { value: all.map(({ towards }) => new Vector3(...towards).normalize()) },
      lampHalfSize: { value: all.map(({ halfSize: [x, y] }) => new Vector3(x, y, 0)) },
      lampRadiance: { value: all.map(({ radiance }) => new Vector3(...radiance)) },
    },
    vertexShader: "varying vec3 direction; void main() { direction = (modelMatrix * vec4(position, 1.0)).xyz; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: environmentGLSL,
  });
}
