// Points of the unit square, moved so that they lie as densely as a given density says.
//
// A density is known on a grid and bilinear between its samples. The row, y, follows the marginal density and the
// column, x, the density along that row; both are linear within a cell, so that their sums are inverted in closed
// form. This is the continuous marginal warp of Dupuy & Jakob 2018, section 4.2, as readers of their files do it.
//
// One work-item: one point of one slice, slice * points + point; work size (rows of this launch).
#include "lanes.clh"

// The place in [0, 1] of a cell up to which a density, linear from a to b, has the integral `area`.
inline real place_in_cell(real area, real a, real b) {
    real root = sqrt(fmax(a * a + 2 * area * (b - a), (real)0));
    return clamp(2 * area / fmax(a + root, (real)1e-30f), (real)0, (real)1);
}

// The last cell of `cells` that begins below `value`; cell c begins at sums(c), a blend of two rows.
inline int cell_of(global const real *lower, global const real *upper, real blend, int cells, real value) {
    int first = 0, last = cells - 1;
    while (first < last) {
        int middle = (first + last + 1) / 2;
        if (lower[middle] + blend * (upper[middle] - lower[middle]) < value)
            first = middle;
        else
            last = middle - 1;
    }
    return first;
}

inline real mixed(real a, real b, real share) {
    return a + share * (b - a);
}

kernel void warp(global const real *density,     // (slices, rows, columns)
                 global const real *conditional, // (slices, rows, columns): sums along each row, from 0
                 global const real *marginal,    // (slices, rows): sums of whole rows, from 0 to 1
                 int rows, int columns,
                 global const real *samples, // (points, 2): x, y
                 int points, int row_origin, int row_stop,
                 global real *x, global real *y) { // (row_stop - row_origin)
    int item = row_origin + (int)get_global_id(0);
    if (item >= row_stop) return;

    int slice = item / points, point = item % points;
    density += (long)slice * rows * columns;
    conditional += (long)slice * rows * columns;
    marginal += slice * rows;

    real wanted = samples[2 * point + 1];
    int row = cell_of(marginal, marginal, 0, rows - 1, wanted);
    global const real *sums = conditional + row * columns, *next_sums = sums + columns;
    real whole = sums[columns - 1], next_whole = next_sums[columns - 1];
    real down = place_in_cell((wanted - marginal[row]) * (rows - 1), whole, next_whole);

    wanted = samples[2 * point] * mixed(whole, next_whole, down);
    int column = cell_of(sums, next_sums, down, columns - 1, wanted);
    real before = mixed(sums[column], next_sums[column], down);
    global const real *cell = density + row * columns + column;
    real left = mixed(cell[0], cell[columns], down), right = mixed(cell[1], cell[columns + 1], down);
    real across = place_in_cell((wanted - before) * (columns - 1), left, right);

    x[item - row_origin] = (column + across) / (columns - 1);
    y[item - row_origin] = (row + down) / (rows - 1);
}
