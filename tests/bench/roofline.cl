// What the machine can do at best: fused multiply-adds, and a copy.

// Eight independent chains of 16 lanes hide the latency of the multiply-add; 8 * 16 * 2 flop a turn.
// Written as x * a + b, which the compiler contracts: PoCL's fma() is a call, ten times slower.
kernel void multiply_add(global float *out, const int turns)
{
    const float16 a = (float16)(0.999f), b = (float16)(0.001f * get_global_id(0));
    float16 x0 = b, x1 = b + 1, x2 = b + 2, x3 = b + 3, x4 = b + 4, x5 = b + 5, x6 = b + 6, x7 = b + 7;
    for (int i = 0; i < turns; ++i) {
        x0 = x0 * a + b; x1 = x1 * a + b; x2 = x2 * a + b; x3 = x3 * a + b;
        x4 = x4 * a + b; x5 = x5 * a + b; x6 = x6 * a + b; x7 = x7 * a + b;
    }
    const float16 sum = x0 + x1 + x2 + x3 + x4 + x5 + x6 + x7;
    out[get_global_id(0)] = dot(sum.lo.lo + sum.lo.hi, sum.hi.lo + sum.hi.hi);  // so that nothing is dropped
}

kernel void copy(global const float16 *source, global float16 *target)
{
    target[get_global_id(0)] = source[get_global_id(0)];
}
