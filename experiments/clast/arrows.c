#include "experiments/clast/arrows.h"

#include <math.h>
#include <stdlib.h>

#include "engine/check.h"

enum { STROKES = 3 };                                       /* of an arrow: shaft and two barbs */
static const double LONGEST = 5, BARB = 0.3, SPREAD = 0.14; /* radii; of the arrow */

static double norm(const double a[3]) {
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static double mean_radius(const frame *f) {
    double sum = 0;
    for (size_t i = 0; i < f->spheres; i++) sum += f->radius[i];
    return f->spheres > 0 ? sum / (double)f->spheres : 0;
}

/* Across the arrow, in the plane of the picture. */
static void across(const double along[3], const render_camera *c, double out[3]) {
    double sight[3];
    for (int k = 0; k < 3; k++) sight[k] = c->target[k] - c->eye[k];
    for (int k = 0; k < 3; k++)
        out[k] = along[(k + 1) % 3] * sight[(k + 2) % 3] - along[(k + 2) % 3] * sight[(k + 1) % 3];
    double length = norm(out);
    for (int k = 0; k < 3; k++) out[k] = length > 0 ? out[k] / length : 0;
}

static void put_arrow(double *from, double *to, const double *point, const double *force,
                      double length, const render_camera *c) {
    double size = norm(force), along[3], side[3];
    for (int k = 0; k < 3; k++) along[k] = size > 0 ? force[k] / size : 0;
    across(along, c, side);
    for (int s = 0; s < STROKES; s++)
        for (int k = 0; k < 3; k++) {
            double tip = point[k] + length * along[k], spread = s == 1 ? SPREAD : -SPREAD;
            to[3 * s + k] = tip;
            from[3 * s + k] =
                s == 0 ? point[k] : tip - length * (BARB * along[k] + spread * side[k]);
        }
}

/* The root of each force, and the largest. */
static double roots_of(const frame *f, double *root) {
    double most = 0;
    for (size_t i = 0; i < f->contacts; i++) {
        double now = sqrt(norm(&f->contact_force[3 * i]));
        most = fmax(most, now);
        for (int s = 0; s < STROKES; s++) root[(size_t)STROKES * i + (size_t)s] = now;
    }
    return most;
}

void arrows_make(arrows *a, const frame *f, const render_camera *camera, render_map map) {
    size_t strokes = STROKES * f->contacts;
    *a = (arrows){.ends = NULL};
    if (!f->contact_force || strokes == 0) return;
    a->ends = malloc(7 * strokes * sizeof *a->ends);
    a->colour = malloc(strokes * sizeof *a->colour);
    CLAST_ASSERT(a->ends && a->colour);
    double *from = a->ends, *to = from + 3 * strokes, *root = to + 3 * strokes;
    double most = roots_of(f, root), longest = LONGEST * mean_radius(f);
    for (size_t i = 0; i < f->contacts; i++) {
        double length = most > 0 ? longest * root[STROKES * i] / most : 0;
        put_arrow(from + 3 * STROKES * i, to + 3 * STROKES * i, &f->contact_point[3 * i],
                  &f->contact_force[3 * i], length, camera);
    }
    render_colour_map(map, root, strokes, 0, most > 0 ? most : 1, a->colour);
    a->lines = (render_lines){
        .count = strokes, .from = from, .to = to, .colour = a->colour, .on_top = true};
}

void arrows_free(arrows *a) {
    free(a->ends), free(a->colour);
    *a = (arrows){.ends = NULL};
}
