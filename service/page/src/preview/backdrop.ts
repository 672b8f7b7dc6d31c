/** What lies behind a shape: a plain gradient, neutral so that it tints no film, and a soft shadow below. */

import { DataTexture, FloatType, LinearFilter, LinearSRGBColorSpace, Mesh, PlaneGeometry, RGBAFormat, ShaderMaterial, type Texture } from "three";

import type { Theme } from "../state/theme";
import type { Light } from "../state/view";

/** Greys from the bottom to the top, in linear light: darker than a page, or a bubble would not be seen against it. */
const GREYS: Readonly<Record<Theme, readonly number[]>> = {
  light: [0.36, 0.3, 0.21, 0.13, 0.09],
  dark: [0.055, 0.042, 0.028, 0.016, 0.01],
};
const TINTS: Readonly<Record<Light, readonly [number, number, number]>> = {
  studio: [1, 1, 1],
  overcast: [0.97, 1, 1.04],
  sunset: [1.12, 0.98, 0.94],
};

/** For `Scene.background`: one column, so that only the gradient takes memory. */
export function backdrop(theme: Theme, light: Light): Texture {
  const data = Float32Array.from(GREYS[theme].flatMap((grey) => [...TINTS[light].map((tint) => grey * tint), 1]));
  const texture = new DataTexture(data, 1, GREYS[theme].length, RGBAFormat, FloatType);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.colorSpace = LinearSRGBColorSpace;
  texture.needsUpdate = true;
  return texture;
}

export type Shadow = Mesh<PlaneGeometry, ShaderMaterial>;

/** A round shadow, darkest in the middle. */
export function shadow(): Shadow {
  const material = new ShaderMaterial({
    transparent: true,
    depthWrite: false,
    uniforms: { darkness: { value: 0.5 } },
    vertexShader: "varying vec2 place; void main() { place = 2.0 * uv - 1.0; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: "uniform float darkness; varying vec2 place; void main() { float d = dot(place, place); gl_FragColor = vec4(vec3(0.0), darkness * exp(-4.0 * d) * (1.0 - smoothstep(0.6, 1.0, d))); }",
  });
  const ground = new Mesh(new PlaneGeometry(2, 2).rotateX(-Math.PI / 2), material);
  ground.renderOrder = -1; // before what is seen through
  return ground;
}
