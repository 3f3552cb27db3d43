/* union_arcs.c - moments of a union of spheres from the arcs that bound the exposed part of each.
 *
 * For the unit sphere about a centre, with n the direction on it, the exposed part P is what no cap
 * of a neighbour covers. From its area A and line integrals along its bounding arcs (nu: outward,
 * in the sphere, across the arc) follow, by the divergence theorem on the sphere,
 *
 *     N_i   = int n_i         = -1/2 oint nu_i
 *     T_ij  = int n_i n_j     = (A delta_ij - oint n_i nu_j) / 3
 *     Q_ijk = int n_i n_j n_k = (delta_ik N_j + delta_jk N_i - oint n_i n_j nu_k) / 4
 *
 * and from these the flux of x, x_k x and x_k x_l x through the sphere's share of the surface,
 * whose divergence is 3, 4 x_k and 5 x_k x_l. The area is the integral of (1 - cos theta) d phi
 * about a pole opposite to a covered place: a triangle to the pole for each arc, and the segment
 * between the arc and its chord. */
#include "shapes/union.h"

#include <stdlib.h>
#include <string.h>

#include "shapes/check.h"
#include "shapes/numbers.h"

enum { PIECES = 3 }; /* an arc is cut so that no triangle has a side near half a circle */

static const double ROUNDING = 16 * 0x1p-52;

typedef struct cap {
    shape_vec axis;
    double cosine, sine; /* of its radius; n is covered where n . axis > cosine */
} cap;

typedef struct span {
    double from, to; /* rad, 0 <= from <= to <= 2 pi */
    double doubt;    /* rad, of its ends */
} span;

typedef struct patch {
    double area;
    shape_vec normal;    /* N */
    double second[3][3]; /* T, before the area is put in: - oint n nu */
    double third[3][3];  /* oint n n (nu . c) */
    double doubt;        /* of the area, by rounding */
} patch;

typedef struct work {
    cap *caps;
    span *spans;
    int cap_count, span_count;
    double amplify; /* how a gap between arcs counts in the area */
    shape_vec pole, centre;
} work;

/* ---- which arcs of a circle are exposed --------------------------------------------------------
 */

static void add_span(work *w, double middle, double half, double doubt) {
    double from = middle - half, to = middle + half;
    if (from < 0) from += 2 * SHAPE_PI, to += 2 * SHAPE_PI;
    if (to <= 2 * SHAPE_PI) {
        w->spans[w->span_count++] = (span){from, to, doubt};
        return;
    }
    w->spans[w->span_count++] = (span){from, 2 * SHAPE_PI, doubt};
    w->spans[w->span_count++] = (span){0, to - 2 * SHAPE_PI, doubt};
}

/* What cap k covers of the circle of cap j: an interval about the direction of k. Returns false
 * when that is all of it. Both circles of a pair are cut by a plane through their common points,
 * n . (axis k -+ axis j) = cosine k -+ cosine j, whose numbers are small where circles all but
 * coincide, and lose nothing by rounding: so they still meet in the same two points. */
static bool cover(work *w, const cap *j, const cap *k, shape_vec e1, shape_vec e2, bool behind) {
    double side = sv_dot(k->axis, j->axis) < 0 ? 1 : -1, level = k->cosine + side * j->cosine;
    shape_vec apart = sv_along(k->axis, side, j->axis);
    double x = sv_dot(apart, e1), y = sv_dot(apart, e2), z = j->cosine * sv_dot(apart, j->axis);
    double across = j->sine * sqrt(x * x + y * y), above = level - z;
    if (across == 0) return !(above < 0 || (above == 0 && behind));
    double cosine = above / across;
    if (cosine >= 1) return true;
    if (cosine <= -1) return false;
    double half = shape_acos(cosine);
    double terms = fabs(level) + fabs(z) + j->sine * sv_norm(apart);
    double doubt = ROUNDING * (1 + terms / (across * sqrt((1 - cosine) * (1 + cosine))));
    add_span(w, shape_atan2(y, x), half, doubt);
    return true;
}

static int compare_spans(const void *a, const void *b) {
    const span *p = a, *q = b;
    return p->from < q->from ? -1 : p->from > q->from ? 1 : 0;
}

/* ---- what an arc adds --------------------------------------------------------------------------
 */

/* Signed area of the spherical triangle of three directions. */
static double triangle(shape_vec a, shape_vec b, shape_vec c) {
    double volume = sv_dot(a, sv_cross(b, c));
    return 2 * shape_atan2(volume, 1 + sv_dot(a, b) + sv_dot(b, c) + sv_dot(c, a));
}

/* Integrals of products of cos and sin over an arc. */
typedef struct powers {
    double one, c, s, cc, cs, ss, ccc, ccs, css, sss;
} powers;

static powers powers_of(double angle, double c0, double s0, double c1, double s1) {
    powers p = {.one = angle, .c = s1 - s0, .s = c0 - c1};
    double turn = s1 * c1 - s0 * c0;
    p.cc = 0.5 * (angle + turn);
    p.ss = 0.5 * (angle - turn);
    p.cs = 0.5 * (s1 - s0) * (s1 + s0);
    double s3 = (s1 * s1 * s1 - s0 * s0 * s0) / 3, c3 = (c1 * c1 * c1 - c0 * c0 * c0) / 3;
    p.ccc = p.c - s3;
    p.css = s3;
    p.ccs = -c3;
    p.sss = p.s + c3;
    return p;
}

/* n = c u + s w, nu = s u - c w, w = e1 cos + e2 sin, length s d phi. */
static void add_integrals(patch *to, const cap *j, shape_vec e1, shape_vec e2, const powers *p,
                          shape_vec centre) {
    shape_vec u = j->axis;
    double c = j->cosine, s = j->sine;
    shape_vec w = sv_add(sv_scale(p->c, e1), sv_scale(p->s, e2));
    shape_vec nu = sv_sub(sv_scale(s * p->one, u), sv_scale(c, w));
    to->normal = sv_along(to->normal, -0.5 * s, nu);
    /* n nu, made symmetric: its other half vanishes over a closed curve */
    shape_second_add(to->second, -s * c * s * p->one, u, u);
    shape_second_add(to->second, -s * (s * s - c * c), u, w);
    shape_second_add(to->second, s * s * c * p->cc, e1, e1);
    shape_second_add(to->second, s * s * c * p->ss, e2, e2);
    shape_second_add(to->second, 2 * s * s * c * p->cs, e1, e2);
    /* n n (nu . centre) with nu . centre = q + a cos + b sin */
    double q = s * sv_dot(u, centre), a = -c * sv_dot(e1, centre), b = -c * sv_dot(e2, centre);
    double w1 = q * p->c + a * p->cc + b * p->cs, w2 = q * p->s + a * p->cs + b * p->ss;
    shape_second_add(to->third, s * c * c * (q * p->one + a * p->c + b * p->s), u, u);
    shape_second_add(to->third, 2 * s * s * c, u, sv_add(sv_scale(w1, e1), sv_scale(w2, e2)));
    shape_second_add(to->third, s * s * s * (q * p->cc + a * p->ccc + b * p->ccs), e1, e1);
    shape_second_add(to->third, s * s * s * (q * p->ss + a * p->css + b * p->sss), e2, e2);
    shape_second_add(to->third, 2 * s * s * s * (q * p->cs + a * p->ccs + b * p->css), e1, e2);
}

static shape_vec on_circle(const cap *j, shape_vec e1, shape_vec e2, double c, double s) {
    shape_vec w = sv_add(sv_scale(c, e1), sv_scale(s, e2));
    return sv_add(sv_scale(j->cosine, j->axis), sv_scale(j->sine, w));
}

static void add_piece(patch *to, const work *w, const cap *j, shape_vec e1, shape_vec e2,
                      double from, double angle) {
    double c0, s0, c1, s1;
    shape_sincos(from, &s0, &c0);
    shape_sincos(from + angle, &s1, &c1);
    powers p = powers_of(angle, c0, s0, c1, s1);
    add_integrals(to, j, e1, e2, &p, w->centre);
    shape_vec a = on_circle(j, e1, e2, c0, s0), b = on_circle(j, e1, e2, c1, s1);
    double flat = j->sine * j->sine / (1 + j->cosine); /* 1 - cosine, without cancelling */
    if (j->cosine < 0) flat = 1 - j->cosine;
    double under = triangle(w->pole, a, b) - triangle(j->axis, a, b) + flat * angle;
    to->area -= under; /* the exposed side lies to the right */
    to->doubt += 4 * ROUNDING;
}

static void add_arc(patch *to, const work *w, const cap *j, shape_vec e1, shape_vec e2, double from,
                    double angle, double doubt) {
    for (int i = 0; i < PIECES; i++)
        add_piece(to, w, j, e1, e2, from + i * (angle / PIECES), angle / PIECES);
    to->doubt += doubt * j->sine * (1 + w->amplify);
}

/* The exposed arcs of the circle of cap j. */
static void add_circle(patch *to, work *w, int at) {
    const cap *j = &w->caps[at];
    shape_vec e1, e2;
    sv_frame(j->axis, &e1, &e2);
    w->span_count = 0;
    for (int k = 0; k < w->cap_count; k++)
        if (k != at && !cover(w, j, &w->caps[k], e1, e2, k < at)) return;
    qsort(w->spans, (size_t)w->span_count, sizeof *w->spans, compare_spans);
    double reached = 0, doubt = 0;
    for (int i = 0; i < w->span_count; i++) {
        const span *next = &w->spans[i];
        if (next->from > reached)
            add_arc(to, w, j, e1, e2, reached, next->from - reached, doubt + next->doubt);
        if (next->to > reached) reached = next->to, doubt = next->doubt;
    }
    if (reached < 2 * SHAPE_PI) add_arc(to, w, j, e1, e2, reached, 2 * SHAPE_PI - reached, doubt);
}

/* ---- a sphere
 * ------------------------------------------------------------------------------------ */

/* False when a neighbour covers all of the sphere. */
static bool find_caps(work *w, const shape_sphere *spheres, int count, int i) {
    const shape_sphere *own = &spheres[i];
    w->cap_count = 0;
    for (int j = 0; j < count; j++) {
        shape_vec arm = sv_sub(spheres[j].centre, own->centre);
        double d = sv_norm(arm), r = own->radius, other = spheres[j].radius;
        if (j == i || d >= r + other) continue;
        double cosine = (d * d + (r - other) * (r + other)) / (2 * d * r);
        if (cosine >= 1) continue; /* shaken out of reach, or inside this one */
        if (cosine <= -1) return false;
        w->caps[w->cap_count++] =
            (cap){sv_scale(1 / d, arm), cosine, sqrt((1 - cosine) * (1 + cosine))};
    }
    return true;
}

static const cap *widest(const work *w) {
    const cap *best = &w->caps[0];
    for (int k = 1; k < w->cap_count; k++)
        if (w->caps[k].cosine < best->cosine) best = &w->caps[k];
    return best;
}

static patch patch_of(work *w) {
    patch p = {.area = 4 * SHAPE_PI};
    if (w->cap_count == 0) return p;
    const cap *wide = widest(w);
    p.area = 0;
    w->pole = sv_scale(-1, wide->axis);
    w->amplify = wide->sine / (1 - wide->cosine);
    for (int k = 0; k < w->cap_count; k++) add_circle(&p, w, k);
    /* whole spheres come in by the triangles: the area lies in [0, 4 pi - widest cap] */
    double most = 4 * SHAPE_PI - SHAPE_PI * (1 - wide->cosine);
    p.area -= 4 * SHAPE_PI * floor(p.area / (4 * SHAPE_PI));
    if (p.area > most) p.area -= 4 * SHAPE_PI;
    return p;
}

/* The flux of x, x_k x and x_k x_l x through the patch; c from the centre of reference. */
static void add_patch(shape_moments *m, const patch *p, shape_vec c, double r) {
    double t[3][3], third[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            t[i][j] = (p->second[i][j] + (i == j ? p->area : 0)) / 3;
            third[i][j] = -0.25 * p->third[i][j];
        }
    shape_second_add(third, 0.5, c, p->normal);
    shape_vec tc = sv(t[0][0] * c.x + t[0][1] * c.y + t[0][2] * c.z,
                      t[1][0] * c.x + t[1][1] * c.y + t[1][2] * c.z,
                      t[2][0] * c.x + t[2][1] * c.y + t[2][2] * c.z);
    double out = sv_dot(c, p->normal) + r * p->area;
    m->volume += r * r / 3 * out;
    shape_vec first = sv_add(sv_scale(out, c), sv_scale(r, tc));
    m->first = sv_along(m->first, r * r / 4, sv_along(first, r * r, p->normal));
    double f = r * r / 5;
    shape_second_add(m->second, f * out, c, c);
    shape_second_add(m->second, 2 * f * r, c, tc);
    shape_second_add(m->second, 2 * f * r * r, c, p->normal);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m->second[i][j] += f * (r * r * third[i][j] + r * r * r * t[i][j]);
}

/* Moves and grows every sphere at random by no more than `by`. */
static void shake(shape_sphere *to, const shape_sphere *from, int count, double by) {
    for (int i = 0; i < count; i++) {
        double d[4];
        for (int k = 0; k < 4; k++) d[k] = 2 * shape_random(17, 4 * (uint64_t)i + (uint64_t)k) - 1;
        to[i].centre = sv_along(from[i].centre, 0.57 * by, sv(d[0], d[1], d[2])); /* < 1 / sqrt 3 */
        to[i].radius = from[i].radius + by * d[3];
    }
}

static shape_vec middle_of(const shape_sphere *spheres, int count) {
    shape_vec sum = {0, 0, 0};
    double weight = 0;
    for (int i = 0; i < count; i++) {
        double w = spheres[i].radius * spheres[i].radius * spheres[i].radius;
        sum = sv_along(sum, w, spheres[i].centre);
        weight += w;
    }
    return sv_scale(1 / weight, sum);
}

static shape_moments sum_patches(const shape_sphere *spheres, int count, double *doubtful,
                                 double reach) {
    shape_moments m = {.about = middle_of(spheres, count)};
    work w = {.caps = malloc((size_t)count * sizeof *w.caps),
              .spans = malloc(2 * (size_t)count * sizeof *w.spans)};
    SHAPE_ASSERT(w.caps && w.spans);
    for (int i = 0; i < count; i++) {
        double r = spheres[i].radius;
        w.centre = sv_sub(spheres[i].centre, m.about);
        if (!find_caps(&w, spheres, count, i)) continue;
        patch p = patch_of(&w);
        add_patch(&m, &p, w.centre, r);
        *doubtful += r * r * reach * (p.doubt + 4 * ROUNDING);
    }
    free(w.caps), free(w.spans);
    return m;
}

shape_mass shape_arcs_mass(const shape_sphere *spheres, int count) {
    shape_sphere *shaken = malloc((size_t)count * sizeof *shaken);
    SHAPE_ASSERT(shaken && count >= 1);
    double largest = 0;
    for (int i = 0; i < count; i++) largest = fmax(largest, spheres[i].radius);
    double by = 1e-11 * largest;
    shake(shaken, spheres, count, by);
    double reach = shape_spheres_reach(spheres, count, middle_of(spheres, count)) + 2 * by;
    double doubtful = 2 * by * shape_spheres_area(spheres, count, 2 * by);
    shape_moments m = sum_patches(shaken, count, &doubtful, reach);
    free(shaken);
    return shape_mass_of(&m, doubtful, reach);
}
