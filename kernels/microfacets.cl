// D and the projected area of a rough surface's facets, over (roughness, direction).
//
// One work-item: one row of LANES directions, roughness * blocks + block; work size (rows of this launch).
#include "microfacet.clh"

kernel void microfacets(global const real *alphas,     // (roughnesses, 2)
                        global const real *areas,      // (roughnesses, AREA_COSINES, AREA_AZIMUTHS)
                        global const real *directions, // (3, stride)
                        int stride, int row_origin, int row_stop,
                        global real *density, global real *area) { // (row_stop - row_origin, LANES)
    int row = row_origin + (int)get_global_id(0);
    if (row >= row_stop) return;

    int blocks = stride / LANES, roughness = row / blocks, block = row % blocks;
    microsurface m = {alphas[2 * roughness], alphas[2 * roughness + 1],
                      areas + roughness * AREA_COSINES * AREA_AZIMUTHS};
    direction v = {lane_load(directions, block), lane_load(directions + stride, block),
                   lane_load(directions + 2 * stride, block)};
    lane_store(facet_density(m, v), density, row - row_origin);
    lane_store(projected_area(m, v), area, row - row_origin);
}
