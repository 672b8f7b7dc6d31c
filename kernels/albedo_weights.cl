// How much of the light a rough surface takes at which angle to its facets, over (roughness, angle, node).
//
// The directional albedo is E = integral of f cos_o d omega_o = integral of w(u) F(u) du, u = i.h, and F, the film's R
// or T, depends on nothing else: so the geometry w is integrated once for all wavelengths, onto the nodes that F is
// known at, and the albedo is a product of matrices. In facets instead of directions o (Walter et al. 2007):
//     E = integral of D(h) cos(h) . G F (i.h) / (cos_i cos(h)) dh
// whose first factor the quadrature samples, so that the second is of the order 1 at any roughness.
//
// TRANSMISSION 1: light that the facets refract, by the ratio `eta` = eta_i / eta_o; 0: reflected light. One work-item:
// one row, roughness * angles + angle; work size (rows of this launch). `facets` are laid out as in microfacet_area.cl;
// for Phong they are directions o about the mirror direction. Sums of more than some 8,000 facets want REAL 64.
#include "microfacet.clh"
#include "nodes.clh"

#define FACET_ROWS 4
#define REAL4 JOIN(REAL_TYPE, 4)

// A facet of the quadrature, the direction that it sends i into, and |o.h|; weight 0 where that does not exist.
typedef struct {
    direction h, o;
    lane incident, exitant, weight;
} facet_path;

INLINE lane when(lane value, lane positive) {
    return positive > 0 ? value : (lane)(0);
}

#if DISTRIBUTION == PHONG
// (x, y, z) is about the mirror direction r = (-i.x, -i.y, i.z), i in the plane of x and z.
INLINE facet_path path_of(direction i, direction l, lane weight, real eta) {
    facet_path path;
    direction o = {l.x * i.z - l.z * i.x, l.y, l.z * i.z + l.x * i.x};
    direction sum = {i.x + o.x, i.y + o.y, i.z + o.z};
    lane inv_length = 1 / root_of(dot_of(sum, sum));
    direction h = {sum.x * inv_length, sum.y * inv_length, sum.z * inv_length};
    path.h = h, path.o = o;
    path.incident = path.exitant = (real)0.5f / inv_length;
    path.weight = when(weight * h.z * h.z, o.z); // the lobe's D cos is 4 L (i.h) (n.h)^2 dh
    return path;
}
#elif TRANSMISSION
INLINE facet_path path_of(direction i, direction h, lane weight, real eta) {
    facet_path path;
    lane incident = dot_of(i, h), cos2 = 1 - eta * eta * (1 - incident * incident);
    lane exitant = root_of(cos2), along = eta * incident - exitant;
    direction o = {along * h.x - eta * i.x, along * h.y - eta * i.y, along * h.z - eta * i.z};
    path.h = h, path.o = o, path.incident = incident, path.exitant = exitant;
    path.weight = when(when(when(weight, incident), cos2), -o.z);
    return path;
}
#else
INLINE facet_path path_of(direction i, direction h, lane weight, real eta) {
    facet_path path;
    lane incident = dot_of(i, h), twice = 2 * incident;
    direction o = {twice * h.x - i.x, twice * h.y - i.y, twice * h.z - i.z};
    path.h = h, path.o = o;
    path.incident = path.exitant = incident;
    path.weight = when(when(weight, incident), o.z);
    return path;
}
#endif

// The share of the light that takes a path, if the facet sends all of it that way.
INLINE lane path_share(microsurface m, direction i, facet_path path) {
    lane seen = visibility(m, i, path.o, path.incident, path.exitant, path.h.z);
    return when(path.weight * seen * path.incident * lane_abs(path.o.z) / path.h.z, path.weight);
}

// Add each lane's share to the four nodes about its cosine at the facet.
INLINE void add_to_nodes(lane share, lane cosine, global real *row, int nodes) {
    node_weights n = node_weights_at(lane_min(lane_max(cosine, (lane)(0)), (lane)(1)), nodes);
    real shares[4][LANES];
    for (int j = 0; j < 4; ++j) ((lane *)shares[j])[0] = share * n.weights[j];
    for (int k = 0; k < LANES; ++k) {
        REAL4 four = (REAL4)(shares[0][k], shares[1][k], shares[2][k], shares[3][k]);
        vstore4(vload4(0, row + n.first[k]) + four, 0, row + n.first[k]);
    }
}

kernel void albedo_weights(global const real *alphas,    // (roughnesses, 2)
                           global const real *areas,     // (roughnesses, AREA_COSINES, AREA_AZIMUTHS)
                           global const real *facets,    // (roughnesses, FACET_ROWS, facet_stride)
                           int facet_stride,
                           global const real *cos_theta, // (angles)
                           int angles,
                           real cos_phi, real sin_phi,   // of the incident light
                           real eta, int nodes, int row_origin, int row_stop,
                           global real *weights) {       // (row_stop - row_origin, nodes)
    int row = row_origin + (int)get_global_id(0);
    if (row >= row_stop) return;

    int roughness = row / angles;
    microsurface m = {alphas[2 * roughness], alphas[2 * roughness + 1],
                      areas + roughness * AREA_COSINES * AREA_AZIMUTHS};
    real mu = cos_theta[row % angles], sine = sqrt((1 - mu) * (1 + mu));
    direction i = direction_of(sine * cos_phi, sine * sin_phi, mu);
    facets += roughness * FACET_ROWS * facet_stride;
    weights += (row - row_origin) * nodes;
    for (int k = 0; k < nodes; ++k) weights[k] = 0;
    for (int block = 0; block < facet_stride / LANES; ++block) {
        direction h = {lane_load(facets, block), lane_load(facets + facet_stride, block),
                       lane_load(facets + 2 * facet_stride, block)};
        facet_path path = path_of(i, h, lane_load(facets + 3 * facet_stride, block), eta);
        add_to_nodes(path_share(m, i, path), path.incident, weights, nodes);
    }
}
