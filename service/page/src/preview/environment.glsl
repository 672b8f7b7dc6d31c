// Radiance of a sky and of rectangular lamps in a direction, blurred by a Gaussian.

uniform float blur; // standard deviation, of a tangent
uniform vec3 zenith;
uniform vec3 horizon;
uniform vec3 ground;
uniform vec3 lampTowards[5];
uniform vec3 lampHalfSize[5];
uniform vec3 lampRadiance[5];
varying vec3 direction;

// A step, blurred: the normal distribution to 2 % (the logistic of the same slope).
vec2 blurredStep(const in vec2 x) {
	return 1.0 / (1.0 + exp(clamp(-1.702 * x / blur, -60.0, 60.0)));
}

// Share of a lamp that is seen, in the plane that its middle is the normal of.
float lampSeen(const in vec3 d, const in vec3 towards, const in vec2 halfSize) {
	float forwards = dot(d, towards);
	vec3 across = normalize(cross(vec3(0.0, 1.0, 1e-3), towards));
	vec2 place = vec2(dot(d, across), dot(d, cross(towards, across))) / max(forwards, 0.05);
	vec2 seen = blurredStep(place + halfSize) - blurredStep(place - halfSize);
	return seen.x * seen.y * smoothstep(0.0, 0.2, forwards);
}

void main() {
	vec3 d = normalize(direction);
	float height = d.y / (1.0 + blur);
	vec3 sky = mix(horizon, zenith, smoothstep(0.0, 0.85, height));
	vec3 radiance = mix(ground, sky, blurredStep(vec2(d.y / 2.5)).x); // a horizon is never a knife's edge
	for (int lamp = 0; lamp < 5; ++lamp) {
		radiance += lampRadiance[lamp] * lampSeen(d, lampTowards[lamp], lampHalfSize[lamp].xy);
	}
	gl_FragColor = vec4(radiance, 1.0);
}
