/* shear.c - the angle of the shear band: A00 5.3.3.1, Fig. 5.18.
 *
 * The source laid it by eye along the interface between fast and slow particles. Here: mean speeds
 * of square cells above the bottom; in every row, on either side of the centre line, the place
 * where the speed falls below a share of the fastest cell; a straight line through these places,
 * both sides together, as |x| over z. 90 degrees is vertical, below 90 the flowing zone widens
 * upwards, above it narrows. Rows in which all or nothing is fast have no interface. */
#include <math.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

enum { COLUMNS = 40, ROWS = 120, LEAST_POINTS = 6 };
static const double DEGREE = 57.29577951308232;
static const double UP_TO = 0.6; /* of the width: "the lower portion of the hopper" */

typedef struct field {
    double speed[ROWS][COLUMNS], fastest; /* NAN: an empty cell */
    double cell;                          /* m */
    int rows;
} field;

static field field_of(const frame *f, const aspect_case *c) {
    double count[ROWS][COLUMNS] = {{0}};
    field g = {.cell = 2 * c->half_width / COLUMNS, .rows = (int)(UP_TO * COLUMNS)};
    for (size_t i = 0; i < f->bodies; i++) {
        const double *p = &f->position[3 * i], *v = &f->velocity[3 * i];
        double k = floor((p[0] + c->half_width) / g.cell), row = floor(p[2] / g.cell);
        if (!(row >= 0 && row < g.rows && k >= 0 && k < COLUMNS)) continue;
        g.speed[(int)row][(int)k] += sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        count[(int)row][(int)k] += 1;
    }
    for (int row = 0; row < g.rows; row++)
        for (int k = 0; k < COLUMNS; k++) {
            g.speed[row][k] /= count[row][k];
            if (g.speed[row][k] > g.fastest) g.fastest = g.speed[row][k];
        }
    return g;
}

/* |x| at which the speed first falls below the limit, going out from the centre; NAN without. */
static double interface_at(const field *g, int row, int side, double limit) {
    double before = NAN;
    for (int i = 0; i < COLUMNS / 2; i++) {
        int k = side > 0 ? COLUMNS / 2 + i : COLUMNS / 2 - 1 - i;
        double now = g->speed[row][k];
        if (now < limit)
            return isnan(before) ? NAN : (i - 0.5 + (before - limit) / (before - now)) * g->cell;
        if (!isnan(now)) before = now;
    }
    return NAN;
}

double shear_angle(const frame *f, const aspect_case *c, double band) {
    CLAST_ASSERT(f && c && band > 0 && band < 1);
    static field g;
    double z[2 * ROWS], x[2 * ROWS];
    int n = 0;
    g = field_of(f, c);
    for (int row = 0; row < g.rows; row++)
        for (int side = -1; side <= 1; side += 2) {
            double at = interface_at(&g, row, side, band * g.fastest);
            if (isnan(at)) continue;
            z[n] = (row + 0.5) * g.cell, x[n++] = at;
        }
    if (n < LEAST_POINTS) return NAN;
    return 90 - DEGREE * atan(line_fit(z, x, n).slope);
}
