// The projected area of a distribution's facets, where no closed form is known, by quadrature over its facets.
//
// Tabulated over (roughness, steepness) for one x share, as microfacet.clh looks it up, in units of mu + alpha s. One
// work-item: one entry; work size (entries of this launch). `facets` holds x, y, z and weight of each facet of a
// quadrature of D cos, so that a sum of weight / z times a function is its integral over D.
#include "lanes.clh"

#define FACET_ROWS 4

kernel void microfacet_area(global const real *alphas, // (roughnesses, 2)
                            global const real *facets, // (roughnesses, FACET_ROWS, stride)
                            int stride, real x_share, int row_origin, int row_stop,
                            global real *areas) {      // (row_stop - row_origin)
    int row = row_origin + (int)get_global_id(0);
    if (row >= row_stop) return;

    int roughness = row / AREA_COSINES;
    real steepness = (real)(row % AREA_COSINES) / (AREA_COSINES - 1);
    // The direction, of a length that makes mu + alpha s = 1.
    real x = (1 - steepness) * sqrt(x_share) / alphas[2 * roughness];
    real y = (1 - steepness) * sqrt(1 - x_share) / alphas[2 * roughness + 1];

    facets += roughness * FACET_ROWS * stride;
    lane sum = (lane)(0);
    for (int block = 0; block < stride / LANES; ++block) {
        lane hx = lane_load(facets, block), hy = lane_load(facets + stride, block);
        lane hz = lane_load(facets + 2 * stride, block), weight = lane_load(facets + 3 * stride, block);
        sum += weight * lane_max(x * hx + y * hy + steepness * hz, (lane)(0)) / hz;
    }
    areas[row - row_origin] = lane_sum(sum);
}
