#include "meshes/make.h"
#include "meshes/shapes.h"
#include "meshes/vector.h"

#include <math.h>
#include <string.h>

static const double PI = 3.141592653589793;

/* A row of rings, each a polygon about its centre in the plane of u and v, whose normal u x v goes
 * along the pipe. */
typedef struct ring {
    double centre[3], u[3], v[3], radius;
} ring;

typedef struct pipe {
    mesh_surface *surface;
    int32_t segments, rings; /* rings are one more than pieces, but for a pipe without ends */
    bool endless;
    double stretch, thickness;
} pipe;

/* ---- vectors --------------------------------------------------------------------------------- */

static bool is_finite(const double a[3]) {
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

/* to - from as a direction; its length. */
static double direction(const double from[3], const double to[3], double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = to[k] - from[k];
    double length = sqrt(mesh_dot(out, out));
    for (int k = 0; k < 3; k++) out[k] /= length;
    return length;
}

/* A direction across another: the axis of the world that is farthest from it, turned upright. */
static void across(const double d[3], double out[3]) {
    int least = 0;
    for (int k = 1; k < 3; k++)
        if (fabs(d[k]) < fabs(d[least])) least = k;
    double axis[3] = {0, 0, 0}, zero[3] = {0, 0, 0}, upright[3];
    axis[least] = 1;
    for (int k = 0; k < 3; k++) upright[k] = axis[k] - d[least] * d[k];
    direction(zero, upright, out);
}

/* ---- rings and what is between them ---------------------------------------------------------- */

/* How much farther than on the circle the corners lie. */
static double stretch_of(mesh_fit fit, int segments) {
    double cosine, sine;
    if (fit == MESH_FIT_INSIDE) return 1;
    mesh_direction(fit == MESH_FIT_OUTSIDE ? PI / segments : 2 * PI / segments, &cosine, &sine);
    return fit == MESH_FIT_OUTSIDE ? 1 / cosine : sqrt(2 * PI / segments / sine);
}

static void place_ring(const pipe *p, int32_t number, const ring *r) {
    for (int shell = 0; shell < (p->thickness > 0 ? 2 : 1); shell++) {
        size_t first = (size_t)(shell * p->rings + number) * (size_t)p->segments;
        double radius = p->stretch * (r->radius + shell * p->thickness);
        for (int32_t i = 0; i < p->segments; i++) {
            double cosine, sine, *to = p->surface->vertex + 3 * (first + (size_t)i);
            mesh_direction(2 * PI * i / p->segments - PI, &cosine, &sine);
            for (int k = 0; k < 3; k++)
                to[k] = r->centre[k] + radius * (cosine * r->u[k] + sine * r->v[k]);
        }
    }
}

/* Between the polygons that start at a and at b, facing outwards when b is farther along. */
static int32_t *join(const pipe *p, int32_t *to, int32_t a, int32_t b) {
    for (int32_t i = 0; i < p->segments; i++) {
        int32_t next = (i + 1) % p->segments;
        to = mesh_put(to, a + i, a + next, b + i);
        to = mesh_put(to, a + next, b + next, b + i);
    }
    return to;
}

static void join_rings(const pipe *p) {
    int32_t *to = p->surface->triangle, n = p->segments, outer = p->rings * n;
    int32_t pieces = p->endless ? p->rings : p->rings - 1;
    for (int32_t k = 0; k < pieces; k++) {
        int32_t here = k * n, there = (k + 1) % p->rings * n;
        to = join(p, to, there, here);
        if (p->thickness > 0) to = join(p, to, outer + here, outer + there);
    }
    if (!(p->thickness > 0) || p->endless) return;
    to = join(p, to, 0, outer);
    join(p, to, 2 * outer - n, outer - n);
}

/* Room for the rings that are placed next. */
static mesh_status begin(pipe *p) {
    size_t pieces = (size_t)(p->endless ? p->rings : p->rings - 1), n = (size_t)p->segments;
    size_t shells = p->thickness > 0 ? 2 : 1, ends = p->thickness > 0 && !p->endless ? 2 : 0;
    bool good =
        mesh_allocate(p->surface, shells * (size_t)p->rings * n, 2 * n * (shells * pieces + ends));
    return good ? MESH_OK : MESH_ERR_MEMORY;
}

static const char *fault_of_pipe(double radius, double thickness, int segments, int rings) {
    if (!(radius > 0 && isfinite(radius))) return "the radius must be above 0";
    if (!(thickness >= 0 && isfinite(thickness))) return "the thickness must not be below 0";
    if (segments < 3) return "segments must be 3 or more";
    if (4.0 * segments * (rings + 2.0) > 1e8) return "more than 1e8 triangles";
    return NULL;
}

/* ---- tube ------------------------------------------------------------------------------------ */

mesh_status mesh_make_tube(const mesh_tube *t, mesh_surface *surface) {
    MESH_ASSERT(t && surface);
    *surface = (mesh_surface){0};
    double along[3], length = direction(t->from, t->to, along);
    const char *fault = fault_of_pipe(fmin(t->radius, t->end_radius), t->thickness, t->segments, 1);
    if (!fault && !(length > 0 && isfinite(length) && isfinite(t->radius + t->end_radius)))
        fault = "its ends must be apart";
    if (fault)
        return mesh_fail(MESH_ERR_ARGUMENT,
                         "tube of radius %g and %g m, length %g m, thickness %g m, %d segments: %s",
                         t->radius, t->end_radius, length, t->thickness, t->segments, fault);
    pipe p = {surface, t->segments, 2, false, stretch_of(t->fit, t->segments), t->thickness};
    mesh_status status = begin(&p);
    if (status != MESH_OK) return status;
    ring r = {.radius = t->radius};
    across(along, r.u);
    mesh_cross(along, r.u, r.v);
    memcpy(r.centre, t->from, sizeof r.centre);
    place_ring(&p, 0, &r);
    memcpy(r.centre, t->to, sizeof r.centre);
    r.radius = t->end_radius;
    place_ring(&p, 1, &r);
    join_rings(&p);
    return MESH_OK;
}

/* ---- bend ------------------------------------------------------------------------------------ */

/* The plane of the arc: from its centre to the mouth, and along the pipe there. */
typedef struct arc {
    double radius, out[3], along[3], axis[3];
} arc;

static arc arc_of(const mesh_bend *b) {
    static const double zero[3] = {0, 0, 0};
    arc a;
    a.radius = direction(b->centre, b->mouth, a.out);
    direction(zero, b->axis, a.axis);
    mesh_cross(a.axis, a.out, a.along);
    return a;
}

static const char *fault_of_bend(const mesh_bend *b, const arc *a) {
    const char *fault = fault_of_pipe(b->radius, b->thickness, b->segments, b->rings);
    if (fault) return fault;
    if (!is_finite(b->centre) || !is_finite(b->mouth) || !(b->radius + b->thickness < a->radius))
        return "the bending radius must be above pipe radius and thickness";
    if (!is_finite(a->axis) || !(fabs(mesh_dot(a->axis, a->out)) <= 1e-9))
        return "the axis must be at right angles to the way from the centre to the mouth";
    if (!(b->angle > 0 && b->angle <= 2 * PI)) return "the angle must be above 0, 2 pi at most";
    if (b->rings < (b->angle == 2 * PI ? 3 : b->angle >= PI ? 2 : 1))
        return "too few rings along the arc";
    return NULL;
}

static ring ring_at(const mesh_bend *b, const arc *a, double angle) {
    double cosine, sine;
    ring r = {.radius = b->radius};
    mesh_direction(angle - PI, &cosine, &sine); /* both with the other sign */
    for (int k = 0; k < 3; k++) {
        r.u[k] = -cosine * a->out[k] - sine * a->along[k];
        r.v[k] = -a->axis[k];
        r.centre[k] = b->centre[k] + a->radius * r.u[k];
    }
    return r;
}

mesh_status mesh_make_bend(const mesh_bend *b, mesh_surface *surface) {
    MESH_ASSERT(b && surface);
    *surface = (mesh_surface){0};
    arc a = arc_of(b);
    const char *fault = fault_of_bend(b, &a);
    if (fault)
        return mesh_fail(
            MESH_ERR_ARGUMENT,
            "bend of radius %g m about %g m, angle %g rad, thickness %g m, %d segments, "
            "%d rings: %s",
            b->radius, a.radius, b->angle, b->thickness, b->segments, b->rings, fault);
    bool endless = b->angle == 2 * PI;
    pipe p = {surface,
              b->segments,
              endless ? b->rings : b->rings + 1,
              endless,
              stretch_of(b->fit, b->segments),
              b->thickness};
    mesh_status status = begin(&p);
    if (status != MESH_OK) return status;
    for (int32_t k = 0; k < p.rings; k++) {
        ring r = ring_at(b, &a, b->angle * k / b->rings);
        place_ring(&p, k, &r);
    }
    join_rings(&p);
    return MESH_OK;
}
