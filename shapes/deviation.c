#include "shapes/deviation.h"

#include <stdlib.h>

#include "shapes/check.h"
#include "shapes/symmetry.h"

enum { DEPTH = 28 };

typedef struct piece {
    shape_vec corner[3];
    double sag; /* m, of the surface from the triangle, at most; HUGE_VAL when not known yet */
} piece;

typedef struct search {
    const shape_target *target;
    const shape_sphere *spheres;
    int *near;        /* for each depth, the spheres that may be nearest: room for all */
    size_t stride;    /* number of spheres */
    int axis;         /* of revolution, or -1 */
    double limit;     /* m, pieces whose bound is no larger are passed by */
    shape_vec *place; /* NULL: `limit` rises with what is found */
    int room, found;
} search;

double shape_deviation_error(const shape_target *t, double deviation) {
    SHAPE_ASSERT(t && deviation >= 0);
    return 1e-3 * deviation + 1e-5 * t->size;
}

double shape_deviation_least(const shape_target *t) {
    SHAPE_ASSERT(t);
    return 1e-4 * t->size;
}

static double longest_side(const piece *p) {
    double longest = 0;
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, sv_distance(p->corner[k], p->corner[(k + 1) % 3]));
    return longest;
}

/* Halfway round and halfway out, so that the rim of a body of revolution is followed. */
static shape_vec turned_middle(shape_vec a, shape_vec b, int axis) {
    double p[3] = {a.x, a.y, a.z}, q[3] = {b.x, b.y, b.z}, m[3];
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int k = 0; k < 3; k++) m[k] = 0.5 * (p[k] + q[k]);
    double rho = sqrt(m[u] * m[u] + m[v] * m[v]);
    double wanted = 0.5 * (sqrt(p[u] * p[u] + p[v] * p[v]) + sqrt(q[u] * q[u] + q[v] * q[v]));
    if (rho > 1e-3 * wanted) m[u] *= wanted / rho, m[v] *= wanted / rho;
    return sv(m[0], m[1], m[2]);
}

/* The middle of a side, on the surface; *sag grows to how far that is from the chord. Between two
 * points of a profile the surface is a cone, on which the turned middle lies. */
static shape_vec middle_of(const search *s, shape_vec a, shape_vec b, double *sag) {
    shape_vec chord = sv_scale(0.5, sv_add(a, b)), at = chord;
    if (s->target->source == SHAPE_FROM_MESH) return chord;
    if (s->axis >= 0) at = turned_middle(a, b, s->axis);
    if (s->target->source == SHAPE_FROM_SOLID) shape_target_distance(s->target, at, &at, NULL);
    *sag = fmax(*sag, sv_distance(at, chord));
    return at;
}

static double clipped(double d) {
    return d > 0 ? d : 0;
}

/* Upper bound over the triangle, and the farthest corner with its distance. Keeps at `depth` + 1
 * the spheres that can be nearest to a place of it. */
static double bound_of(const search *s, const piece *p, int depth, int *count, double *most,
                       shape_vec *at) {
    const int *from = s->near + (size_t)depth * s->stride;
    int *to = s->near + (size_t)(depth + 1) * s->stride, kept = 0;
    double least[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, bound = HUGE_VAL, side = longest_side(p);
    for (int i = 0; i < *count; i++) {
        const shape_sphere *one = &s->spheres[from[i]];
        double farthest = 0, nearest = HUGE_VAL;
        for (int k = 0; k < 3; k++) {
            double d = sv_distance(p->corner[k], one->centre) - one->radius;
            farthest = fmax(farthest, d), nearest = fmin(nearest, d);
            least[k] = fmin(least[k], d);
        }
        if (nearest - side - p->sag > bound) continue; /* another is nearer wherever we are */
        bound = fmin(bound, farthest);
        to[kept++] = from[i];
    }
    *count = kept, *most = -1;
    for (int k = 0; k < 3; k++)
        if (clipped(least[k]) > *most) *most = clipped(least[k]), *at = p->corner[k];
    return bound + p->sag;
}

static void visit(search *s, const piece *p, int depth, int count);

static void visit_quarters(search *s, const piece *p, int depth, int count) {
    const shape_vec *c = p->corner;
    double sag = 0;
    shape_vec m[3];
    for (int k = 0; k < 3; k++) m[k] = middle_of(s, c[k], c[(k + 1) % 3], &sag);
    const piece quarters[4] = {{{m[0], m[1], m[2]}, sag},
                               {{c[0], m[0], m[2]}, sag},
                               {{c[1], m[1], m[0]}, sag},
                               {{c[2], m[2], m[1]}, sag}};
    for (int k = 0; k < 4; k++) visit(s, &quarters[k], depth + 1, count);
}

/* Where one place is beyond the limit, those beside it are too: they are filled with it. */
static bool is_beside_another(const search *s, shape_vec at) {
    for (int i = 0; i < s->found; i++)
        if (sv_distance(s->place[i], at) < s->limit) return true;
    return false;
}

/* A place is noted once its piece is small, or all would be in one corner of the first. True: the
 * piece is done with. */
static bool is_noted(search *s, const piece *p, double most, shape_vec at, int depth) {
    bool beyond = most > s->limit - shape_deviation_error(s->target, s->limit);
    bool small = longest_side(p) < 0.5 * s->limit || depth == DEPTH;
    if (!small || !(beyond || depth == DEPTH)) return false;
    if (!is_beside_another(s, at)) s->place[s->found++] = at;
    return true;
}

static void visit(search *s, const piece *p, int depth, int count) {
    if (s->place && s->found == s->room) return;
    double most;
    shape_vec at = p->corner[0];
    double bound = bound_of(s, p, depth, &count, &most, &at);
    if (!s->place) s->limit = fmax(s->limit, most);
    double slack = s->place ? 0 : shape_deviation_error(s->target, s->limit);
    if (bound <= s->limit + slack) return;
    if (s->place && is_noted(s, p, most, at, depth)) return;
    if (depth < DEPTH) visit_quarters(s, p, depth, count);
}

static void search_all(search *s, int count) {
    s->stride = (size_t)count;
    s->near = malloc((DEPTH + 2) * s->stride * sizeof *s->near);
    SHAPE_ASSERT(s->near);
    for (int i = 0; i < count; i++) s->near[i] = i;
    if (!shape_has_axis(s->target, &s->axis)) s->axis = -1;
    for (size_t i = 0; i < s->target->surface.triangle_count; i++) {
        piece root = {.sag = s->target->source == SHAPE_FROM_MESH ? 0 : HUGE_VAL};
        shape_mesh_corners(&s->target->surface, i, root.corner);
        visit(s, &root, 0, count);
    }
    free(s->near);
}

double shape_deviation_max(const shape_target *t, const shape_sphere *spheres, int count) {
    SHAPE_ASSERT(t && spheres && count >= 1);
    search s = {.target = t, .spheres = spheres};
    search_all(&s, count);
    return s.limit;
}

int shape_places_beyond(const shape_target *t, const shape_sphere *spheres, int count, double limit,
                        shape_vec *place, int room) {
    SHAPE_ASSERT(t && spheres && count >= 1 && limit > 0 && place && room >= 1);
    search s = {.target = t, .spheres = spheres, .limit = limit, .place = place, .room = room};
    search_all(&s, count);
    return s.found;
}
