/* geometry.h - where a sphere meets a wall, world frame. */
#ifndef CLAST_GEOMETRY_H
#define CLAST_GEOMETRY_H

#include "engine/world.h"

/* Nearest point of the wall, as the vector from it to the centre. `inside`: over the face of a
 * plate or patch. */
typedef struct approach {
    vec3 away;       /* m, from the nearest point to the centre; for planes along +normal */
    double distance; /* m, signed for planes */
    bool inside;
    bool off_border; /* inside, and not at the rim: no other wall of the mesh holds the point */
} approach;

static inline double clamp(double x, double limit) {
    return x > limit ? limit : x < -limit ? -limit : x;
}

/* In-plane way from the nearest point of a shape to (s, t); zero inside. */
typedef struct flat_way {
    double s, t;
} flat_way;

static inline flat_way way_from_segment(const double *a, const double *b, double s, double t) {
    double es = b[0] - a[0], et = b[1] - a[1], ps = s - a[0], pt = t - a[1];
    double along = (ps * es + pt * et) / (es * es + et * et);
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    return (flat_way){ps - along * es, pt - along * et};
}

static inline bool left_of(const double *a, const double *b, double s, double t) {
    return (b[0] - a[0]) * (t - a[1]) - (b[1] - a[1]) * (s - a[0]) >= 0;
}

/* corner: three (s, t), counter-clockwise. */
static inline flat_way way_from_triangle(const double *corner, double s, double t) {
    const double *a = corner, *b = corner + 2, *c = corner + 4;
    bool ab = left_of(a, b, s, t), bc = left_of(b, c, s, t), ca = left_of(c, a, s, t);
    if (ab && bc && ca) return (flat_way){0, 0};
    flat_way best = {INFINITY, 0};
    double least = INFINITY;
    const double *ends[4] = {a, b, c, a};
    for (int k = 0; k < 3; k++) {
        flat_way way = way_from_segment(ends[k], ends[k + 1], s, t);
        double square = way.s * way.s + way.t * way.t;
        if (square < least) least = square, best = way;
    }
    return best;
}

static inline flat_way way_from_patch(const patch *p, double s, double t) {
    flat_way best = {INFINITY, 0};
    double least = INFINITY;
    for (int k = 0; k < p->triangles && least > 0; k++) {
        flat_way way = way_from_triangle(p->corner + 6 * k, s, t);
        double square = way.s * way.s + way.t * way.t;
        if (square < least) least = square, best = way;
    }
    return best;
}

/* Nothing of a mesh lies over the inside of one of its patches. */
static inline bool is_off_border(const wall *l, double s, double t) {
    double slack = 1e-9 * l->bound;
    return l->is_rectangle && fabs(s) < l->def.half_side[0] - slack &&
           fabs(t) < l->def.half_side[1] - slack;
}

static inline approach wall_approach(const wall *l, vec3 centre) {
    vec3 d = v3_sub(centre, l->point);
    double height = v3_dot(d, l->n);
    if (l->def.kind == CLAST_WALL_PLANE)
        return (approach){v3_scale(height, l->n), height, true, true};
    double s = v3_dot(d, l->u), t = v3_dot(d, l->v);
    flat_way way = {s - clamp(s, l->def.half_side[0]), t - clamp(t, l->def.half_side[1])};
    if (l->def.kind == CLAST_WALL_PATCH && !l->is_rectangle) way = way_from_patch(&l->patch, s, t);
    if (way.s == 0 && way.t == 0)
        return (approach){v3_scale(height, l->n), fabs(height), true, is_off_border(l, s, t)};
    vec3 away =
        v3_add(v3_scale(height, l->n), v3_add(v3_scale(way.s, l->u), v3_scale(way.t, l->v)));
    return (approach){away, v3_norm(away), false, false};
}

/* Where plates or patches share a border or overlap in one plane, one of them is felt: a face
 * before an edge, and among equals in one plane the one that was added first. Two faces in
 * different planes are both felt. */
static inline bool is_hidden(const clast_world *w, const wall *l, vec3 centre, const approach *a) {
    if (a->off_border) return false;
    vec3 nearest = v3_sub(centre, a->away);
    for (int i = 0; i < l->joined_count; i++) {
        const wall *other = &w->walls[l->joined[i]];
        if (!w->parts[other->part].present) continue;
        if (wall_approach(other, nearest).distance > 1e-9 * (l->bound + other->bound)) continue;
        bool face = wall_approach(other, centre).inside;
        bool one_plane = fabs(v3_dot(l->n, other->n)) > 1 - 1e-9;
        if (face && a->inside && !one_plane) continue;
        if (face == a->inside ? other < l : face) return true;
    }
    return false;
}

typedef struct wall_touch {
    vec3 normal;    /* from the wall to the sphere */
    double overlap; /* m; <= 0: apart */
} wall_touch;

static inline wall_touch touch_of_wall(const clast_world *w, const wall *l, vec3 centre,
                                       double radius) {
    approach a = wall_approach(l, centre);
    wall_touch t = {l->n, radius - a.distance};
    bool behind = l->def.kind != CLAST_WALL_PLANE && v3_dot(a.away, l->n) < 0;
    if (behind) t.normal = v3_scale(-1, l->n);
    if (!a.inside) t.normal = v3_scale(1 / a.distance, a.away);
    if (t.overlap > 0 && l->joined_count > 0 && is_hidden(w, l, centre, &a)) t.overlap = 0;
    return t;
}

#endif
