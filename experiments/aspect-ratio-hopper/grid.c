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

/* Lines stand upright, LINES across the hopper, in three dimensions in either direction. */
enum { LINES = 100 };

/* Raises the surface to a sphere at x, y, z (in distances of lines, from the corner). */
static void raise_to(double *top, int rows, const double at[3], double radius) {
    for (int j = (int)ceil(at[1] - radius - 0.5); j + 0.5 <= at[1] + radius; j++)
        for (int k = (int)ceil(at[0] - radius - 0.5); k + 0.5 <= at[0] + radius; k++) {
            if (k < 0 || k >= LINES || j < 0 || j >= rows) continue;
            double dx = k + 0.5 - at[0], dy = rows > 1 ? j + 0.5 - at[1] : 0;
            double rise2 = radius * radius - dx * dx - dy * dy;
            if (rise2 >= 0) top[j * LINES + k] = fmax(top[j * LINES + k], at[2] + sqrt(rise2));
        }
}

double surface_of(const frame *f, const aspect_case *c) {
    static double top[LINES * LINES];
    int rows = c->in_space ? LINES : 1;
    double line = 2 * c->half_width / LINES, sum = 0;
    memset(top, 0, sizeof top);
    for (size_t i = 0; i < f->spheres; i++) {
        const double *p = &f->centre[3 * i];
        double y = c->in_space ? (p[1] + c->half_width) / line : 0.5;
        const double at[3] = {(p[0] + c->half_width) / line, y, p[2] / line};
        raise_to(top, rows, at, f->radius[i] / line);
    }
    for (int i = 0; i < rows * LINES; i++) sum += top[i];
    return sum / (rows * LINES) * line;
}
