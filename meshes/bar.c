#include "meshes/make.h"
#include "meshes/shapes.h"

#include <math.h>

static const double RIGHT_ANGLE = 1.5707963267948966;

enum { PROFILE_MAX = 1000 + 8 };

/* The outline in x and z, counter-clockwise, from the back end of the underside. */
typedef struct profile {
    int count;
    double at[PROFILE_MAX][2];
} profile;

mesh_bar mesh_bar_default(void) {
    return (mesh_bar){
        .length = 0.19, .height = 0.03, .width = 1, .nose_radius = 0.005, .segments = 8};
}

static void add(profile *p, double x, double z) {
    MESH_ASSERT(p->count < PROFILE_MAX);
    p->at[p->count][0] = x, p->at[p->count++][1] = z;
}

/* From the top of the rounding to where the front begins: in x from its start, in z downwards. */
static void rounding(const mesh_bar *b, double turned, double *along, double *down) {
    double cosine, sine;
    mesh_direction(turned, &cosine, &sine);
    *along = b->nose_radius * sine;
    *down = b->nose_radius * (1 - cosine);
}

/* The nose with the start of its rounding at x = 0; returns its foremost x. */
static double add_nose(const mesh_bar *b, profile *p) {
    double turn = RIGHT_ANGLE + b->nose_angle, cosine, sine, along, down;
    mesh_direction(b->nose_angle, &cosine, &sine);
    rounding(b, turn, &along, &down);
    double foot = along - (b->height - down - b->undercut) * sine / cosine;
    if (b->undercut > 0) add(p, foot - b->undercut, 0);
    add(p, foot, b->undercut);
    int segments = b->nose_radius > 0 ? b->segments : 1;
    for (int i = segments; i > 0 && b->nose_radius > 0; i--) {
        rounding(b, turn * i / segments, &along, &down);
        add(p, along, b->height - down);
    }
    add(p, 0, b->height);
    return b->nose_angle >= 0 ? b->nose_radius : foot;
}

static void draw_profile(const mesh_bar *b, profile *p) {
    add(p, 0, 0);
    double front = add_nose(b, p);
    for (int i = 1; i < p->count; i++) p->at[i][0] -= front;
    p->at[0][0] = -b->length;
    add(p, -b->length, b->height);
}

/* Any other profile is convex. */
static const char *fault_of(const mesh_bar *b) {
    if (!(b->length > 0 && b->height > 0 && b->width > 0) ||
        !isfinite(b->length + b->height + b->width))
        return "length, height and width must be above 0";
    if (!(b->nose_radius >= 0 && b->undercut >= 0))
        return "nose radius and undercut must not be below 0";
    if (!(fabs(b->nose_angle) <= 1)) return "the nose angle must be in [-1, 1] rad";
    if (b->segments < 1 || b->segments > 1000) return "segments must be in [1, 1000]";
    double along, down;
    rounding(b, RIGHT_ANGLE + b->nose_angle, &along, &down);
    if (!(down + b->undercut < b->height))
        return "nose radius and undercut leave nothing of the front";
    return NULL;
}

static bool is_short(const mesh_bar *b, const profile *p) {
    double back = fmin(p->at[1][0], p->at[p->count - 2][0]);
    return !(back > -b->length);
}

/* Vertices of the side at -width / 2 first, then those of the other. */
static void extrude(const mesh_bar *b, const profile *p, mesh_surface *s) {
    int32_t n = p->count, *to = s->triangle;
    for (int32_t i = 0; i < 2 * n; i++) {
        double *v = s->vertex + 3 * i;
        v[0] = p->at[i % n][0], v[2] = p->at[i % n][1];
        v[1] = i < n ? -b->width / 2 : b->width / 2;
    }
    for (int32_t i = 1; i + 1 < n; i++) {
        to = mesh_put(to, 0, i, i + 1);
        to = mesh_put(to, n, n + i + 1, n + i);
    }
    for (int32_t i = 0; i < n; i++) {
        int32_t next = (i + 1) % n;
        to = mesh_put(to, i, n + i, next);
        to = mesh_put(to, next, n + i, n + next);
    }
}

mesh_status mesh_make_bar(const mesh_bar *b, mesh_surface *surface) {
    MESH_ASSERT(b && surface);
    *surface = (mesh_surface){0};
    profile p = {0};
    const char *fault = fault_of(b);
    if (!fault) {
        draw_profile(b, &p);
        if (is_short(b, &p)) fault = "it is shorter than its nose";
    }
    if (fault)
        return mesh_fail(MESH_ERR_ARGUMENT,
                         "bar of %g x %g x %g m, nose radius %g m, nose angle %g rad, undercut %g "
                         "m, %d segments: %s",
                         b->length, b->height, b->width, b->nose_radius, b->nose_angle, b->undercut,
                         b->segments, fault);
    size_t n = (size_t)p.count;
    if (!mesh_allocate(surface, 2 * n, 4 * n - 4)) return MESH_ERR_MEMORY;
    extrude(b, &p, surface);
    return MESH_OK;
}
