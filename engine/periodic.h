/* periodic.h - places in a domain that repeats itself along some axes (S12 2.8.3): opposite faces
 * are one. No pair of bodies and no list knows of images. A difference of two places is taken to
 * their nearest images wherever it is used, which is a function of the places alone: histories
 * cross a face in their lists, and nothing is sent, copied or named twice. That there is one image
 * only in which two bodies can touch is a demand on the length of the domain (periodic.c).
 * Rejected: an image per pair in the lists (read in every step, and wrong as soon as one of the two
 * comes back at the other face), and ghosts (a tenth to a half more spheres in a cell a few bodies
 * wide, and their loads to be brought back). */
#ifndef CLAST_PERIODIC_H
#define CLAST_PERIODIC_H

#include "engine/world_data.h"

/* periodic.c */
void period_choose(clast_world *w);
clast_status period_check(clast_world *w);
vec3 body_wrap(clast_world *w, size_t slot, exact_sum *unwrapped);
bool bodies_wrap(clast_world *w, size_t begin, size_t end, exact_sum *unwrapped);

/* Along one axis, m; changes its sign exactly with d. Places are those of bodies, or of spheres of
 * clumps, inside the domain: |d| is below 1.5 lengths. */
CLAST_INLINE static inline double nearest_along(double d, double length, double half) {
    double over = d > half ? length : 0, under = d < -half ? length : 0;
    return d - (over - under);
}

CLAST_INLINE static inline vec3 nearest_image(const period *p, vec3 d) {
    return v3(nearest_along(d.x, p->length[0], p->half[0]),
              nearest_along(d.y, p->length[1], p->half[1]),
              nearest_along(d.z, p->length[2], p->half[2]));
}

/* The same where there may be no axis to look at. */
static inline vec3 separation(const period *p, vec3 a, vec3 b) {
    vec3 d = v3_sub(a, b);
    return p->any ? nearest_image(p, d) : d;
}

/* Whole lengths in a distance along one axis, so that what is left is half a length at most; what
 * is no number, or beyond any count, has none. */
static inline double lengths_in(double d, double length) {
    if (!(length > 0) || !(fabs(d) < 1e9 * length)) return 0;
    double n = floor(d / length + 0.5), rest = d - n * length;
    return rest > 0.5 * length ? n + 1 : rest < -0.5 * length ? n - 1 : n;
}

/* What has to be taken off a place for its image nearest to an anchor: walls may stand anywhere. */
static inline vec3 way_to_image(const period *p, vec3 anchor, vec3 place) {
    const double *length = p->length;
    vec3 d = v3_sub(place, anchor);
    return v3(length[0] * lengths_in(d.x, length[0]), length[1] * lengths_in(d.y, length[1]),
              length[2] * lengths_in(d.z, length[2]));
}

static inline vec3 image_at_wall(const clast_world *w, const wall *l, vec3 place) {
    return w->period.any ? v3_sub(place, way_to_image(&w->period, l->anchor, place)) : place;
}

#endif
