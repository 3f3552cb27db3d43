#include "meshes/status.h"
#include "meshes/work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Farther from the origin than any machine part: a garbled file, and squares stay finite. */
static const double REACH = 1e6; /* m */

static mesh_status check_options(const mesh_options *o) {
    int seen = 0;
    for (int k = 0; k < 3; k++)
        if (o->axis[k] != 0 && abs(o->axis[k]) <= 3) seen |= 1 << abs(o->axis[k]);
    if (!(o->unit > 0 && isfinite(o->unit)))
        return mesh_fail(MESH_ERR_ARGUMENT, "mesh unit of %g m: it must be above 0", o->unit);
    if (seen != 14)
        return mesh_fail(MESH_ERR_ARGUMENT,
                         "mesh axes %d %d %d: x, y and z must each be there once", o->axis[0],
                         o->axis[1], o->axis[2]);
    if (!(o->weld >= 1e-12 && o->weld <= 1e-2))
        return mesh_fail(MESH_ERR_ARGUMENT, "mesh weld of %g: it must be in [1e-12, 1e-2]",
                         o->weld);
    return MESH_OK;
}

static mesh_status check_corner(const mesh_work *w, size_t at) {
    size_t triangle = at / 3 + 1, corner = at % 3 + 1;
    if (w->corner[at] < 0 || (size_t)w->corner[at] >= w->vertex_count)
        return mesh_fail(MESH_ERR_FORMAT, "%s: triangle %zu, corner %zu: no vertex %ld among %zu",
                         w->name, triangle, corner, (long)w->corner[at], w->vertex_count);
    const double *p = w->vertex + 3 * (size_t)w->corner[at];
    for (int k = 0; k < 3; k++)
        if (!(fabs(p[k]) <= REACH))
            return mesh_fail(MESH_ERR_FORMAT, "%s: triangle %zu, corner %zu at (%g, %g, %g) m: %s",
                             w->name, triangle, corner, p[0], p[1], p[2],
                             isfinite(p[k]) ? "more than 1e6 m away" : "not a place");
    return MESH_OK;
}

static mesh_status check_corners(const mesh_work *w) {
    for (size_t at = 0; at < 3 * w->count; at++) {
        mesh_status status = check_corner(w, at);
        if (status != MESH_OK) return status;
    }
    return MESH_OK;
}

static void to_metres(mesh_work *w, const mesh_options *o) {
    for (size_t v = 0; v < w->vertex_count; v++) {
        double old[3], *p = w->vertex + 3 * v;
        memcpy(old, p, sizeof old);
        for (int k = 0; k < 3; k++)
            p[k] = o->unit * (o->axis[k] > 0 ? old[o->axis[k] - 1] : -old[-o->axis[k] - 1]);
    }
}

static bool mirrors(const int axis[3]) {
    bool cyclic = (abs(axis[1]) - abs(axis[0]) + 3) % 3 == 1;
    return cyclic != (axis[0] * axis[1] * axis[2] > 0);
}

static double diagonal(const mesh_report *r) {
    double square = 0;
    for (int k = 0; k < 3; k++) square += (r->high[k] - r->low[k]) * (r->high[k] - r->low[k]);
    return sqrt(square);
}

static mesh_status clean(mesh_work *w, const mesh_options *o) {
    mesh_report *r = w->report;
    for (size_t t = 0; t < w->count; t++) w->source[t] = (int32_t)t;
    to_metres(w, o);
    mesh_status status = check_corners(w);
    if (status != MESH_OK) return status;
    for (size_t t = 0; t < w->count && mirrors(o->axis); t++) mesh_turn(w->corner + 3 * t);
    mesh_measure_box(w);
    r->weld_distance = o->weld * diagonal(r);
    if ((status = mesh_weld(w)) != MESH_OK) return status;
    if ((status = mesh_remove(w)) != MESH_OK) return status;
    if (w->count == 0)
        return mesh_fail(
            MESH_ERR_FORMAT,
            "%s: none of the %zu triangles has an area: %zu have corners that coincide, "
            "%zu are flat, within %g m",
            w->name, r->triangles_read, r->collapsed.count, r->slivers.count, r->weld_distance);
    if ((status = mesh_drop_unused(w)) != MESH_OK) return status;
    if ((status = mesh_check_edges(w, o->mend_winding)) != MESH_OK) return status;
    mesh_measure(w);
    return o->find_crossings ? mesh_find_crossings(w) : MESH_OK;
}

mesh_status mesh_clean(const char *name, mesh_surface *raw, const mesh_options *options,
                       mesh_surface *surface, mesh_report *report) {
    mesh_work w = {.name = name,
                   .vertex_count = raw->vertex_count,
                   .vertex = raw->vertex,
                   .count = raw->triangle_count,
                   .corner = raw->triangle,
                   .report = report};
    *raw = (mesh_surface){0};
    report->vertices_read = w.vertex_count;
    report->triangles_read = w.count;
    mesh_status status = MESH_OK;
    if (w.count == 0)
        status =
            mesh_fail(MESH_ERR_FORMAT, "%s: no triangles in it, %zu vertices, %zu points and lines",
                      name, w.vertex_count, report->not_faces);
    else if (w.count > INT32_MAX / 3 || w.vertex_count > INT32_MAX)
        status = mesh_fail(MESH_ERR_FORMAT, "%s: %zu triangles, %zu vertices: more than %d, %d",
                           name, w.count, w.vertex_count, INT32_MAX / 3, INT32_MAX);
    else if (!(w.source = mesh_array(w.count, sizeof *w.source)))
        status = MESH_ERR_MEMORY;
    else
        status = clean(&w, options);
    free(w.source);
    mesh_surface made = {w.vertex_count, w.vertex, w.count, w.corner};
    if (status != MESH_OK) mesh_free(&made);
    *surface = made;
    return status;
}

mesh_status mesh_build(const char *name, const mesh_surface *raw, const mesh_options *options,
                       mesh_surface *surface, mesh_report *report) {
    MESH_ASSERT(name && raw && options && surface);
    mesh_report unread;
    if (!report) report = &unread;
    *report = (mesh_report){0};
    *surface = (mesh_surface){0};
    mesh_status status = check_options(options);
    if (status != MESH_OK) return status;
    mesh_surface copy = {raw->vertex_count, mesh_array(raw->vertex_count, 3 * sizeof(double)),
                         raw->triangle_count, mesh_array(raw->triangle_count, 3 * sizeof(int32_t))};
    if (!copy.vertex || !copy.triangle) {
        mesh_free(&copy);
        return MESH_ERR_MEMORY;
    }
    if (raw->vertex_count > 0)
        memcpy(copy.vertex, raw->vertex, raw->vertex_count * 3 * sizeof(double));
    if (raw->triangle_count > 0)
        memcpy(copy.triangle, raw->triangle, raw->triangle_count * 3 * sizeof(int32_t));
    return mesh_clean(name, &copy, options, surface, report);
}

mesh_status mesh_load(const char *path, const mesh_options *options, mesh_surface *surface,
                      mesh_report *report) {
    MESH_ASSERT(path && options && surface);
    mesh_report unread;
    if (!report) report = &unread;
    *report = (mesh_report){0};
    *surface = (mesh_surface){0};
    mesh_surface raw = {0};
    mesh_status status = check_options(options);
    if (status == MESH_OK) status = mesh_probe(path);
    if (status == MESH_OK) status = mesh_import(path, &raw, report);
    if (status != MESH_OK) {
        mesh_free(&raw);
        return status;
    }
    return mesh_clean(path, &raw, options, surface, report);
}

void mesh_free(mesh_surface *surface) {
    MESH_ASSERT(surface);
    free(surface->vertex);
    free(surface->triangle);
    *surface = (mesh_surface){0};
}
