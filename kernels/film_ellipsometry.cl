// psi and Delta of a coherent film, tan(psi) exp(i Delta) = -r_p / r_s, over (thickness scale, angle, wavelength).
//
// The sign follows Byrnes (tmm), with r_p the ratio of the tangential fields as in film.clh. Radians, psi in
// [0, pi / 2], Delta in (-pi, pi]. Rows, work-items and launches as in film.cl, one thickness a scale.
#include "film.clh"

kernel void film_ellipsometry(FILM_ARGUMENTS,
                              global real *psi, global real *Delta) { // (row_stop - row_origin, stride)
    int block = get_global_id(0), tile_row = get_global_id(1);
    int row = row_origin + tile_row, scale = row / angles, angle = row % angles;
    if (row >= row_stop || block * LANES >= stride) return;

    film_stack first = FILM_STACK, stack = later_variant(first, scale * variants);
    wave waves[MEDIA];
    incidence in = incidence_at(stack, incident, block, angle, waves);
    magnitude size = no_magnitude();
    column f = coherent_field(stack, in, &size);
    rescale(&f, 1, &size);
    amplitudes s = split_field(f.s, in.b_s), p = split_field(f.p, in.b_p);

    // -r_p / r_s = numerator / denominator, with r = reflected / incident
    complex numerator = complex_neg(complex_mul(p.reflected, s.incident));
    complex denominator = complex_mul(s.reflected, p.incident);
    complex ratio = complex_mul(numerator, complex_of(denominator.re, -denominator.im));
    int out = tile_row * (stride / LANES) + block;
    lane_store(atan2(sqrt(complex_norm(numerator)), sqrt(complex_norm(denominator))), psi, out);
    lane_store(atan2(ratio.im, ratio.re), Delta, out);
}
