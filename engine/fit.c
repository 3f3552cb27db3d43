/* fit.c - element spheres on the profile of a particle, A00 section 2.2.2. */
#include "engine/world.h"

enum { HALVINGS = 80, SPHERES_MAX = 1000 };

typedef struct ellipse {
    double a, b;
} ellipse;

/* Point of the upper half of the ellipse at t in [0, 1]: t = 0 is the left tip, t = 1 the right
 * one. */
static void point_at(const ellipse *e, double t, double *x, double *y) {
    double u = 2 * t - 1, s = 1 - u * u;
    *x = e->a * u;
    *y = e->b * sqrt(s > 0 ? s : 0);
}

/* The next point on the profile at distance `chord` from (x, y): A00 2.2.2 turns a radius until it
 * meets the profile; bisection of the parameter does the same. Returns false past the right tip. */
static bool next_point(const ellipse *e, double chord, double *t, double *x, double *y) {
    double low = *t, high = 1, px, py;
    point_at(e, high, &px, &py);
    if ((px - *x) * (px - *x) + (py - *y) * (py - *y) < chord * chord) return false;
    for (int i = 0; i < HALVINGS; i++) {
        double middle = 0.5 * (low + high);
        point_at(e, middle, &px, &py);
        double d2 = (px - *x) * (px - *x) + (py - *y) * (py - *y);
        if (d2 < chord * chord)
            low = middle;
        else
            high = middle;
    }
    *t = 0.5 * (low + high);
    point_at(e, *t, x, y);
    return true;
}

/* Walks `spheres` chords along the profile and tells whether the last chord would pass the right
 * tip. */
static bool overshoots(const ellipse *e, double chord, int spheres, double *x_of, double *y_of) {
    double t = 0, x = -e->a, y = 0;
    for (int i = 0; i < spheres; i++) {
        if (!next_point(e, chord, &t, &x, &y)) return true;
        x_of[i] = x, y_of[i] = y;
    }
    return (e->a - x) * (e->a - x) + y * y < chord * chord;
}

clast_status clast_fit_ellipse(double a, double b, int spheres, clast_vec3 *centre,
                               double *radius) {
    CLAST_ASSERT(centre && radius);
    if (!(a >= b && b > 0 && a < INFINITY) || spheres < 1 || spheres > SPHERES_MAX)
        return CLAST_ERR_ARGUMENT;
    ellipse e = {a, b};
    double x[SPHERES_MAX], y[SPHERES_MAX], low = 0, high = 4 * a;
    for (int i = 0; i < HALVINGS; i++) {
        double chord = 0.5 * (low + high);
        if (overshoots(&e, chord, spheres, x, y))
            high = chord;
        else
            low = chord;
    }
    overshoots(&e, low, spheres, x, y);
    for (int i = 0; i < spheres; i++) {
        /* r = y / cos(theta), x_c = x + y tan(theta), A00 2.3, with y y' = -b^2 x / a^2 */
        double slope_y = -b * b * x[i] / (a * a);
        centre[i] = v3(x[i] + slope_y, 0, 0);
        radius[i] = sqrt(y[i] * y[i] + slope_y * slope_y);
    }
    /* the walk runs left to right: make the two halves mirror each other to the bit */
    for (int i = 0; i < spheres / 2; i++) {
        int j = spheres - 1 - i;
        double c = 0.5 * (centre[j].x - centre[i].x), r = 0.5 * (radius[i] + radius[j]);
        centre[i].x = -c, centre[j].x = c;
        radius[i] = radius[j] = r;
    }
    if (spheres % 2 == 1) centre[spheres / 2].x = 0, radius[spheres / 2] = b;
    return CLAST_OK;
}
