// Linear colours of a film's unpolarised reflection and transmission, over (thickness scale, angle).
//
// The spectrum is integrated as it is computed and never stored. The host folds illuminant, observer,
// quadrature and the matrix to the colour space into three weights a wavelength (padding has weight 0), so that
// a colour is a sum. It passes SIDES 2 for the colours of R and of T, 1 for that of R alone. One work-item: one
// row, see FILM_ARGUMENTS; work size (rows of this launch).
#include "intensities.clh"

// Add what one block of wavelengths gives to a colour (3), for unpolarised light: (s + p) / 2.
INLINE void add_block(lane *colour, lane s, lane p, global const real *colour_weights, int stride, int block) {
    lane value = (real)0.5f * (s + p);
    colour[0] += value * lane_load(colour_weights, block);
    colour[1] += value * lane_load(colour_weights + stride, block);
    colour[2] += value * lane_load(colour_weights + 2 * stride, block);
}

kernel void film_colour(FILM_ARGUMENTS,
                        global const real *colour_weights, // (3, stride)
                        global real *colours) {            // (row_stop - row_origin, SIDES, 3)
    int tile_row = get_global_id(0);
    int row = row_origin + tile_row, scale = row / angles, angle = row % angles;
    if (row >= row_stop) return;

    film_stack first = FILM_STACK, stack = later_variant(first, scale * variants);
    wave waves[MEDIA];
    lane sums[3 * SIDES];
    for (int c = 0; c < 3 * SIDES; ++c) sums[c] = (lane)(0);
    for (int block = 0; block < stride / LANES; ++block) {
        incidence in = incidence_at(stack, incident, block, angle, waves);
        intensities I = mean_intensities(stack, weights, variants, in);
        add_block(sums, I.R_s, I.R_p, colour_weights, stride, block);
#if SIDES == 2
        add_block(sums + 3, I.T_s, I.T_p, colour_weights, stride, block);
#endif
    }
    for (int c = 0; c < 3 * SIDES; ++c) colours[3 * SIDES * tile_row + c] = lane_sum(sums[c]);
}
