// What the machine can do at best: fused multiply-adds, and a copy.

// Eight independent chains of LANES numbers hide the latency of the multiply-add; 8 * LANES * 2 flop a turn. The host
// passes LANES, a register's worth: wider chains would be spilled. Written as x * a + b, which the compiler
// contracts: PoCL's fma() is a call, ten times slower.
#define JOIN_NOW(a, b) a##b
#define JOIN(a, b) JOIN_NOW(a, b)
#if LANES == 1
typedef float lane;
#else
typedef JOIN(float, LANES) lane;
#endif

kernel void multiply_add(global float *out, const int turns)
{
    const lane a = (lane)(0.999f), b = (lane)(0.001f * get_global_id(0));
    lane x0 = b, x1 = b + 1, x2 = b + 2, x3 = b + 3, x4 = b + 4, x5 = b + 5, x6 = b + 6, x7 = b + 7;
    for (int i = 0; i < turns; ++i) {
        x0 = x0 * a + b; x1 = x1 * a + b; x2 = x2 * a + b; x3 = x3 * a + b;
        x4 = x4 * a + b; x5 = x5 * a + b; x6 = x6 * a + b; x7 = x7 * a + b;
    }
    float sums[LANES];
    ((lane *)sums)[0] = x0 + x1 + x2 + x3 + x4 + x5 + x6 + x7;
    for (int i = 1; i < LANES; ++i) sums[0] += sums[i];
    out[get_global_id(0)] = sums[0];  // so that nothing is dropped
}

kernel void copy(global const float16 *source, global float16 *target)
{
    target[get_global_id(0)] = source[get_global_id(0)];
}
