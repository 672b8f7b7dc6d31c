import type { IUniform } from "three";

/** A film as a shader sees it. */
export interface Reflectance {
  /** Distinguishes programs: equal keys mean equal `glsl`. */
  readonly key: string;
  /**
   * GLSL ES 3.00 that defines `vec3 nacreousReflectance(float cosTheta, float thicknessScale)` and, if `transmits`,
   * `vec3 nacreousTransmittance(float cosTheta, float thicknessScale)`: linear colours, which may be below 0 outside of
   * the gamut.
   */
  readonly glsl: string;
  readonly uniforms: Readonly<Record<string, IUniform>>;
  readonly transmits: boolean;
  /** Free the GPU's memory that is the film's own; tables that were passed in stay. */
  dispose(): void;
}
