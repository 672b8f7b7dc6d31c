import {
  type IUniform,
  Matrix3,
  MeshPhysicalMaterial,
  type MeshPhysicalMaterialParameters,
  type Texture,
  Vector2,
  type WebGLProgramParametersWithUniforms,
} from "three";

import type { LookupTexture } from "./lookup-texture";
import type { Reflectance } from "./reflectance";
import lightingGLSL from "./shaders/lighting.glsl?raw";
import { tableReflectance } from "./table-reflectance";

/** A film, and what a physical material has beside it: `roughness`, `normalMap`, `clearcoat`, `envMap` and the rest. */
export interface NacreousMaterialParameters extends MeshPhysicalMaterialParameters {
  /** The film: its table of R, or a `LiveFilm`. */
  film: LookupTexture | Reflectance;
  /** The film's table of T: what lies behind is seen through it. */
  transmittance?: LookupTexture;
  /** Multiplies the thickness of every layer; 1 if absent. */
  thicknessScale?: number;
  /** Green channel: thickness_scale from `thicknessScaleRange[0]` at 0 to `[1]` at 1, times `thicknessScale`. */
  thicknessScaleMap?: Texture;
  thicknessScaleRange?: readonly [number, number];
}

/**
 * A physical material whose Fresnel term is that of a film.
 *
 * `color` with `metalness: 0` is a diffuse ground under the film, lit by what the film lets through; by default nothing
 * scatters below. For `WebGLRenderer`: three's node materials have no `onBeforeCompile`.
 */
export class NacreousMaterial extends MeshPhysicalMaterial {
  #reflectance: Reflectance;
  #thicknessScaleMap: Texture | undefined;
  readonly #uniforms = {
    nacreousThicknessScale: { value: 1 },
    nacreousThicknessScaleMap: { value: null as Texture | null },
    nacreousThicknessScaleMapTransform: { value: new Matrix3() },
    nacreousThicknessScaleRange: { value: new Vector2(0, 1) },
  } satisfies Record<string, IUniform>;

  constructor(parameters: NacreousMaterialParameters) {
    const { film, transmittance, thicknessScale, thicknessScaleMap, thicknessScaleRange, ...physical } = parameters;
    super();
    this.#reflectance = asReflectance(film, transmittance);
    // ior 1: a film between equal media bends nothing, and three blurs what it sees through by the bend.
    this.setValues({ metalness: 1, roughness: 0, ...(transmittance ? { transmission: 1, ior: 1 } : {}), ...physical });
    this.thicknessScale = thicknessScale ?? 1;
    this.thicknessScaleMap = thicknessScaleMap;
    this.thicknessScaleRange = thicknessScaleRange ?? [0, 1];
  }

  get thicknessScale(): number {
    return this.#uniforms.nacreousThicknessScale.value;
  }

  set thicknessScale(value: number) {
    this.#uniforms.nacreousThicknessScale.value = value;
  }

  get thicknessScaleMap(): Texture | undefined {
    return this.#thicknessScaleMap;
  }

  set thicknessScaleMap(map: Texture | undefined) {
    this.#thicknessScaleMap = map;
    this.#uniforms.nacreousThicknessScaleMap.value = map ?? null;
    const { USE_UV: _uv, NACREOUS_THICKNESS_SCALE_MAP: _map, ...without } = this.defines ?? {};
    this.defines = map ? { ...without, USE_UV: "", NACREOUS_THICKNESS_SCALE_MAP: "" } : without;
    this.needsUpdate = true;
  }

  get thicknessScaleRange(): readonly [number, number] {
    const { x, y } = this.#uniforms.nacreousThicknessScaleRange.value;
    return [x, y];
  }

  set thicknessScaleRange([atBlack, atWhite]: readonly [number, number]) {
    this.#uniforms.nacreousThicknessScaleRange.value.set(atBlack, atWhite);
  }

  /**
   * Show another film, and free what was the old one's own on the GPU: no tables. Films whose `key`s are equal, such as
   * two tables of R, share a program: then nothing is compiled.
   */
  setFilm(film: LookupTexture | Reflectance, transmittance?: LookupTexture): void {
    const [before, after] = [this.#reflectance, asReflectance(film, transmittance)];
    this.#reflectance = after;
    if (after.key !== before.key) this.needsUpdate = true;
    if (after !== before) before.dispose();
  }

  override copy(source: this): this {
    super.copy(source);
    this.#reflectance = source.#reflectance;
    this.thicknessScale = source.thicknessScale;
    this.thicknessScaleRange = source.thicknessScaleRange;
    this.thicknessScaleMap = source.thicknessScaleMap;
    return this;
  }

  override clone(): this {
    return new NacreousMaterial({ film: this.#reflectance }).copy(this) as this;
  }

  override dispose(): void {
    super.dispose();
    this.#reflectance.dispose();
  }

  override customProgramCacheKey(): string {
    return `nacreous ${this.#reflectance.key}`;
  }

  override onBeforeCompile(program: WebGLProgramParametersWithUniforms): void {
    Object.assign(program.uniforms, this.#filmUniforms(), this.#uniforms);
    program.fragmentShader = withFilm(program.fragmentShader, this.#reflectance);
  }

  /** The uniforms of whatever film there is when they are read: a program outlives the films it draws. */
  #filmUniforms(): Record<string, IUniform> {
    const current = (name: string) => this.#reflectance.uniforms[name]?.value;
    const names = Object.keys(this.#reflectance.uniforms);
    return Object.fromEntries(names.map((name) => [name, { get value() { return current(name); } }]));
  }

  override onBeforeRender(): void {
    const map = this.#thicknessScaleMap;
    if (!map) return;
    if (map.matrixAutoUpdate) map.updateMatrix();
    this.#uniforms.nacreousThicknessScaleMapTransform.value.copy(map.matrix);
  }
}

function asReflectance(film: LookupTexture | Reflectance, transmittance?: LookupTexture): Reflectance {
  if ("texture" in film) return tableReflectance(film, transmittance);
  if (transmittance) throw new Error("expected a table of R beside the table of T, found a film without one");
  return film;
}

/** three's physical shader with its lighting exchanged for ours. */
function withFilm(shader: string, film: Reflectance): string {
  const pars = (anchor: string) => `${anchor}\n${film.glsl}\n${lightingGLSL}`;
  const start = (anchor: string) => `${anchor}\nnacreousScale = nacreousScaleHere();\nnacreousMirror(material);`;
  const through = (anchor: string) => `${film.transmits ? SEEN_THROUGH : ""}\n${anchor}`;
  const lit = atInclude(atInclude(shader, "lights_physical_pars_fragment", pars), "lights_physical_fragment", start);
  return atInclude(lit, "transmission_fragment", through);
}

/** three multiplies what lies behind by the diffuse colour and by 1 - F: T is that product already. */
const SEEN_THROUGH = `
material.diffuseContribution = nacreousTransmittance(saturate(dot(geometryNormal, geometryViewDir)), nacreousScale);
material.specularColorBlended = vec3(0.0);
material.specularF90 = 0.0;`;

function atInclude(shader: string, chunk: string, edit: (anchor: string) => string): string {
  const anchor = `#include <${chunk}>`;
  if (!shader.includes(anchor)) throw new Error(`expected three.js r187: its physical shader has no ${anchor}`);
  return shader.replace(anchor, () => edit(anchor));
}
