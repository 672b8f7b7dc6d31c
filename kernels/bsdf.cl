// The specular part of f_r or f_t of a rough surface with a film, over (pair of directions, wavelength), in 1 / sr.
//
// One work-item: one row, that is a roughness and a pair of directions; work size (rows of this launch).
#include "bsdf.clh"

kernel void bsdf(BSDF_ARGUMENTS,
                 global real *f) { // (row_stop - row_origin, stride)
    int row = row_origin + (int)get_global_id(0);
    if (row >= row_stop) return;

    bsdf_row pair = bsdf_row_of(alphas, areas, roughness, incoming, outgoing, row);
    facet_event event = row_event(pair);
    f += (row - row_origin) * stride;
    for (int block = 0; block < stride / LANES; ++block)
        lane_store(bsdf_at(pair, event, film, eta, nodes, stride, block), f, block);
}
