/** What a spec's surface and media mean for a physical material of three. */

import type { SpecDocument } from "../film/document";
import type { Surface } from "../service/answers";

/** The surface below the film, in three's terms. */
export interface Appearance {
  readonly roughness: number;
  readonly anisotropy: number;
  readonly anisotropyRotation: number;
  /** Albedo of the diffuse ground; 0 where nothing scatters below the film. */
  readonly ground: number;
}

/** Left out: `specular_weight`, and how the distributions differ; three has GGX alone. */
export function appearance({ surface }: SpecDocument): Appearance {
  const [alphaX, alphaY] = alphas(surface);
  const [smaller, larger] = [Math.min(alphaX, alphaY), Math.max(alphaX, alphaY)];
  return {
    roughness: Math.sqrt(Math.min(smaller, 1)), // three: alpha = roughness^2
    anisotropy: Math.sqrt(Math.max(0, larger - smaller) / (1 - Math.min(smaller, 0.99))), // three: mix(alpha, 1, anisotropy^2)
    anisotropyRotation: alphaX >= alphaY ? 0 : Math.PI / 2,
    ground: surface ? (surface.diffuse_weight ?? 0) * (surface.diffuse_reflectance ?? 0) : 0,
  };
}

/** Whether both sides of the film are the same medium: then what is seen through it is neither bent nor tinted. */
export function isBubble({ stack: { incident, substrate } }: SpecDocument): boolean {
  return JSON.stringify(incident) === JSON.stringify(substrate);
}

/** A spec without a surface is smooth. */
function alphas(surface: Surface | null | undefined): [number, number] {
  const x = surface?.alpha_x ?? fromExponent(surface?.exponent_x) ?? 0;
  return [x, surface?.alpha_y ?? fromExponent(surface?.exponent_y) ?? x];
}

/** Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", section 5.2. */
function fromExponent(exponent: number | null | undefined): number | undefined {
  return exponent == null ? undefined : Math.sqrt(2 / (exponent + 2));
}
