/* geometry.h - where a sphere meets a wall, world frame. */
#ifndef CLAST_GEOMETRY_H
#define CLAST_GEOMETRY_H

#include "engine/periodic.h"

/* Nearest point of the wall, as the vector from it to the centre. `inside`: over the face of a
 * plate or patch. */
typedef struct approach {
    vec3 away;       /* m, from the nearest point to the centre; for planes along +normal */
    double distance; /* m, signed for planes */
    bool inside;
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

/* A patch of many triangles has a tree of boxes (low s, low t, high s, high t) behind its corners:
 * node k has the children 2 k + 1 and 2 k + 2, and leaf i of so many has the triangles
 * patch_first(i) .. patch_first(i + 1) - 1. */
static inline int patch_leaves(int triangles) {
    int leaves = 1;
    while (4 * leaves < triangles) leaves *= 2;
    return leaves;
}

static inline size_t patch_first(const patch *p, int leaf, int leaves) {
    return (size_t)leaf * (size_t)p->triangles / (size_t)leaves;
}

static inline double square_from_box(const double *box, double s, double t) {
    double ds = s < box[0] ? box[0] - s : s > box[2] ? s - box[2] : 0;
    double dt = t < box[1] ? box[1] - t : t > box[3] ? t - box[3] : 0;
    return ds * ds + dt * dt;
}

typedef struct nearest_way {
    flat_way way;
    double square;
} nearest_way;

static inline void try_leaf(const patch *p, int leaf, int leaves, double s, double t,
                            nearest_way *best) {
    for (size_t k = patch_first(p, leaf, leaves); k < patch_first(p, leaf + 1, leaves); k++) {
        flat_way way = way_from_triangle(p->corner + 6 * k, s, t);
        double square = way.s * way.s + way.t * way.t;
        if (square < best->square) *best = (nearest_way){way, square};
    }
}

static inline flat_way way_from_patch(const patch *p, double s, double t) {
    enum { DEPTH = 32 };
    nearest_way best = {{INFINITY, 0}, INFINITY};
    int leaves = patch_leaves(p->triangles), waiting[DEPTH], count = 0;
    const double *boxes = p->corner + 6 * (size_t)p->triangles;
    waiting[count++] = 0;
    while (count > 0) {
        int node = waiting[--count];
        if (square_from_box(boxes + 4 * (size_t)node, s, t) >= best.square) continue;
        if (node >= leaves - 1) {
            try_leaf(p, node - (leaves - 1), leaves, s, t, &best);
            continue;
        }
        const double *left = boxes + 4 * (size_t)(2 * node + 1);
        bool nearer = square_from_box(left, s, t) <= square_from_box(left + 4, s, t);
        waiting[count++] = 2 * node + (nearer ? 2 : 1);
        waiting[count++] = 2 * node + (nearer ? 1 : 2);
    }
    return best.way;
}

/* A patch that is no rectangle: half_side is that of the box around it. */
static inline bool wall_is_uneven(const wall *l) {
    return l->def.kind == CLAST_WALL_PATCH && !l->is_rectangle;
}

/* Over a face to rounding: no crack where two triangles of a patch meet. */
static inline bool is_no_way(const wall *l, flat_way way) {
    double crack = wall_is_uneven(l) ? 1e-13 * l->bound : 0;
    return fabs(way.s) <= crack && fabs(way.t) <= crack;
}

/* m: farther inside a rectangle than this no other wall of its mesh holds the point. */
static inline double wall_rim(const wall *l) {
    return 1e-9 * l->bound;
}

static inline approach wall_approach(const wall *l, vec3 centre) {
    vec3 d = v3_sub(centre, l->point);
    double height = v3_dot(d, l->n);
    if (l->def.kind == CLAST_WALL_PLANE) return (approach){v3_scale(height, l->n), height, true};
    double s = v3_dot(d, l->u), t = v3_dot(d, l->v);
    flat_way way = {s - clamp(s, l->def.half_side[0]), t - clamp(t, l->def.half_side[1])};
    if (wall_is_uneven(l)) way = way_from_patch(&l->patch, s, t);
    if (is_no_way(l, way)) return (approach){v3_scale(height, l->n), fabs(height), true};
    vec3 away =
        v3_add(v3_scale(height, l->n), v3_add(v3_scale(way.s, l->u), v3_scale(way.t, l->v)));
    return (approach){away, v3_norm(away), false};
}

static inline bool are_in_one_plane(const wall *a, const wall *b) {
    return fabs(v3_dot(a->n, b->n)) > 1 - 1e-9;
}

static inline bool is_in_box(const wall *l, vec3 p, double more) {
    return fabs(p.x - l->point.x) <= l->half_box.x + more &&
           fabs(p.y - l->point.y) <= l->half_box.y + more &&
           fabs(p.z - l->point.z) <= l->half_box.z + more;
}

/* ---- what a sphere feels ---------------------------------------------------------------------
 * Of all walls that it touches. A wall of a mesh is a flat facet, and a sphere may touch several
 * that are one surface. */

typedef enum touch_state { TOUCH_UNKNOWN, TOUCH_OWN, TOUCH_BORDER } touch_state;

typedef struct wall_touch {
    const wall *wall;
    vec3 centre; /* m, of the sphere in its image at the wall */
    approach to;
    vec3 normal;       /* from the wall to the sphere */
    double overlap;    /* m; <= 0: apart */
    touch_state state; /* found out when it is asked for (facets.c) */
    bool hidden;
    bool raised; /* it is on a fillet, not on the plane of its facet */
} wall_touch;

/* A fillet stands no farther above the planes of its facets than this share of a sphere's radius,
 * or is narrowed until it does not. */
#define FILLET_RAISE 0.01

/* m, that a sphere may touch a wall before it touches the plane of it. */
static inline double wall_raise(const wall *l, double radius) {
    return l->fillets.count > 0 ? FILLET_RAISE * radius : 0;
}

/* Of a facet, where the foot of a sphere is on one of its fillets. */
typedef struct fillet_touch {
    vec3 normal;
    double height, overlap; /* m, of the centre over the plane; of the sphere and the fillet */
} fillet_touch;

/* fillet.c */
bool fillet_at(const wall *l, vec3 centre, double radius, fillet_touch *touch);

static inline wall_touch touch_of_wall(const wall *l, vec3 centre, double radius) {
    approach a = wall_approach(l, centre);
    wall_touch t = {
        .wall = l, .centre = centre, .to = a, .normal = l->n, .overlap = radius - a.distance};
    bool behind = l->def.kind != CLAST_WALL_PLANE && v3_dot(a.away, l->n) < 0;
    if (behind) t.normal = v3_scale(-1, l->n);
    if (!a.inside) t.normal = v3_scale(1 / a.distance, a.away);
    fillet_touch on;
    if (!(t.overlap > -wall_raise(l, radius)) || !fillet_at(l, centre, radius, &on)) return t;
    t.to = (approach){v3_scale(on.height, l->n), fabs(on.height), true};
    t.normal = on.normal, t.overlap = on.overlap, t.raised = true;
    return t;
}

/* The deeper of two; where they are equal, one that no order of walls decides about. */
static inline bool is_deeper(const wall_touch *a, const wall_touch *b) {
    if (a->overlap != b->overlap) return a->overlap > b->overlap;
    if (a->normal.x != b->normal.x) return a->normal.x > b->normal.x;
    if (a->normal.y != b->normal.y) return a->normal.y > b->normal.y;
    if (a->normal.z != b->normal.z) return a->normal.z > b->normal.z;
    return a->wall < b->wall;
}

/* Facets of one smooth patch whose normals differ by less than its angle are one surface. */
static inline bool are_one_surface(const wall_touch *a, const wall_touch *b) {
    return a->wall->smooth >= 0 && a->wall->smooth == b->wall->smooth &&
           v3_dot(a->normal, b->normal) > a->wall->smooth_cosine;
}

/* Whether `other`, which holds p, comes nearer to the centre than p close by: its nearest point is
 * not p or, where that is far away since a facet may be bent like a U, one step down the slope and
 * back onto the surface ends elsewhere. */
static inline bool leads_down(const wall *other, vec3 p, vec3 centre, const approach *theirs,
                              double size, double rounding) {
    double apart = v3_norm(v3_sub(v3_sub(centre, theirs->away), p));
    if (apart < 1e-3 * size) return apart > rounding;
    vec3 way = v3_sub(centre, p);
    vec3 slope = v3_sub(way, v3_scale(v3_dot(way, other->n), other->n));
    double length = v3_norm(slope), step = 1e-4 * size;
    vec3 ahead = v3_add(p, v3_scale(length > step ? step / length : 1, slope));
    vec3 back = v3_sub(ahead, wall_approach(other, ahead).away);
    return v3_norm(v3_sub(back, p)) > rounding;
}

/* A face before an edge before a corner, and among equals the wall that was added first. Two faces
 * in different planes are both felt. */
static inline bool is_border_of(const wall_touch *own, const wall_touch *other) {
    const wall *l = own->wall, *m = other->wall;
    if (own->to.inside && !(other->to.inside && are_in_one_plane(l, m))) return false;
    double size = l->bound + m->bound, rounding = 1e-9 * size;
    vec3 between = v3_sub(other->centre, own->centre); /* images */
    vec3 nearest = v3_add(v3_sub(own->centre, own->to.away), between);
    if (!is_in_box(m, nearest, rounding)) return false;
    if (wall_approach(m, nearest).distance > rounding) return false;
    bool face = other->to.inside && fabs(other->to.distance - own->to.distance) <= rounding;
    if (own->to.inside) return face && m < l;
    return face || m < l || leads_down(m, nearest, other->centre, &other->to, size, rounding);
}

/* facets.c */
void touches_settle(wall_touch *touch, size_t count);

#endif
