/* union.c - mass properties of overlapping spheres: which of them count, and those in one row. */
#include "shapes/union.h"

#include <stdlib.h>
#include <string.h>

#include "shapes/check.h"
#include "shapes/numbers.h"

double shape_spheres_reach(const shape_sphere *spheres, int count, shape_vec from) {
    double reach = 0;
    for (int i = 0; i < count; i++)
        reach = fmax(reach, sv_distance(spheres[i].centre, from) + spheres[i].radius);
    return reach;
}

double shape_spheres_area(const shape_sphere *spheres, int count, double more) {
    double area = 0;
    for (int i = 0; i < count; i++) {
        double r = spheres[i].radius + more;
        area += 4 * SHAPE_PI * r * r;
    }
    return area;
}

/* Inside another; of two alike the first stays. */
static bool is_hidden(const shape_sphere *spheres, int count, int i) {
    for (int j = 0; j < count; j++) {
        if (j == i) continue;
        double room = spheres[j].radius - spheres[i].radius;
        if (room < 0 || sv_distance(spheres[i].centre, spheres[j].centre) > room) continue;
        bool alike = room == 0;
        if (!alike || j < i) return true;
    }
    return false;
}

shape_sphere *shape_spheres_that_count(const shape_sphere *spheres, int count, int *kept) {
    SHAPE_ASSERT(spheres && count >= 1 && kept);
    shape_sphere *copy = malloc((size_t)count * sizeof *copy);
    SHAPE_ASSERT(copy);
    *kept = 0;
    for (int i = 0; i < count; i++) {
        SHAPE_ASSERT(spheres[i].radius > 0);
        if (!is_hidden(spheres, count, i)) copy[(*kept)++] = spheres[i];
    }
    return copy;
}

/* ---- a row of spheres ------------------------------------------------------------------------ */

typedef struct bead {
    double at, radius; /* m along the row */
    double from;       /* m along the row, where it takes over from the one before */
} bead;

static int compare_beads(const void *a, const void *b) {
    const bead *p = a, *q = b;
    return p->at < q->at ? -1 : p->at > q->at ? 1 : 0;
}

/* Where the radical plane of two spheres cuts the row. */
static double radical(const bead *a, const bead *b) {
    double d = b->at - a->at;
    return a->at + (d * d + (a->radius - b->radius) * (a->radius + b->radius)) / (2 * d);
}

/* Squares of the distance from the surface to the axis are parabolas that differ by straight lines,
 * so the spheres that show are the upper hull of these lines. Leaves them in order. */
static int upper_hull(bead *beads, int count) {
    qsort(beads, (size_t)count, sizeof *beads, compare_beads);
    int top = 0;
    for (int i = 0; i < count; i++) {
        bead next = beads[i];
        while (top > 0) {
            next.from = radical(&beads[top - 1], &next);
            if (next.from > beads[top - 1].from) break;
            top--;
        }
        if (top == 0) next.from = -HUGE_VAL;
        beads[top++] = next;
    }
    return top;
}

/* The zone of one sphere between a and b, from its own centre. */
static void add_zone(shape_moments *m, const bead *one, double a, double b, shape_vec row,
                     double off) {
    double r2 = one->radius * one->radius, d = b - a;
    double s1 = a + b, s2 = a * a + a * b + b * b, s3 = s1 * (a * a + b * b);
    double s4 = a * a * a * a + a * b * s2 + b * b * b * b;
    double area = d * (r2 - s2 / 3);                          /* integral of rho^2 */
    double first = d * (r2 * s1 / 2 - s3 / 4);                /* of t rho^2 */
    double second = d * (r2 * s2 / 3 - s4 / 5);               /* of t^2 rho^2 */
    double fourth = d * (r2 * r2 - 2 * r2 * s2 / 3 + s4 / 5); /* of rho^4 */
    double at = one->at - off;
    double axial = SHAPE_PI * (second + at * (2 * first + at * area));
    double across = SHAPE_PI / 4 * fourth;
    m->volume += SHAPE_PI * area;
    m->first = sv_along(m->first, SHAPE_PI * (first + at * area), row);
    shape_second_add(m->second, axial - across, row, row);
    for (int k = 0; k < 3; k++) m->second[k][k] += across;
}

static shape_mass row_mass(const shape_sphere *spheres, int count, shape_vec row, double sideways) {
    bead *beads = malloc((size_t)count * sizeof *beads);
    SHAPE_ASSERT(beads);
    shape_vec origin = spheres[0].centre;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < count; i++) {
        double at = sv_dot(sv_sub(spheres[i].centre, origin), row);
        beads[i] = (bead){at, spheres[i].radius, 0};
        low = fmin(low, at - spheres[i].radius);
        high = fmax(high, at + spheres[i].radius);
    }
    int shown = upper_hull(beads, count);
    double middle = 0.5 * (low + high);
    shape_moments m = {.about = sv_along(origin, middle, row)};
    for (int i = 0; i < shown; i++) {
        const bead *one = &beads[i];
        double to = i + 1 < shown ? beads[i + 1].from : HUGE_VAL;
        double a = fmax(one->from - one->at, -one->radius), b = fmin(to - one->at, one->radius);
        if (a < b) add_zone(&m, one, a, b, row, middle);
    }
    free(beads);
    double rounding = 16 * count * 0x1p-52 * m.volume;
    double doubtful = rounding + sideways * shape_spheres_area(spheres, count, sideways);
    return shape_mass_of(&m, doubtful, 0.5 * (high - low));
}

/* True when no centre is farther from the line through two of them than rounding may have put it;
 * `sideways` is how far the farthest one is. */
static bool is_row(const shape_sphere *spheres, int count, shape_vec *row, double *sideways) {
    *row = sv(1, 0, 0);
    *sideways = 0;
    int far = 0;
    double length = 0;
    for (int i = 1; i < count; i++) {
        double d = sv_distance(spheres[i].centre, spheres[0].centre);
        if (d > length) length = d, far = i;
    }
    if (length == 0) return true;
    *row = sv_scale(1 / length, sv_sub(spheres[far].centre, spheres[0].centre));
    for (int i = 0; i < count; i++) {
        shape_vec arm = sv_sub(spheres[i].centre, spheres[0].centre);
        if (i != far) *sideways = fmax(*sideways, sv_norm(sv_cross(arm, *row)));
    }
    return *sideways <= 1e-13 * shape_spheres_reach(spheres, count, spheres[0].centre);
}

shape_mass shape_union_mass(const shape_sphere *spheres, int count) {
    int kept;
    shape_sphere *shown = shape_spheres_that_count(spheres, count, &kept);
    shape_vec row;
    double sideways;
    shape_mass mass = is_row(shown, kept, &row, &sideways) ? row_mass(shown, kept, row, sideways)
                                                           : shape_arcs_mass(shown, kept);
    free(shown);
    return mass;
}

shape_mass shape_union_mass_by_arcs(const shape_sphere *spheres, int count) {
    int kept;
    shape_sphere *shown = shape_spheres_that_count(spheres, count, &kept);
    shape_mass mass = shape_arcs_mass(shown, kept);
    free(shown);
    return mass;
}
