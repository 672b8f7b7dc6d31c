// The widest vector register, in bits, that this compiler uses; 0 where it does not say.
//
// PoCL's LLVM may be older than the processor. It then compiles for the last one that it knows, which can lack
// registers that the device, asked for its preferred width, rightly claims to have: LLVM 14 takes a Zen 4 for a
// Zen 3, without AVX-512. One work-item; work size (1).
kernel void register_width(global int *bits) {
#if defined(__AVX512F__)
    bits[0] = 512;
#elif defined(__AVX__)
    bits[0] = 256;
#elif defined(__SSE2__)
    bits[0] = 128;
#else
    bits[0] = 0;
#endif
}
