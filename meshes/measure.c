#include "meshes/vector.h"
#include "meshes/work.h"

#include <math.h>

static const double *corner(const mesh_work *w, size_t t, size_t k) {
    return w->vertex + 3 * (size_t)w->corner[3 * t + k];
}

static void from(const double origin[3], const double p[3], double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = p[k] - origin[k];
}

void mesh_normal(const mesh_work *w, size_t triangle, double normal[3]) {
    double b[3], c[3];
    from(corner(w, triangle, 0), corner(w, triangle, 1), b);
    from(corner(w, triangle, 0), corner(w, triangle, 2), c);
    mesh_cross(b, c, normal);
}

double mesh_six_volumes(const mesh_work *w, size_t triangle, const double origin[3]) {
    double n[3], a[3];
    mesh_normal(w, triangle, n);
    from(origin, corner(w, triangle, 0), a);
    return a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
}

void mesh_measure_box(mesh_work *w) {
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t at = 0; at < 3 * w->count; at++) {
            double x = w->vertex[3 * (size_t)w->corner[at] + (size_t)k];
            low = fmin(low, x);
            high = fmax(high, x);
        }
        w->report->low[k] = low;
        w->report->high[k] = high;
    }
}

void mesh_measure(mesh_work *w) {
    mesh_report *r = w->report;
    double centre[3], twice_area = 0, six_volumes = 0;
    mesh_measure_box(w);
    for (int k = 0; k < 3; k++) centre[k] = 0.5 * (r->low[k] + r->high[k]);
    for (size_t t = 0; t < w->count; t++) {
        double n[3];
        mesh_normal(w, t, n);
        twice_area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        six_volumes += mesh_six_volumes(w, t, centre);
    }
    r->area = twice_area / 2;
    r->volume = r->closed ? six_volumes / 6 : 0;
}
