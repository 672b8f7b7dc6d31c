// The film in three's physical lighting. A perfect mirror of the same roughness is lit by three itself, and what comes
// back is multiplied by the film's reflectance: at the half vector for lights, at the normal for surroundings.

uniform float nacreousThicknessScale;
#ifdef NACREOUS_THICKNESS_SCALE_MAP
uniform sampler2D nacreousThicknessScaleMap;
uniform mat3 nacreousThicknessScaleMapTransform;
uniform vec2 nacreousThicknessScaleRange;
#endif

float nacreousScale; // thickness_scale of this fragment

float nacreousScaleHere() {
	#ifdef NACREOUS_THICKNESS_SCALE_MAP
	vec2 uv = (nacreousThicknessScaleMapTransform * vec3(vUv, 1.0)).xy;
	float share = texture2D(nacreousThicknessScaleMap, uv).g;
	return nacreousThicknessScale * mix(nacreousThicknessScaleRange.x, nacreousThicknessScaleRange.y, share);
	#else
	return nacreousThicknessScale;
	#endif
}

// Lights are physical: a colour outside of the gamut must not take light away.
vec3 nacreousF(const in float cosTheta) {
	return max(nacreousReflectance(cosTheta, nacreousScale), vec3(0.0));
}

// Colour of a mirror's light. What facets keep from leaving at once, 1 - Ess of it, meets the film a second time
// (Turquin 2019, "Practical Multiple Scattering Compensation for Microfacet Models", equation 16).
vec3 nacreousTint(const in float cosTheta, const in PhysicalMaterial material) {
	vec3 F = nacreousF(cosTheta);
	return F * mix(F, vec3(1.0), saturate(material.dfg.x + material.dfg.y));
}

// Make the material a perfect mirror. The diffuse ground below stays as it is: diffuseContribution.
void nacreousMirror(inout PhysicalMaterial material) {
	material.diffuseColor = vec3(1.0);
	material.specularColor = vec3(1.0);
	material.specularColorBlended = vec3(1.0);
	material.specularF90 = 1.0;
	material.metalness = 1.0;
}

void RE_Direct_Nacreous(
	const in IncidentLight directLight, const in vec3 geometryPosition,
	const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal,
	const in PhysicalMaterial material, inout ReflectedLight reflectedLight
) {
	ReflectedLight mirror = ReflectedLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
	RE_Direct_Physical(
		directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal,
		material, mirror
	);
	float cosThetaH = saturate(dot(geometryViewDir, normalize(directLight.direction + geometryViewDir)));
	vec3 tint = nacreousTint(cosThetaH, material);
	vec3 irradiance = saturate(dot(geometryNormal, directLight.direction)) * directLight.color;
	reflectedLight.directSpecular += mirror.directSpecular * tint;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert(material.diffuseContribution) * (1.0 - tint);
}

#if NUM_RECT_AREA_LIGHTS > 0
void RE_Direct_RectArea_Nacreous(
	const in RectAreaLight rectAreaLight, const in vec3 geometryPosition,
	const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal,
	const in PhysicalMaterial material, inout ReflectedLight reflectedLight
) {
	ReflectedLight mirror = ReflectedLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
	RE_Direct_RectArea_Physical(
		rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal,
		material, mirror
	);
	vec3 tint = nacreousTint(saturate(dot(geometryNormal, geometryViewDir)), material);
	reflectedLight.directSpecular += mirror.directSpecular * tint;
	reflectedLight.directDiffuse += mirror.directDiffuse * (1.0 - tint);
}
#endif

void RE_IndirectDiffuse_Nacreous(
	const in vec3 irradiance, const in vec3 geometryPosition,
	const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal,
	const in PhysicalMaterial material, inout ReflectedLight reflectedLight
) {
	vec3 tint = nacreousTint(saturate(dot(geometryNormal, geometryViewDir)), material);
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert(material.diffuseContribution) * (1.0 - tint);
}

void RE_IndirectSpecular_Nacreous(
	const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition,
	const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal,
	const in PhysicalMaterial material, inout ReflectedLight reflectedLight
) {
	ReflectedLight mirror = ReflectedLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
	RE_IndirectSpecular_Physical(
		radiance, irradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal,
		material, mirror
	);
	vec3 tint = nacreousTint(saturate(dot(geometryNormal, geometryViewDir)), material);
	reflectedLight.indirectSpecular += mirror.indirectSpecular * tint;
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert(material.diffuseContribution) * (1.0 - tint);
}

#undef RE_Direct
#undef RE_Direct_RectArea
#undef RE_IndirectDiffuse
#undef RE_IndirectSpecular
#define RE_Direct RE_Direct_Nacreous
#define RE_Direct_RectArea RE_Direct_RectArea_Nacreous
#define RE_IndirectDiffuse RE_IndirectDiffuse_Nacreous
#define RE_IndirectSpecular RE_IndirectSpecular_Nacreous
