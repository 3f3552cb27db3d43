/* part.h - where a part is: its frame, in which its walls never move. Private to engine/. */
#ifndef CLAST_ENGINE_PART_H
#define CLAST_ENGINE_PART_H

#include "engine/periodic.h"

/* part.c */
part_place part_at(const part *p, double time);
bool part_is_running(const clast_part_def *d, double time);
quat part_turn(const part *p, double angle);
double part_speed_bound(const part *p, double reach);
bool part_is_flat(const clast_world *w, const part *p);
void parts_free(clast_world *w);

/* Directions and places from the frame of the part, where walls stand as at t = 0 of a part that
 * has not moved, to the world now; and back. */
static inline vec3 part_direction(const part *p, vec3 a) {
    return p->turns ? m3_apply(&p->turn, a) : a;
}

static inline vec3 part_direction_back(const part *p, vec3 a) {
    return p->turns ? m3_apply_transposed(&p->turn, a) : a;
}

static inline vec3 part_out(const part *p, vec3 x) {
    if (!p->turns) return v3_add(x, p->at.offset);
    vec3 arm = m3_apply(&p->turn, v3_sub(x, p->def.rotation.point));
    return v3_add(v3_add(p->def.rotation.point, p->at.offset), arm);
}

static inline vec3 part_in(const part *p, vec3 x) {
    vec3 moved = v3_sub(x, p->at.offset);
    if (!p->turns) return moved;
    vec3 arm = m3_apply_transposed(&p->turn, v3_sub(moved, p->def.rotation.point));
    return v3_add(p->def.rotation.point, arm);
}

/* m that the lists must allow for its walls since it was there. */
static inline double part_way(const part *p, const part_place *was) {
    double turn = fabs(p->at.angle - was->angle);
    return v3_norm(v3_sub(p->at.offset, was->offset)) +
           turn * (p->lever + p->tilt * v3_norm(p->at.offset));
}

/* Where its axis stands now. */
static inline vec3 part_pivot(const part *p) {
    return v3_add(p->def.rotation.point, p->at.offset);
}

/* Adds what a belt or a wall that turns does to a body at that sphere beside its force: by the
 * force (N) and the couple about the centre of mass (N m). Kernel frame. */
static inline void part_add_drive(const clast_world *w, part_sums *s, const wall *l, size_t sphere,
                                  vec3 force, vec3 couple) {
    sum_add(&s->belt, &w->belt_scale, v3_dot(force, to_kernel(w, l->belt)));
    const part *p = &w->parts[l->part];
    if (!p->turns) return;
    vec3 centre = from_kernel(w, centre_at(&w->rows.centre[sphere]));
    vec3 arm = to_kernel(w, v3_sub(image_at_wall(w, l, centre), part_pivot(p)));
    if (w->special.clumps) {
        const double *out = w->rows.arm[sphere].arm;
        arm = v3_sub(arm, v3(out[0], out[1], out[2]));
    }
    vec3 moment = v3_add(v3_cross(arm, force), couple);
    sum_add(&s->moment, &w->moment_scale, v3_dot(to_kernel(w, p->axis), moment));
}

#endif
