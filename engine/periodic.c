/* periodic.c - a domain that repeats itself along some axes: what it demands of bodies and walls,
 * and bodies that come back at the other face. */
#include "engine/periodic.h"

#include "engine/geometry.h"
#include "engine/world.h"

void period_choose(clast_world *w) {
    vec3 length = v3_sub(w->def.domain_max, w->def.domain_min);
    for (int k = 0; k < 3; k++) {
        bool periodic = w->def.periodic[k];
        w->period.any |= periodic;
        w->period.length[k] = periodic ? v3_at(length, k) : 0;
        w->period.half[k] = periodic ? 0.5 * v3_at(length, k) : INFINITY;
    }
    w->kernel_period.any = w->period.any;
    for (int k = 0; k < 3; k++) {
        w->kernel_period.length[k] = w->period.length[w->axes[k]];
        w->kernel_period.half[k] = w->period.half[w->axes[k]];
    }
}

/* ---- bodies ---------------------------------------------------------------------------------- */

/* More lengths than anything goes in a step: left to the guards. */
#define FAR_AWAY 1e6

static double lengths_outside(double x, double low, double high, double length) {
    if (!(x < low) && !(x > high)) return 0;
    double n = floor((x - low) / length);
    return fabs(n) < FAR_AWAY ? n : 0;
}

/* Puts a body into the domain along its periodic axes; returns what was taken off its position.
 * Books what its fall goes on by. */
vec3 body_wrap(clast_world *w, size_t slot, exact_sum *unwrapped) {
    double *column[3] = {w->bodies.x, w->bodies.y, w->bodies.z}, way[3] = {0, 0, 0};
    double mass = w->shapes[w->bodies.shape[slot]].mass;
    for (int k = 0; k < 3; k++) {
        double length = w->period.length[k], *x = &column[k][slot];
        if (length == 0) continue;
        double n =
            lengths_outside(*x, v3_at(w->def.domain_min, k), v3_at(w->def.domain_max, k), length);
        if (n == 0) continue;
        way[k] = n * length;
        *x -= way[k];
        w->bodies.image[k][slot] += (int32_t)n;
        sum_add(unwrapped, &w->ledger.scale, -mass * v3_at(w->def.gravity, k) * way[k]);
    }
    return v3(way[0], way[1], way[2]);
}

/* Whether one of them is outside for good. */
bool bodies_wrap(clast_world *w, size_t begin, size_t end, exact_sum *unwrapped) {
    bool outside = false;
    for (size_t i = begin; i < end; i++) {
        body_wrap(w, i, unwrapped);
        outside |= body_is_outside(w, i);
    }
    return outside;
}

/* ---- walls ----------------------------------------------------------------------------------- */

static const char AXIS[] = "xyz";

/* Of its length, what a mesh may miss of the whole: single precision, as STL has it. */
#define WHOLE (1 - 1e-6)

/* A plate has a side along the axis, or has not. */
static void extend_plate(wall *l) {
    l->extent.half = l->half_box;
    for (int k = 0; k < 3; k++)
        l->extent.ruled[k] = fabs(v3_at(l->u, k)) > 1 - 1e-12 || fabs(v3_at(l->v, k)) > 1 - 1e-12;
}

typedef struct side_sums {
    double area, low, high; /* m2, of triangles along the axis; m, of their sides at the two ends */
    bool oblique;           /* one is neither along the axis nor at an end */
} side_sums;

static void add_side(side_sums *s, const clast_mesh_def *d, int triangle, int axis, double low,
                     double high) {
    const int32_t *c = d->triangle + 3 * (size_t)triangle;
    vec3 p[3] = {d->vertex[c[0]], d->vertex[c[1]], d->vertex[c[2]]};
    double slack = (1 - WHOLE) * (high - low);
    bool at_low[3], at_high[3];
    for (int k = 0; k < 3; k++) {
        at_low[k] = v3_at(p[k], axis) - low <= slack;
        at_high[k] = high - v3_at(p[k], axis) <= slack;
    }
    if ((at_low[0] && at_low[1] && at_low[2]) || (at_high[0] && at_high[1] && at_high[2])) return;
    vec3 area = v3_scale(0.5, v3_cross(v3_sub(p[1], p[0]), v3_sub(p[2], p[0])));
    s->oblique |= !(fabs(v3_at(area, axis)) <= 1e-5 * v3_norm(area));
    s->area += v3_norm(area);
    for (int k = 0; k < 3; k++) {
        double side = v3_norm(v3_sub(p[(k + 1) % 3], p[k]));
        if (at_low[k] && at_low[(k + 1) % 3]) s->low += side;
        if (at_high[k] && at_high[(k + 1) % 3]) s->high += side;
    }
}

/* The same in every section across the axis, but for what closes it at the ends: triangles along
 * the axis have the area that their sides at either end sweep over. */
static bool is_ruled(const clast_mesh_def *d, int axis, double low, double high) {
    side_sums s = {0};
    for (int t = 0; t < d->triangles; t++) add_side(&s, d, t, axis, low, high);
    double slack = 1e-5 * s.area, length = high - low;
    return !s.oblique && fabs(s.area - s.low * length) <= slack &&
           fabs(s.area - s.high * length) <= slack;
}

/* The walls from `first` on are those of a mesh: all of them are felt in one image. */
void mesh_extend(clast_world *w, int first, const clast_mesh_def *d) {
    double low[3], high[3];
    wall_extent extent;
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY, high[k] = -INFINITY;
        for (int c = 0; c < 3 * d->triangles; c++) {
            double at = v3_at(d->vertex[d->triangle[c]], k);
            low[k] = fmin(low[k], at), high[k] = fmax(high[k], at);
        }
        extent.ruled[k] = w->def.periodic[k] && is_ruled(d, k, low[k], high[k]);
    }
    vec3 from = v3(low[0], low[1], low[2]), to = v3(high[0], high[1], high[2]);
    extent.half = v3_scale(0.5, v3_sub(to, from));
    for (int l = first; l < w->wall_count; l++) {
        w->walls[l].extent = extent;
        w->walls[l].anchor_start = w->walls[l].anchor = v3_add(from, extent.half);
    }
}

/* ---- what is demanded ------------------------------------------------------------------------ */

static clast_status refuse_wall(clast_world *w, const wall *l, int axis, const char *what) {
    double half = v3_at(l->extent.half, axis);
    return (clast_status)world_fail(
        w, CLAST_ERR_ARGUMENT,
        "wall %s: %s: the domain is periodic along %c and %.6g mm long, the wall %.6g mm, the "
        "largest body %.6g mm",
        l->name, what, AXIS[axis], 1e3 * w->period.length[axis], 2e3 * half,
        2e3 * w->largest_bound);
}

/* A body touches one image of a wall alone, or they all are one wall without ends. */
static clast_status check_wall(clast_world *w, wall *l, int axis) {
    double length = w->period.length[axis], half = v3_at(l->extent.half, axis);
    const part *p = &w->parts[l->part];
    bool tumbles = p->turns && fabs(v3_at(p->axis, axis)) < 1 - 1e-12;
    if (length == 0) return CLAST_OK;
    if (tumbles) half = v3_norm(l->extent.half);
    if (l->def.kind == CLAST_WALL_PLANE) {
        if (fabs(v3_at(l->n, axis)) <= 1e-12 && !tumbles) return CLAST_OK;
        return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT,
                                        "wall %s: is a plane whose normal has a component along "
                                        "%c, where the domain is periodic",
                                        l->name, AXIS[axis]);
    }
    if (2 * half >= WHOLE * length) {
        if (l->extent.ruled[axis] && !tumbles) {
            fillets_unend(l, v3(axis == 0, axis == 1, axis == 2));
            return CLAST_OK;
        }
        return refuse_wall(w, l, axis,
                           "is too long to be felt in one place and not the same all "
                           "along");
    }
    double room = 0.5 * length - half - w->largest_bound;
    if (!(room > 0.1 * w->smallest_radius))
        return refuse_wall(w, l, axis,
                           "neither spans the domain nor leaves room for a body "
                           "between its ends");
    w->most_skin = fmin(w->most_skin, room);
    return CLAST_OK;
}

/* Needs sizes. A wall that a body may reach in two images would be felt in one: so there are none.
 * The skin stays below the room that they leave, so that what is in reach is so in one image. */
clast_status period_check(clast_world *w) {
    w->most_skin = INFINITY;
    for (int k = 0; k < 3; k++) {
        if (!w->def.periodic[k] || w->period.length[k] >= 4 * w->largest_bound) continue;
        return (clast_status)world_fail(
            w, CLAST_ERR_ARGUMENT,
            "the domain is periodic along %c and %.6g mm long, expected two cells of the largest "
            "body's %.6g mm at least: two bodies could touch across both faces at once",
            AXIS[k], 1e3 * w->period.length[k], 2e3 * w->largest_bound);
    }
    for (int i = 0; i < w->wall_count && w->period.any; i++) {
        wall *l = &w->walls[i];
        if (l->def.kind == CLAST_WALL_PLATE) extend_plate(l);
        for (int k = 0; k < 3; k++) {
            clast_status s = check_wall(w, l, k);
            if (s) return s;
        }
    }
    if (w->skin > w->most_skin) w->skin = w->most_skin;
    return CLAST_OK;
}
