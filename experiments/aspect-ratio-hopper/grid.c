/* grid.c - solid fractions of square cells (A00 5.3.1): as the source counted them, and by area. */
#include <math.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

/* Half of the disc of radius r between 0 and t: above the diameter, left of t. */
static double half_to(double r, double t) {
    return 0.5 * (t * sqrt(fmax(0, r * r - t * t)) + r * r * asin(t / r));
}

static double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

/* Area of a disc about the origin that lies left of x and below z. Where the circle is higher than
 * |z| the line z cuts it; elsewhere a column is whole (z > 0) or empty. */
static double corner(double r, double x, double z) {
    x = clamp(x, -r, r), z = clamp(z, -r, r);
    double cut = sqrt(r * r - z * z), from = -cut, to = clamp(x, -cut, cut);
    double area = to > from ? half_to(r, to) - half_to(r, from) + z * (to - from) : 0;
    if (z <= 0) return area;
    area += 2 * (half_to(r, fmin(x, -cut)) - half_to(r, -r));
    if (x > cut) area += 2 * (half_to(r, x) - half_to(r, cut));
    return area;
}

double disc_in_cell(double x, double z, double r, double x0, double x1, double z0, double z1) {
    CLAST_ASSERT(r > 0 && x0 <= x1 && z0 <= z1);
    return corner(r, x1 - x, z1 - z) - corner(r, x0 - x, z1 - z) - corner(r, x1 - x, z0 - z) +
           corner(r, x0 - x, z0 - z);
}

static void add_disc(cells *g, double x, double z, double r) {
    for (int row = (int)floor((z - r) / g->size); row <= (int)floor((z + r) / g->size); row++)
        for (int k = (int)floor((x - r) / g->size); k <= (int)floor((x + r) / g->size); k++) {
            if (row < 0 || row >= g->rows || k < 0 || k >= g->columns) continue;
            g->exact[row * g->columns + k] += disc_in_cell(x, z, r, k * g->size, (k + 1) * g->size,
                                                           row * g->size, (row + 1) * g->size);
        }
}

cells cells_of(const frame *f, const aspect_case *c) {
    CLAST_ASSERT(f && c);
    cells g = {.columns = 10, .size = CELL * c->half_width / 0.5};
    g.rows = CELLS_MAX / g.columns;
    for (size_t i = 0; i < f->bodies; i++) {
        double k = floor((f->position[3 * i] + c->half_width) / g.size);
        double row = floor(f->position[3 * i + 2] / g.size);
        if (row < 0 || row >= g.rows || k < 0 || k >= g.columns) continue;
        g.number[(int)row * g.columns + (int)k] += 1;
    }
    for (size_t i = 0; i < f->spheres; i++)
        add_disc(&g, f->centre[3 * i] + c->half_width, f->centre[3 * i + 2], f->radius[i]);
    double area = g.size * g.size;
    int most = 0;
    for (int i = 0; i < CELLS_MAX; i++) {
        g.counted[i] = g.number[i] * c->chain.area / area;
        g.exact[i] /= area;
        if (g.number[i] > 0) most = i / g.columns + 1;
    }
    g.rows = most;
    return g;
}

double surface_of(const frame *f, const aspect_case *c) {
    enum { COLUMNS = 100 };
    double top[COLUMNS] = {0}, sum = 0;
    for (size_t i = 0; i < f->spheres; i++) {
        double x = (f->centre[3 * i] + c->half_width) / (2 * c->half_width) * COLUMNS;
        double half = f->radius[i] / (2 * c->half_width) * COLUMNS;
        for (int k = (int)ceil(x - half - 0.5); k + 0.5 <= x + half; k++) {
            if (k < 0 || k >= COLUMNS) continue;
            double dx = (k + 0.5 - x) / half;
            double high = f->centre[3 * i + 2] + f->radius[i] * sqrt(fmax(0, 1 - dx * dx));
            if (high > top[k]) top[k] = high;
        }
    }
    for (int k = 0; k < COLUMNS; k++) sum += top[k];
    return sum / COLUMNS;
}
