/** The film's textures on this GPU. */

import type { LookupTexture } from "@nacreous/three";
import { DataTexture, DataUtils, HalfFloatType, type WebGLRenderer } from "three";

import type { Lookup } from "../state/lookup";

/** The film's colours as a material takes them. */
export type Films = Pick<Lookup, "reflectance" | "transmittance">;

/** As they came; in half precision where the GPU filters no others, as on some phones. */
export function forThisGpu(films: Films, renderer: WebGLRenderer): Films {
  if (renderer.extensions.has("OES_texture_float_linear")) return films;
  const { reflectance, transmittance } = films;
  return { reflectance: halved(reflectance), ...(transmittance ? { transmittance: halved(transmittance) } : {}) };
}

/** The numbers stay: only the GPU's copies go. */
export function freeTextures({ reflectance, transmittance }: Films): void {
  reflectance.texture.dispose();
  transmittance?.texture.dispose();
}

function halved(film: LookupTexture): LookupTexture {
  const texture: DataTexture = film.texture.clone();
  const { data, width, height } = film.texture.image;
  const halves = Uint16Array.from(data as Float32Array, (value) => DataUtils.toHalfFloat(value));
  texture.image = { data: halves, width, height };
  texture.type = HalfFloatType;
  texture.needsUpdate = true;
  return { ...film, texture };
}
