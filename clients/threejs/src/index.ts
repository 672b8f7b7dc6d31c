/**
 * Thin-film interference in three.js, from the lookup textures of Nacreous or computed in the shader.
 *
 * @packageDocumentation
 */

export type { Axis } from "./axis";
export type { Film, FilmLayer, LiveFilmOptions } from "./live-film";
export { LiveFilm, MAX_LAYERS } from "./live-film";
export type { LookupTexture, LookupTextureOptions, Quantity } from "./lookup-texture";
export { loadLookupTexture, parseLookupTexture } from "./lookup-texture";
export type { NacreousMaterialParameters } from "./nacreous-material";
export { NacreousMaterial } from "./nacreous-material";
export type { Reflectance } from "./reflectance";
export type { RefractiveIndex } from "./refractive-index";
export { tableReflectance } from "./table-reflectance";
