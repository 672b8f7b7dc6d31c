// The coefficients of polynomial_stack.clh, for every thickness of a stack and every block of wavelengths.
//
// Angles are the Chebyshev nodes of mu^2, where waves cross the layers as in film.cl; the host passes POLYNOMIALS 0 and
// the DEGREE. One work-item: one block of one thickness; work size (blocks, thicknesses).
#include "film.clh"

// half_turn_phase leaves the sign of a layer's matrix open; polynomials need that of the whole stack at each node.
INLINE lane sign_of_stack(film_stack stack, incidence in) {
    lane halves = (lane)(0);
    for (int j = 0; j < stack.layer_count; ++j)
        halves += lane_round_to_half(stack.thickness_nm[j] * in.inv_wavelength * admittance_of(stack, j, in).s.re);
    return 1 - 4 * lane_abs(halves - lane_round(halves));
}

// log2 of e^D at grazing incidence, where it is largest.
INLINE lane largest_decay(film_stack stack, incidence in) {
    lane turns = (lane)(0);
    for (int j = 0; j < stack.layer_count; ++j) {
        medium m = medium_load(stack.media, stack.medium_of[j], in.block, stack.stride);
        turns += stack.thickness_nm[j] * in.inv_wavelength * decaying_wave(m, m.contrast).b.s.im;
    }
    return (real)0.5f * HALVINGS_PER_TURN * turns;
}

// Without loss in the layers at any angle, and with a real n of the substrate.
INLINE int is_lossless_stack(film_stack stack, int block) {
    global const real *critical_mu2 = stack.critical_mu2 + block;
    int blocks = stack.stride / LANES, lossless = critical_mu2[stack.medium_of[stack.layer_count] * blocks] < 2;
    for (int j = 0; j < stack.layer_count; ++j) lossless &= critical_mu2[stack.medium_of[j] * blocks] < CLEAR_MU2;
    return lossless;
}

INLINE void add_parts(lane *sums, constant real *to_chebyshev, int node, field first, field second) {
    lane parts[PARTS];
    parts[E0_RE] = first.E.re, parts[E0_IM] = first.E.im, parts[H0_RE] = first.H.re, parts[H0_IM] = first.H.im;
    parts[E1_RE] = second.E.re, parts[E1_IM] = second.E.im, parts[H1_RE] = second.H.re, parts[H1_IM] = second.H.im;
    for (int order = 0; order < TERMS; ++order)
        for (int part = 0; part < PARTS; ++part)
            sums[order * PARTS + part] += to_chebyshev[order * TERMS + node] * parts[part];
}

// Squares of the largest fields.
typedef struct {
    lane E, H;
} peak;

INLINE peak higher_peak(peak so_far, field f) {
    peak p = {lane_max(so_far.E, complex_norm(f.E)), lane_max(so_far.H, complex_norm(f.H))};
    return p;
}

// Polynomials have the digits of the largest field, R and T go by the incident b E + H, which may be smaller.
INLINE lane squared_spread(peak largest, field f, lane b) {
    return (b * b * largest.E + largest.H) / complex_norm(split_field(f, b).incident);
}

// By how much the error of R and T is more than that of a digit, squared, for s and p: a maximum of both could lose what
// is no number in one. Looked at between the nodes, too, where a resonance would be: at the angles after them.
typedef struct {
    lane s, p;
} spreads;

INLINE spreads spreads_of(film_stack stack, global const real *incident, global const real *runs, int block, int angles) {
    peak s = {(lane)(0), (lane)(0)}, p = s;
    spreads spread = {(lane)(0), (lane)(0)};
    for (int angle = TERMS; angle < angles; ++angle) {
        incidence in = incidence_without_waves(stack, incident, block, angle);
        column f = polynomial_field(runs, in.chebyshev, in.substrate.s);
        s = higher_peak(s, f.s), p = higher_peak(p, f.p);
    }
    for (int angle = TERMS; angle < angles; ++angle) {
        incidence in = incidence_without_waves(stack, incident, block, angle);
        column f = polynomial_field(runs, in.chebyshev, in.substrate.s);
        spread.s = lane_max(spread.s, squared_spread(s, f.s, in.b_s));
        spread.p = lane_max(spread.p, squared_spread(p, f.p, in.b_p));
    }
    return spread;
}

// The columns of the stack's matrix at a node, with their sign and e^-D; the second for kz of the substrate.
INLINE void node_columns(column columns[2], film_stack stack, incidence in, lane most) {
    magnitude size = no_magnitude();
    segment all = {0, stack.layer_count, 1};
    unit_columns(columns);
    cross_layers(columns, 2, &size, stack, all, in);
    lane scale = sign_of_stack(stack, in) * power_of_half(most - size.decay);
    complex inv_n2 = medium_load(stack.media, stack.medium_of[stack.layer_count], in.block, stack.stride).inv_n2;
    for (int i = 0; i < 2; ++i) {
        columns[i].s = field_scale(scale, columns[i].s);
        columns[i].p = field_scale(scale, columns[i].p);
    }
    columns[1].p.E = complex_mul(columns[1].p.E, inv_n2);
    columns[1].p.H = complex_mul(columns[1].p.H, inv_n2);
}

kernel void stack_polynomials(FILM_ARGUMENTS, // cos_theta: the nodes, TERMS, and after them the probes
                              constant real *to_chebyshev, // (TERMS, TERMS): order, node
                              global real *filled,         // (thicknesses, blocks, STACK_RUNS, LANES)
                              global real *spread) {       // (thicknesses, 2, stride): s, p
    int block = get_global_id(0), number = get_global_id(1), blocks = stride / LANES;
    if (block >= blocks || number >= row_stop) return;

    film_stack first = FILM_STACK, stack = first;
    stack.thickness_nm += number * layer_count;
    stack.rescale_after = layer_count + 1; // one scale for all angles; what leaves the range is no number, nor its spread
    wave waves[MEDIA];
    lane sums[2][TERMS * PARTS], most = (lane)(0);
    for (int i = 0; i < TERMS * PARTS; ++i) sums[0][i] = sums[1][i] = (lane)(0);
    for (int node = 0; node < TERMS; ++node) {
        incidence in = incidence_at(stack, incident, block, node, waves);
        if (node == 0) most = largest_decay(stack, in);
        column columns[2];
        node_columns(columns, stack, in, most);
        add_parts(sums[0], to_chebyshev, node, columns[0].s, columns[1].s);
        add_parts(sums[1], to_chebyshev, node, columns[0].p, columns[1].p);
    }
    global real *runs = filled + (number * blocks + block) * STACK_RUNS * LANES;
    for (int i = 0; i < TERMS * PARTS; ++i) {
        lane_store(sums[0][i], runs, i);
        lane_store(sums[1][i], runs, POLARISATION_RUNS + i);
    }
    lane_store(most, runs, STACK_DECAY);
    lane_store((lane)(is_lossless_stack(stack, block)), runs, STACK_LOSSLESS);
    spreads found = spreads_of(stack, incident, runs, block, angles);
    lane_store(found.s, spread, 2 * number * blocks + block);
    lane_store(found.p, spread, (2 * number + 1) * blocks + block);
}
