/**
 * From light to the screen: as it is up to 80 % of white, and a bend above that keeps the hue.
 *
 * ACES and AgX turn hues and grey them, Khronos' neutral curve takes up to 4 % away from every colour, which is a whole
 * film of low reflectance. The bend is that curve's upper part. Exposure is 1: a lamp's radiance says how bright it is.
 */

import { CustomToneMapping, ShaderChunk, type WebGLRenderer } from "three";

const AS_THREE_HAS_IT = "vec3 CustomToneMapping( vec3 color ) { return color; }";
const BENT_ABOVE = `
vec3 CustomToneMapping( vec3 color ) {
	const float bend = 0.8;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak <= bend ) return color;
	float bent = 1.0 - ( 1.0 - bend ) * ( 1.0 - bend ) / ( peak + 1.0 - 2.0 * bend );
	float white = 1.0 - 1.0 / ( 0.15 * ( peak - bent ) + 1.0 );
	return mix( color * bent / peak, vec3( bent ), white );
}`;

export function setTone(renderer: WebGLRenderer): void {
  ShaderChunk.tonemapping_pars_fragment = ShaderChunk.tonemapping_pars_fragment.replace(AS_THREE_HAS_IT, BENT_ABOVE);
  renderer.toneMapping = CustomToneMapping;
}
