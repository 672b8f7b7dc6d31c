// R and T of a film over (thickness scale, angle, wavelength), for s and p.
//
// A row is one scale and one angle, row = scale * angles + angle. One work-item: one block of LANES wavelengths
// of one row; work size (blocks, rows of this launch), so that a large table is computed in tiles, each in
// buffers of its own. A scale has one or more thickness variants with weights, the nodes of a thickness
// distribution, averaged in intensity.
#include "intensities.clh"

kernel void film(global const real *media,        // (M + 1, MEDIUM_ROWS, stride)
                 global const real *critical_mu2, // (M + 1, stride / LANES)
                 constant int *segments,          // (segment_count, 3)
                 int segment_count, int layer_count, int stride,
                 global const real *incident,     // (3, stride): n0, 1 / n0, 1 / wavelength in 1 / nm
                 global const real *cos_theta,    // (angles)
                 global const real *thickness_nm, // (scales, variants, M)
                 global const real *weights,      // (variants), of sum 1
                 int variants, int angles, int row_origin, int row_stop,
                 global real *R_s, global real *R_p, // (row_stop - row_origin, stride)
                 global real *T_s, global real *T_p) {
    int block = get_global_id(0), tile_row = get_global_id(1);
    int row = row_origin + tile_row, scale = row / angles, angle = row % angles;
    if (row >= row_stop || block * LANES >= stride) return;

    film_stack stack = {media, critical_mu2, segments, segment_count, layer_count, stride};
    incidence in = incidence_at(incident, stride, block, cos_theta[angle]);
    thickness_nm += scale * variants * layer_count;
    intensities mean = mean_intensities(stack, thickness_nm, weights, variants, in);

    int out = tile_row * (stride / LANES) + block;
    lane_store(mean.R_s, R_s, out);
    lane_store(mean.R_p, R_p, out);
    lane_store(mean.T_s, T_s, out);
    lane_store(mean.T_p, T_p, out);
}
