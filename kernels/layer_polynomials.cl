// The coefficients of polynomial_layer.clh, for every layer at every thickness and every block of wavelengths.
//
// One work-item: one block of one layer; work size (blocks, thicknesses of layers). Values at the nodes become
// coefficients of Chebyshev polynomials, and those coefficients of powers: at once, by the inverse of a Vandermonde
// matrix, rounding would be a hundred times as large.
#include "polynomial_layer.clh"

// cos and sin of 2 pi `turns`, with their signs.
INLINE phase whole_turn_phase(lane turns) {
    phase p = half_turn_phase(turns);
    lane halves = lane_round_to_half(turns);
    lane sign = 1 - 4 * lane_abs(halves - lane_round(halves));
    phase q = {sign * p.cos, sign * p.sin};
    return q;
}

INLINE lane log2_decay(lane d_over_lambda, complex kz) {
    return (real)0.5f * HALVINGS_PER_TURN * d_over_lambda * kz.im;
}

// Values at the nodes on their way to coefficients of powers of t.
typedef struct {
    constant real *to_chebyshev; // (TERMS, TERMS): order, node
    constant real *to_powers;    // (TERMS, TERMS): power, order
} interpolation;

INLINE void add_value(lane sums[TERMS], interpolation by, int node, lane value) {
#pragma unroll
    for (int order = 0; order < TERMS; ++order) sums[order] += by.to_chebyshev[order * TERMS + node] * value;
}

INLINE void store_powers(const lane sums[TERMS], interpolation by, global real *runs, int first) {
#pragma unroll
    for (int power = 0; power < TERMS; ++power) {
        lane coefficient = (lane)(0);
#pragma unroll
        for (int order = power; order < TERMS; order += 2)
            coefficient += by.to_powers[power * TERMS + order] * sums[order];
        lane_store(coefficient, runs, first + power);
    }
}

// Of a layer at one block of wavelengths.
typedef struct {
    medium m;
    lane n0_squared, d_over_lambda;
    constant real *node_mu2; // (TERMS)
} sampled_layer;

INLINE lane kz2_at(sampled_layer layer, int node) {
    return layer.m.contrast + layer.n0_squared * layer.node_mu2[node];
}

// A layer that is clear at every angle: C and S / kz are real, and nothing decays.
INLINE void store_clear_layer(sampled_layer layer, interpolation by, global real *runs) {
    lane C[TERMS], S_over_kz[TERMS];
    for (int order = 0; order < TERMS; ++order) C[order] = S_over_kz[order] = (lane)(0);
    for (int node = 0; node < TERMS; ++node) {
        square_root kz = square_root_of(kz2_at(layer, node));
        phase ph = whole_turn_phase(layer.d_over_lambda * kz.root);
        add_value(C, by, node, ph.cos);
        add_value(S_over_kz, by, node, ph.sin * kz.reciprocal);
    }
    store_powers(C, by, runs, C_RE);
    store_powers(S_over_kz, by, runs, S_RE);
}

INLINE void store_decaying_layer(sampled_layer layer, interpolation by, global real *runs) {
    lane C_re[TERMS], C_im[TERMS], S_re[TERMS], S_im[TERMS];
    for (int order = 0; order < TERMS; ++order) C_re[order] = C_im[order] = S_re[order] = S_im[order] = (lane)(0);
    lane most = log2_decay(layer.d_over_lambda, decaying_wave(layer.m, layer.m.contrast).b.s);
    for (int node = 0; node < TERMS; ++node) {
        wave w = decaying_wave(layer.m, kz2_at(layer, node));
        phase ph = whole_turn_phase(layer.d_over_lambda * w.b.s.re);
        lane log2_size = log2_decay(layer.d_over_lambda, w.b.s);
        decay d = scaled_decay(2 * log2_size);
        lane scale = power_of_half(most - log2_size);
        complex S = complex_mul(complex_of(ph.sin * d.ch, ph.cos * d.sh), w.inv_b.s);
        add_value(C_re, by, node, scale * (ph.cos * d.ch));
        add_value(C_im, by, node, -scale * (ph.sin * d.sh));
        add_value(S_re, by, node, scale * S.re);
        add_value(S_im, by, node, scale * S.im);
    }
    store_powers(C_re, by, runs, C_RE);
    store_powers(C_im, by, runs, C_IM);
    store_powers(S_re, by, runs, S_RE);
    store_powers(S_im, by, runs, S_IM);
    lane_store(most, runs, DECAY);
}

kernel void layer_polynomials(global const real *media,        // (media_count, MEDIUM_ROWS, stride)
                              global const real *critical_mu2, // (media_count, stride / LANES)
                              constant int *medium_of,         // (M + 1)
                              global const real *incident,     // (3, stride): n0, 1 / n0, 1 / wavelength in 1 / nm
                              global const real *thickness_nm, // (thicknesses of all layers)
                              int layer_count, int stride, int thicknesses,
                              constant real *nodes,            // (TERMS): mu^2; then what `interpolation` has
                              global real *polynomials) {      // (thicknesses, blocks, POLYNOMIAL_RUNS, LANES)
    int block = get_global_id(0), number = get_global_id(1), blocks = stride / LANES;
    if (block >= blocks || number >= thicknesses) return;

    int medium = medium_of[number % layer_count];
    lane n0 = lane_load(incident, block);
    sampled_layer layer = {medium_load(media, medium, block, stride), n0 * n0,
                           thickness_nm[number] * lane_load(incident + 2 * stride, block), nodes};
    interpolation by = {nodes + TERMS, nodes + TERMS + TERMS * TERMS};
    global real *runs = polynomials + (number * blocks + block) * POLYNOMIAL_RUNS * LANES;
    if (critical_mu2[medium * blocks + block] < CLEAR_MU2)
        store_clear_layer(layer, by, runs);
    else
        store_decaying_layer(layer, by, runs);
}
