/* geometry.h - where a sphere meets a wall. Shared by the pair list and the contact kernel. */
#ifndef CLAST_GEOMETRY_H
#define CLAST_GEOMETRY_H

#include "engine/world.h"

/* Nearest point of the wall, as the vector from it to the centre. `inside`: over the face of a
 * plate. */
typedef struct approach {
    vec3 away;       /* m, from the nearest point to the centre; for planes along +normal */
    double distance; /* m, signed for planes */
    bool inside;
} approach;

static inline double clamp(double x, double limit) {
    return x > limit ? limit : x < -limit ? -limit : x;
}

static inline approach wall_approach(const wall *l, vec3 centre) {
    vec3 d = v3_sub(centre, l->point);
    double height = v3_dot(d, l->n);
    if (l->def.kind == CLAST_WALL_PLANE)
        return (approach){v3_scale(height, l->n), height, true};
    double s = v3_dot(d, l->u), t = v3_dot(d, l->v);
    double ds = s - clamp(s, l->def.half_side[0]), dt = t - clamp(t, l->def.half_side[1]);
    vec3 away = v3_add(v3_scale(height, l->n), v3_add(v3_scale(ds, l->u), v3_scale(dt, l->v)));
    return (approach){away, v3_norm(away), ds == 0 && dt == 0};
}

/* Where coplanar plates share a border or overlap, one of them is felt: a face before an edge, and
 * among equals the one that was added first. */
static inline bool is_hidden(const clast_world *w, const wall *l, vec3 centre, const approach *a) {
    vec3 nearest = v3_sub(centre, a->away);
    for (int i = 0; i < l->coplanar_count; i++) {
        const wall *other = &w->walls[l->coplanar[i]];
        if (!w->parts[other->part].present) continue;
        vec3 d = v3_sub(nearest, other->point);
        double tolerance = 1e-9 * (other->def.half_side[0] + other->def.half_side[1]);
        bool covers = fabs(v3_dot(d, other->u)) <= other->def.half_side[0] + tolerance &&
                      fabs(v3_dot(d, other->v)) <= other->def.half_side[1] + tolerance &&
                      fabs(v3_dot(d, other->n)) <= tolerance;
        if (!covers) continue;
        bool face = wall_approach(other, centre).inside;
        if (face == a->inside ? other < l : face) return true;
    }
    return false;
}

/* One contact as the law sees it. The normal points from b to a; the contact point is in the middle
 * of the overlap; arms lead to it from the centres of mass. */
typedef struct touch {
    vec3 normal, arm_a, arm_b;
    double overlap; /* m; <= 0: apart */
} touch;

static inline touch touch_of_spheres(const clast_world *w, const pair *p, int32_t sa, int32_t sb) {
    const sphere_store *s = &w->spheres;
    vec3 xa = v3(s->x[sa], s->y[sa], s->z[sa]), xb = v3(s->x[sb], s->y[sb], s->z[sb]);
    vec3 d = v3_sub(xa, xb);
    double distance = v3_norm(d);
    touch t = {.overlap = s->radius[sa] + s->radius[sb] - distance};
    t.normal = v3_scale(1 / distance, d);
    vec3 point = v3_sub(xa, v3_scale(s->radius[sa] - 0.5 * t.overlap, t.normal));
    t.arm_a = v3_sub(point, body_position(w, (size_t)p->a));
    t.arm_b = v3_sub(point, body_position(w, (size_t)p->b));
    return t;
}

static inline touch touch_of_wall(const clast_world *w, const pair *p, int32_t sa) {
    const sphere_store *s = &w->spheres;
    const wall *l = &w->walls[-1 - p->b];
    vec3 xa = v3(s->x[sa], s->y[sa], s->z[sa]);
    approach a = wall_approach(l, xa);
    touch t = {.overlap = s->radius[sa] - a.distance};
    t.normal = l->def.kind == CLAST_WALL_PLANE ? l->n : v3_scale(1 / a.distance, a.away);
    if (t.overlap > 0 && l->coplanar_count > 0 && is_hidden(w, l, xa, &a)) t.overlap = 0;
    vec3 point = v3_sub(xa, v3_scale(s->radius[sa] - 0.5 * t.overlap, t.normal));
    t.arm_a = v3_sub(point, body_position(w, (size_t)p->a));
    return t;
}

static inline touch touch_of(const clast_world *w, const pair *p, size_t candidate_index) {
    const candidate_store *c = &w->list.candidates;
    if (p->b < 0) return touch_of_wall(w, p, c->a[candidate_index]);
    return touch_of_spheres(w, p, c->a[candidate_index], c->b[candidate_index]);
}

/* Adds a contact's force to its pair; the order of adding is that of the candidates. */
static inline void pair_force_add(pair_force *f, const touch *t, vec3 force) {
    f->force = v3_add(f->force, force);
    f->torque_a = v3_add(f->torque_a, v3_cross(t->arm_a, force));
    f->torque_b = v3_sub(f->torque_b, v3_cross(t->arm_b, force));
    f->touching++;
}

#endif
