// A film computed where it is seen, from the indices of its media: unpolarised reflectance as a linear colour.
//
// The field (E, H) is carried from the substrate outwards, each layer times e^-D, D its decay, so that thick metals
// neither overflow nor lose the front of the film (Born and Wolf, Principles of Optics, 1.6.2; the reflectance is a
// ratio of fields, which the factors leave as it is). Time factor exp(-i w t), index n + ik, k >= 0.

// A column for each wavelength: (weights of R G B, nm), then (n, k) of the media from the outside inwards.
uniform highp sampler2D nacreousSpectra;
uniform float nacreousThicknessNm[NACREOUS_LAYERS];

const float NACREOUS_TURN = 6.283185307179586;

vec2 nacreousMultiply(const in vec2 a, const in vec2 b) {
	return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

vec2 nacreousDivide(const in vec2 a, const in vec2 b) {
	return nacreousMultiply(a, vec2(b.x, -b.y)) / dot(b, b);
}

vec2 nacreousTimesMinusI(const in vec2 z) {
	return vec2(z.y, -z.x);
}

// Root of a number in the upper half plane that lies in its first quarter, without cancellation.
vec2 nacreousRoot(const in vec2 z) {
	float larger = sqrt(0.5 * (length(z) + abs(z.x)));
	float smaller = larger > 0.0 ? 0.5 * z.y / larger : 0.0;
	return z.x >= 0.0 ? vec2(larger, smaller) : vec2(smaller, larger);
}

// kz over the vacuum wave number: kz^2 = (n^2 - n0^2) + (n0 cos)^2 needs no sine, and does not cancel at grazing.
vec2 nacreousKz(const in vec2 index2, const in float n0, const in float cosTheta) {
	return nacreousRoot(index2 + vec2(n0 * n0 * (cosTheta * cosTheta - 1.0), 0.0));
}

struct NacreousField {
	vec2 E;
	vec2 H;
};

// (E, H) in front of a layer: (C E - i (S / b) H, C H - i (b S) E), C and S its cosine and sine, b its admittance.
NacreousField nacreousCross(const in NacreousField behind, const in vec2 C, const in vec2 SoverB, const in vec2 bS) {
	return NacreousField(
		nacreousMultiply(C, behind.E) + nacreousTimesMinusI(nacreousMultiply(SoverB, behind.H)),
		nacreousMultiply(C, behind.H) + nacreousTimesMinusI(nacreousMultiply(bS, behind.E))
	);
}

// sin(delta) / kz of a layer, its decay taken out, where S is sin(delta) so: by its series near kz = 0.
vec2 nacreousSineOverKz(const in vec2 S, const in vec2 kz, const in float t) {
	vec2 delta = NACREOUS_TURN * t * kz;
	if (dot(delta, delta) > 1e-4) return nacreousDivide(S, kz);
	return NACREOUS_TURN * t * exp(-delta.y) * (vec2(1.0, 0.0) - nacreousMultiply(delta, delta) / 6.0);
}

// Carry s and p to the front of a layer that is t wavelengths thick; b is kz for s and kz / n^2 for p.
void nacreousCrossLayer(
	inout NacreousField s, inout NacreousField p, const in vec2 index2, const in vec2 kz, const in float t
) {
	float turns = t * kz.x;
	float phase = NACREOUS_TURN * (turns - round(turns)); // whole turns change nothing, and would cost digits
	float decay2 = exp(-2.0 * NACREOUS_TURN * t * kz.y);
	vec2 C = 0.5 * vec2(cos(phase) * (1.0 + decay2), -sin(phase) * (1.0 - decay2));
	vec2 S = 0.5 * vec2(sin(phase) * (1.0 + decay2), cos(phase) * (1.0 - decay2));
	vec2 SoverKz = nacreousSineOverKz(S, kz, t);
	vec2 kzS = nacreousMultiply(kz, S);
	s = nacreousCross(s, C, SoverKz, kzS);
	p = nacreousCross(p, C, nacreousMultiply(index2, SoverKz), nacreousDivide(kzS, index2));
}

float nacreousFieldReflectance(const in NacreousField front, const in float b0) {
	vec2 back = b0 * front.E - front.H;
	vec2 forth = b0 * front.E + front.H;
	return dot(back, back) / dot(forth, forth);
}

// n^2 of a medium, counted from 0 outside, at a wavelength.
vec2 nacreousIndex2(const in int column, const in int medium) {
	vec2 index = texelFetch(nacreousSpectra, ivec2(column, medium + 1), 0).xy;
	return nacreousMultiply(index, index);
}

// Reflectance at one wavelength, the mean of s and p.
float nacreousSpectralReflectance(const in int column, const in float cosTheta, const in float thicknessScale) {
	float scalePerNm = thicknessScale / texelFetch(nacreousSpectra, ivec2(column, 0), 0).w;
	float n0 = texelFetch(nacreousSpectra, ivec2(column, 1), 0).x;
	vec2 index2 = nacreousIndex2(column, NACREOUS_LAYERS + 1);
	vec2 kz = nacreousKz(index2, n0, cosTheta);
	NacreousField s = NacreousField(vec2(1.0, 0.0), kz);
	NacreousField p = NacreousField(vec2(1.0, 0.0), nacreousDivide(kz, index2));
	for (int layer = NACREOUS_LAYERS - 1; layer >= 0; --layer) {
		index2 = nacreousIndex2(column, layer + 1);
		nacreousCrossLayer(s, p, index2, nacreousKz(index2, n0, cosTheta), scalePerNm * nacreousThicknessNm[layer]);
	}
	return 0.5 * (nacreousFieldReflectance(s, n0 * cosTheta) + nacreousFieldReflectance(p, cosTheta / n0));
}

vec3 nacreousReflectance(const in float cosTheta, const in float thicknessScale) {
	vec3 colour = vec3(0.0);
	int columns = textureSize(nacreousSpectra, 0).x;
	for (int column = 0; column < columns; ++column) {
		vec3 weights = texelFetch(nacreousSpectra, ivec2(column, 0), 0).rgb;
		colour += weights * nacreousSpectralReflectance(column, cosTheta, thicknessScale);
	}
	return colour;
}
