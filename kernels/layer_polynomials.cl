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

kernel void layer_polynomials(global const real *media,        // (media_count, MEDIUM_ROWS, stride)
                              constant int *medium_of,         // (M + 1)
                              global const real *incident,     // (3, stride): n0, 1 / n0, 1 / wavelength in 1 / nm
                              global const real *thickness_nm, // (thicknesses of all layers)
                              int layer_count, int stride, int thicknesses,
                              constant real *node_mu2,         // (TERMS)
                              constant real *to_chebyshev,     // (TERMS, TERMS): order, node
                              constant real *to_powers,        // (TERMS, TERMS): power, order
                              global real *polynomials) {      // (thicknesses, blocks, POLYNOMIAL_RUNS, LANES)
    int block = get_global_id(0), number = get_global_id(1), blocks = stride / LANES;
    if (block >= blocks || number >= thicknesses) return;

    medium m = medium_load(media, medium_of[number % layer_count], block, stride);
    lane n0 = lane_load(incident, block), n0_squared = n0 * n0;
    lane d_over_lambda = thickness_nm[number] * lane_load(incident + 2 * stride, block);
    lane most = log2_decay(d_over_lambda, decaying_wave(m, m.contrast).b.s);
    lane sums[DECAY];
    for (int run = 0; run < DECAY; ++run) sums[run] = (lane)(0);
    for (int node = 0; node < TERMS; ++node) {
        wave w = decaying_wave(m, m.contrast + n0_squared * node_mu2[node]);
        phase ph = whole_turn_phase(d_over_lambda * w.b.s.re);
        lane log2_size = log2_decay(d_over_lambda, w.b.s);
        decay d = scaled_decay(2 * log2_size);
        lane scale = power_of_half(most - log2_size);
        complex C = complex_scale(scale, complex_of(ph.cos * d.ch, -ph.sin * d.sh));
        complex S_over_kz = complex_mul(complex_scale(scale, complex_of(ph.sin * d.ch, ph.cos * d.sh)), w.inv_b.s);
        for (int order = 0; order < TERMS; ++order) {
            real part = to_chebyshev[order * TERMS + node];
            sums[C_RE + order] += part * C.re;
            sums[S_RE + order] += part * S_over_kz.re;
            sums[C_IM + order] += part * C.im;
            sums[S_IM + order] += part * S_over_kz.im;
        }
    }
    polynomials += (number * blocks + block) * POLYNOMIAL_RUNS * LANES;
    for (int first = 0; first < DECAY; first += TERMS)
        for (int power = 0; power < TERMS; ++power) {
            lane coefficient = (lane)(0);
            for (int order = power; order < TERMS; order += 2)
                coefficient += to_powers[power * TERMS + order] * sums[first + order];
            lane_store(coefficient, polynomials, first + power);
        }
    lane_store(most, polynomials, DECAY);
}
