// A film from its lookup textures. Texel centres and the order of rows are those of Nacreous' table contract.

struct NacreousAxis {
	float first;
	float last;
	int count;
	bool isExplicit;
};

uniform highp sampler2D nacreousTable;
uniform highp sampler2D nacreousAxisValues; // row 0: cos_theta, row 1: thickness_scale; read if an axis is explicit
uniform NacreousAxis nacreousAxisX;
uniform NacreousAxis nacreousAxisY;
#ifdef NACREOUS_TRANSMITTANCE
uniform highp sampler2D nacreousTransmittanceTable;
#endif

// Place of a value among samples at unequal steps, in texels: halve the interval that holds it.
float nacreousExplicitTexel(const in int count, const in int row, const in float value) {
	ivec2 interval = ivec2(0, count - 1);
	while (interval.y - interval.x > 1) {
		int middle = (interval.x + interval.y) / 2;
		bool isBelow = texelFetch(nacreousAxisValues, ivec2(middle, row), 0).r <= value;
		interval = isBelow ? ivec2(middle, interval.y) : ivec2(interval.x, middle);
	}
	float left = texelFetch(nacreousAxisValues, ivec2(interval.x, row), 0).r;
	float right = texelFetch(nacreousAxisValues, ivec2(interval.y, row), 0).r;
	return float(interval.x) + (right > left ? clamp((value - left) / (right - left), 0.0, 1.0) : 0.0);
}

// Place of a value along an axis in texels, 0 at the first centre.
float nacreousTexel(const in NacreousAxis axis, const in int row, const in float value) {
	if (axis.isExplicit) return nacreousExplicitTexel(axis.count, row, value);
	float span = axis.last - axis.first;
	float x = span > 0.0 ? clamp((value - axis.first) / span, 0.0, 1.0) : 0.0;
	return x * float(axis.count - 1);
}

vec3 nacreousLookup(const in highp sampler2D table, const in float cosTheta, const in float thicknessScale) {
	vec2 texel = vec2(nacreousTexel(nacreousAxisX, 0, cosTheta), nacreousTexel(nacreousAxisY, 1, thicknessScale));
	vec2 uv = (texel + 0.5) / vec2(textureSize(table, 0));
	return textureLod(table, vec2(uv.x, 1.0 - uv.y), 0.0).rgb; // v counts upwards, rows from the top
}

vec3 nacreousReflectance(const in float cosTheta, const in float thicknessScale) {
	return nacreousLookup(nacreousTable, cosTheta, thicknessScale);
}

#ifdef NACREOUS_TRANSMITTANCE
vec3 nacreousTransmittance(const in float cosTheta, const in float thicknessScale) {
	return nacreousLookup(nacreousTransmittanceTable, cosTheta, thicknessScale);
}
#endif
