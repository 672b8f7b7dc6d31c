/** Where a film can go: the formats that each program reads, and what to do with them there. */

import type { Change, SpecDocument } from "./document";
import { asFilm, asLobe, quantityOf } from "./quantity";
import * as snippets from "./snippets";

export interface Target {
  readonly name: string;
  readonly advice: string;
  /** What it reads, the best first; those that the table has are offered. */
  readonly formats: readonly string[];
  readonly snippet?: snippets.Snippet;
  /** Whose quantity it is for; without it for all. */
  readonly quantity?: "fresnel" | "bsdf";
  /** What else the files need. */
  readonly needs?: string;
}

const TEXTURE = ["exr", "exr-transmission"] as const;

export const TARGETS: readonly Target[] = [
  { name: "Blender", formats: TEXTURE, quantity: "fresnel", snippet: snippets.blender, advice: "Cycles and EEVEE, with the add-on: Film from Texture builds the material. Load by hand as Non-Color, linear, Extend." },
  { name: "Mitsuba 3", formats: ["spectral-exr", "spectral-exr-transmission", ...TEXTURE, "rgl", "rgl-rgb", "mueller"], snippet: snippets.mitsuba, advice: "A film: the plugin reads .spectral.exr in spectral variants and .exr in RGB ones. A rough surface: unmodified Mitsuba loads .bsdf, .rgb.bsdf in RGB variants." },
  { name: "pbrt-v4", formats: ["rgl"], quantity: "bsdf", snippet: snippets.pbrt, needs: "a roughness of 0.02 or more", advice: "Its measured material loads the spectral .bsdf as it is; reflection alone." },
  { name: "MaterialX", formats: ["materialx", ...TEXTURE], quantity: "fresnel", needs: "evenly spaced axes", advice: "Maya, Houdini, USD and Omniverse: keep the .mtlx and its textures in one folder under the names they come with." },
  { name: "three.js", formats: TEXTURE, quantity: "fresnel", snippet: snippets.threejs, advice: "The package @nacreous/three has a physical material that reads the texture." },
  { name: "glTF", formats: ["gltf"], quantity: "fresnel", advice: "The nearest film that KHR_materials_iridescence can show; the file says by how much it is off." },
  { name: "Unreal", formats: TEXTURE, quantity: "fresnel", snippet: snippets.unreal, advice: "Import as HDR without sRGB, mip levels and streaming; a Custom node reads it." },
  { name: "Unity", formats: TEXTURE, quantity: "fresnel", snippet: snippets.unity, advice: "Import as RGBA Float or Half without sRGB and mip levels; a Custom Function node reads it." },
  { name: "OSL", formats: TEXTURE, quantity: "fresnel", snippet: snippets.osl, advice: "Arnold, RenderMan and Cycles: load the textures raw; R is the colour of a reflection that has no Fresnel term of its own." },
  { name: "Python", formats: ["netcdf", "npz", "zarr"], snippet: snippets.python, advice: "xarray reads .nc and .zarr with units; .npz has every array for NumPy." },
  { name: "Spreadsheet", formats: ["csv", "png"], snippet: snippets.spreadsheet, advice: "One row a sample; lines that begin with # say where it comes from. The PNG is to look at, not to render with." },
  { name: "Other", formats: ["exr", "exr-transmission", "merl", "mbsdf"], advice: "Any renderer that can read a texture in the place of its Fresnel term; MERL and MDL's .mbsdf hold rough surfaces in RGB." },
];

/** What to change so that a target finds its formats: in words, and the change itself. */
export interface Wanting {
  readonly words: string;
  readonly change?: { readonly name: string; readonly make: Change };
}

/** Why a table has none of a target's formats. */
export function wanting({ name, quantity, needs }: Target, spec: SpecDocument): Wanting {
  if (quantity === "fresnel" && quantityOf(spec) !== "fresnel") {
    const words = `${name} reads the film alone, quantity “fresnel”; the roughness is the renderer's own there.`;
    return { words, change: { name: "Tabulate the film alone", make: asFilm } };
  }
  if (quantity === "bsdf" && quantityOf(spec) !== "bsdf") {
    const words = `${name} reads a rough surface, quantity “bsdf”, of one thickness and reflection alone.`;
    return { words, change: { name: "Tabulate a rough surface", make: asLobe } };
  }
  return { words: `${name} cannot read this table as it is${needs ? `: it needs ${needs}` : ""}.` };
}
