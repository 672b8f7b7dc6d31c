/** Films that are computed in the shader: no table, and a thickness that moves at no cost. */

import { DataTexture, FloatType, type IUniform, NearestFilter, RGBAFormat } from "three";

import { colourWeights } from "./colour-weights";
import { indexAt, type RefractiveIndex } from "./refractive-index";
import type { Reflectance } from "./reflectance";
import filmGLSL from "./shaders/film.glsl?raw";

/** More layers are a matter for a table. */
export const MAX_LAYERS = 8;

export interface FilmLayer {
  readonly index: RefractiveIndex;
  readonly thicknessNm: number;
}

/** A stack in air or another transparent medium, its layers from the outside inwards. */
export interface Film {
  /** Index of the medium the light comes from; 1 if absent. */
  readonly incident?: number;
  readonly layers: readonly FilmLayer[];
  readonly substrate: RefractiveIndex;
}

export interface LiveFilmOptions {
  /** Wavelengths for each colour, at equal steps from 380 to 780 nm; 32 if absent. Thick films need more. */
  readonly wavelengths?: number;
}

/** A film of one to eight layers, evaluated wavelength by wavelength in the shader. */
export class LiveFilm implements Reflectance {
  readonly key: string;
  readonly glsl: string;
  readonly uniforms: Readonly<Record<string, IUniform>>;
  readonly transmits = false;
  readonly #thicknessNm: Float32Array;

  /** @throws Error if the film has no layers or too many. */
  constructor(film: Film, { wavelengths = 32 }: LiveFilmOptions = {}) {
    const count = film.layers.length;
    if (count < 1 || count > MAX_LAYERS) throw new Error(`expected 1 to ${MAX_LAYERS} layers, found ${count}`);
    this.key = `film of ${count}`;
    this.glsl = `#define NACREOUS_LAYERS ${count}\n${filmGLSL}`;
    this.#thicknessNm = Float32Array.from(film.layers, (layer) => layer.thicknessNm);
    this.uniforms = {
      nacreousSpectra: { value: spectra(film, wavelengths) },
      nacreousThicknessNm: { value: this.#thicknessNm },
    };
  }

  /** Change the thickness of a layer, counted from 0 on the outside; the next picture shows it. */
  setThicknessNm(layer: number, thicknessNm: number): void {
    this.#thicknessNm[layer] = thicknessNm;
  }

  dispose(): void {
    (this.uniforms.nacreousSpectra?.value as DataTexture).dispose();
  }
}

/** A column for each wavelength: its weights, then the index of each medium from the outside inwards. */
function spectra(film: Film, wavelengths: number): DataTexture {
  const { wavelengthNm, rgb } = colourWeights(wavelengths);
  const media = [film.incident ?? 1, ...film.layers.map((layer) => layer.index), film.substrate];
  const weights = wavelengthNm.flatMap((nm, sample) => [...(rgb[sample] ?? []), nm]);
  const indices = media.flatMap((medium) => wavelengthNm.flatMap((nm) => [...indexAt(medium, nm), 0, 0]));
  const data = Float32Array.from([...weights, ...indices]);
  const texture = new DataTexture(data, wavelengths, 1 + media.length, RGBAFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}
