// Linear colour of the specular part of f_r or f_t, over pairs of directions, in 1 / sr; no spectrum stored.
//
// Colour weights are those of film_colour.cl. One work-item: one row; work size (rows of this launch).
#include "bsdf.clh"

kernel void bsdf_colour(BSDF_ARGUMENTS,
                        global const real *colour_weights, // (3, stride)
                        global real *colour) {             // (row_stop - row_origin, 3)
    int row = row_origin + (int)get_global_id(0);
    if (row >= row_stop) return;

    bsdf_row pair = bsdf_row_of(alphas, areas, roughness, incoming, outgoing, row);
    facet_event event = row_event(pair);
    lane red = (lane)(0), green = (lane)(0), blue = (lane)(0);
    for (int block = 0; block < stride / LANES; ++block) {
        lane value = bsdf_at(pair, event, film, eta, nodes, stride, block);
        red += value * lane_load(colour_weights, block);
        green += value * lane_load(colour_weights + stride, block);
        blue += value * lane_load(colour_weights + 2 * stride, block);
    }
    colour += 3 * (row - row_origin);
    colour[0] = lane_sum(red);
    colour[1] = lane_sum(green);
    colour[2] = lane_sum(blue);
}
