// R and T of a film over (thickness scale, angle, wavelength), for s and p.
//
// One work-item: one block of LANES wavelengths of one row (see FILM_ARGUMENTS); work size (blocks, rows of this
// launch). A scale has one or more thickness variants with weights, the nodes of a thickness distribution,
// averaged in intensity.
#include "intensities.clh"

kernel void film(FILM_ARGUMENTS,
                 global real *R_s, global real *R_p, // (row_stop - row_origin, stride)
                 global real *T_s, global real *T_p) {
    int block = get_global_id(0), tile_row = get_global_id(1);
    int row = row_origin + tile_row, scale = row / angles, angle = row % angles;
    if (row >= row_stop || block * LANES >= stride) return;

    film_stack first = FILM_STACK, stack = later_variant(first, scale * variants);
    wave waves[MEDIA];
    incidence in = incidence_at(stack, incident, block, angle, waves);
    intensities mean = mean_intensities(stack, weights, variants, in);

    int out = tile_row * (stride / LANES) + block;
    lane_store(mean.R_s, R_s, out);
    lane_store(mean.R_p, R_p, out);
    lane_store(mean.T_s, T_s, out);
    lane_store(mean.T_p, T_p, out);
}
