#include "render/scene.h"

#include "render/status.h"

#include <math.h>

/* Index of the first number that is not finite, or count. */
static size_t first_bad(const double *value, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!isfinite(value[i])) return i;
    return count;
}

static render_status check_spheres(const render_spheres *s) {
    const double *column[] = {s->x, s->y, s->z, s->radius};
    static const char *const NAME[] = {"x", "y", "z", "radius"};
    if (s->count == 0) return RENDER_OK;
    for (int k = 0; k < 4; k++) {
        if (!column[k]) return render_fail(RENDER_ERR_ARGUMENT, "spheres: no %s given", NAME[k]);
        size_t bad = first_bad(column[k], s->count);
        if (bad < s->count)
            return render_fail(RENDER_ERR_ARGUMENT, "spheres: %s of sphere %zu is %g, not finite",
                               NAME[k], bad, column[k][bad]);
    }
    for (size_t i = 0; i < s->count; i++)
        if (s->radius[i] <= 0)
            return render_fail(RENDER_ERR_ARGUMENT,
                               "spheres: radius of sphere %zu is %g m, not > 0", i, s->radius[i]);
    for (size_t i = 0; s->body && i < s->count; i++)
        if (s->body[i] < 0)
            return render_fail(RENDER_ERR_ARGUMENT, "spheres: body of sphere %zu is %ld, not >= 0",
                               i, (long)s->body[i]);
    return s->count < UINT32_MAX / 4
               ? RENDER_OK
               : render_fail(RENDER_ERR_ARGUMENT, "spheres: %zu are too many", s->count);
}

static render_status check_wall(const render_walls *w, size_t number) {
    if (w->face_count == 0) return RENDER_OK;
    if (w->corners != 3 && w->corners != 4)
        return render_fail(RENDER_ERR_ARGUMENT, "walls %zu: faces of %d corners, expected 3 or 4",
                           number, w->corners);
    if (!w->vertex || !w->index)
        return render_fail(RENDER_ERR_ARGUMENT, "walls %zu: no vertices or no index given", number);
    if (!(w->opacity >= 0 && w->opacity <= 1) || !(w->edge_px >= 0 && w->edge_px < 1e4))
        return render_fail(RENDER_ERR_ARGUMENT,
                           "walls %zu: opacity %g (expected 0 to 1), edges of %g px", number,
                           w->opacity, w->edge_px);
    size_t bad = first_bad(w->vertex, 3 * w->vertex_count);
    if (bad < 3 * w->vertex_count)
        return render_fail(RENDER_ERR_ARGUMENT, "walls %zu: vertex %zu is not finite", number,
                           bad / 3);
    for (size_t i = 0; i < w->face_count * (size_t)w->corners; i++)
        if (w->index[i] >= w->vertex_count)
            return render_fail(RENDER_ERR_ARGUMENT,
                               "walls %zu: face %zu names vertex %lu, but there are %zu", number,
                               i / (size_t)w->corners, (unsigned long)w->index[i], w->vertex_count);
    return RENDER_OK;
}

static render_status check_lines(const render_lines *l, size_t number) {
    if (l->count == 0) return RENDER_OK;
    if (!l->from || !l->to)
        return render_fail(RENDER_ERR_ARGUMENT, "lines %zu: no end points given", number);
    if (!(l->opacity >= 0 && l->opacity <= 1))
        return render_fail(RENDER_ERR_ARGUMENT, "lines %zu: opacity %g, expected 0 to 1", number,
                           l->opacity);
    size_t bad = first_bad(l->from, 3 * l->count);
    if (bad == 3 * l->count) bad = first_bad(l->to, 3 * l->count);
    if (bad < 3 * l->count)
        return render_fail(RENDER_ERR_ARGUMENT, "lines %zu: segment %zu is not finite", number,
                           bad / 3);
    for (size_t i = 0; l->width && i < l->count; i++)
        if (!(l->width[i] >= 0) || !isfinite(l->width[i]))
            return render_fail(RENDER_ERR_ARGUMENT, "lines %zu: segment %zu has width %g", number,
                               i, l->width[i]);
    return RENDER_OK;
}

render_status render_scene_check(const render_scene *scene) {
    RENDER_ASSERT(scene);
    RENDER_ASSERT(scene->walls_count == 0 || scene->walls);
    RENDER_ASSERT(scene->lines_count == 0 || scene->lines);
    render_status status = check_spheres(&scene->spheres);
    for (size_t i = 0; i < scene->walls_count && status == RENDER_OK; i++)
        status = check_wall(&scene->walls[i], i);
    for (size_t i = 0; i < scene->lines_count && status == RENDER_OK; i++)
        status = check_lines(&scene->lines[i], i);
    return status;
}

static void widen(double low[3], double high[3], const double *point, double by) {
    for (int k = 0; k < 3; k++) {
        low[k] = fmin(low[k], point[k] - by);
        high[k] = fmax(high[k], point[k] + by);
    }
}

void render_scene_bounds(const render_scene *scene, double low[3], double high[3]) {
    RENDER_ASSERT(scene && low && high);
    for (int k = 0; k < 3; k++) {
        low[k] = HUGE_VAL;
        high[k] = -HUGE_VAL;
    }
    const render_spheres *s = &scene->spheres;
    for (size_t i = 0; i < s->count; i++)
        widen(low, high, (double[3]){s->x[i], s->y[i], s->z[i]}, s->radius[i]);
    for (size_t w = 0; w < scene->walls_count; w++)
        for (size_t i = 0; i < scene->walls[w].vertex_count; i++)
            widen(low, high, scene->walls[w].vertex + 3 * i, 0);
    for (size_t l = 0; l < scene->lines_count; l++)
        for (size_t i = 0; i < scene->lines[l].count; i++) {
            widen(low, high, scene->lines[l].from + 3 * i, 0);
            widen(low, high, scene->lines[l].to + 3 * i, 0);
        }
    for (int k = 0; k < 3; k++)
        if (low[k] > high[k]) low[k] = high[k] = 0;
}

static double depth_of(const render_lens *lens, const double *point) {
    return (point[0] - lens->eye[0]) * lens->ahead[0] + (point[1] - lens->eye[1]) * lens->ahead[1] +
           (point[2] - lens->eye[2]) * lens->ahead[2];
}

void render_scene_depths(const render_scene *scene, const render_lens *lens, double *near_m,
                         double *far_m) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    const render_spheres *s = &scene->spheres;
    for (size_t i = 0; i < s->count; i++) {
        double z = depth_of(lens, (double[3]){s->x[i], s->y[i], s->z[i]});
        low = fmin(low, z - s->radius[i]);
        high = fmax(high, z + s->radius[i]);
    }
    for (size_t w = 0; w < scene->walls_count; w++)
        for (size_t i = 0; i < scene->walls[w].vertex_count; i++) {
            double z = depth_of(lens, scene->walls[w].vertex + 3 * i);
            low = fmin(low, z);
            high = fmax(high, z);
        }
    if (lens->perspective) low = fmax(low, 0); /* what lies behind the eye needs no depth */
    if (!(low < high)) {
        low = 0;
        high = 1;
    }
    double spare = 1e-3 * (high - low); /* so that neither end falls on the clear value */
    *near_m = low - spare;
    *far_m = high + spare;
}
