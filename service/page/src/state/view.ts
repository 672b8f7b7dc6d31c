/** How the film is looked at; none of it is part of the spec. */

import { signal } from "@preact/signals";

export const SHAPES = ["sphere", "teapot", "wing", "lens"] as const;
export const LIGHTS = ["studio", "overcast", "sunset"] as const;

export type Shape = (typeof SHAPES)[number];
export type Light = (typeof LIGHTS)[number];

export const shape = signal<Shape>("sphere");
export const light = signal<Light>("studio");
/** Angle of incidence of the spectrum and of the lobe, in degrees. */
export const thetaDegrees = signal(0);
