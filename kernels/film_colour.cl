// Linear colour of a film's unpolarised reflection or transmission, over (thickness scale, angle).
//
// The spectrum is integrated as it is computed and never stored. The host folds illuminant, observer,
// quadrature and the matrix to the colour space into three weights a wavelength (padding has weight 0), so that
// the colour is a sum. It passes TRANSMISSION 1 for the colour of T, 0 for that of R. One work-item: one row,
// see FILM_ARGUMENTS; work size (rows of this launch).
#include "intensities.clh"

// (s + p) / 2: the light is unpolarised.
INLINE lane unpolarised(intensities I) {
#if TRANSMISSION
    return (real)0.5f * (I.T_s + I.T_p);
#else
    return (real)0.5f * (I.R_s + I.R_p);
#endif
}

kernel void film_colour(FILM_ARGUMENTS,
                        global const real *colour_weights, // (3, stride)
                        global real *colour) {             // (row_stop - row_origin, 3)
    int tile_row = get_global_id(0);
    int row = row_origin + tile_row, scale = row / angles, angle = row % angles;
    if (row >= row_stop) return;

    film_stack stack = FILM_STACK;
    wave waves[MEDIA];
    thickness_nm += scale * variants * layer_count;
    lane red = (lane)(0), green = (lane)(0), blue = (lane)(0);
    for (int block = 0; block < stride / LANES; ++block) {
        incidence in = incidence_at(stack, incident, block, cos_theta[angle], waves);
        lane value = unpolarised(mean_intensities(stack, thickness_nm, weights, variants, in));
        red += value * lane_load(colour_weights, block);
        green += value * lane_load(colour_weights + stride, block);
        blue += value * lane_load(colour_weights + 2 * stride, block);
    }
    colour[3 * tile_row] = lane_sum(red);
    colour[3 * tile_row + 1] = lane_sum(green);
    colour[3 * tile_row + 2] = lane_sum(blue);
}
