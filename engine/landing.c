/* landing.c - how readily a body gives way where it lands.
 *
 * A contact with arm r and normal n gives way by 1/m + (r x n) I^-1 (r x n) per impulse, so a clump
 * that lands on its outermost sphere is lighter than its mass; one that lands flat on several
 * spheres meets that many times the stiffness of one. A contact that sticks has a spring across n
 * too, whose arm is that of the contact point: a sphere rolls on it with 1/m + R^2/I = 3.5/m. */
#include "engine/landing.h"

static const double TOGETHER = 0.05; /* of the smallest radius: touch at once, within an overlap */

static bool turns_about(const clast_world *w, int axis) {
    return w->def.motion != CLAST_MOTION_IN_PLANE || w->def.plane_axis == axis;
}

/* 1/(kg m2), 0 about an axis that the motion leaves still. */
static vec3 free_inverse(const clast_world *w, const shape *s) {
    return v3(turns_about(w, 0) ? s->inverse_inertia.x : 0,
              turns_about(w, 1) ? s->inverse_inertia.y : 0,
              turns_about(w, 2) ? s->inverse_inertia.z : 0);
}

static double smallest_radius(const shape *s) {
    double r = s->radius[0];
    for (int i = 1; i < s->spheres; i++) r = fmin(r, s->radius[i]);
    return r;
}

static bool leaves_plane(const clast_world *w, int axis) {
    return w->def.motion == CLAST_MOTION_IN_PLANE && axis == w->def.plane_axis;
}

/* ---- without friction ------------------------------------------------------------------------ */

/* The larger eigenvalue of the symmetric matrix {{a, b}, {b, d}}; b as its square. */
static double larger_eigenvalue(double a, double d, double b2) {
    double half = 0.5 * (a - d);
    return 0.5 * (a + d) + sqrt(half * half + b2);
}

/* 1/kg, the most that one sphere at c gives way by turning the body: the largest eigenvalue of
 * [c]^T I^-1 [c], which is singular along c. */
static double turning_alone(vec3 c, vec3 d) {
    double xx = d.y * c.z * c.z + d.z * c.y * c.y, yy = d.x * c.z * c.z + d.z * c.x * c.x;
    double zz = d.x * c.y * c.y + d.y * c.x * c.x;
    double xy = d.z * c.x * c.y, yz = d.x * c.y * c.z, zx = d.y * c.z * c.x;
    double trace = xx + yy + zz;
    double minors = xx * yy - xy * xy + (yy * zz - yz * yz) + (zz * xx - zx * zx);
    double root2 = 0.25 * trace * trace - minors;
    return 0.5 * trace + sqrt(root2 > 0 ? root2 : 0);
}

static double deepest_of(const shape *s, vec3 n) {
    double deepest = -INFINITY;
    for (int i = 0; i < s->spheres; i++)
        deepest = fmax(deepest, s->radius[i] - v3_dot(s->centre[i], n));
    return deepest;
}

/* 1/kg, of a flat landing with that normal: the largest eigenvalue of all that touch at once, by
 * the motion of the centre, turning (by its trace) and what couples the two. */
static double flat_landing(const shape *s, vec3 n, vec3 d, double slack) {
    double deepest = deepest_of(s, n), count = 0, turning = 0;
    vec3 sum = {0, 0, 0};
    for (int i = 0; i < s->spheres; i++) {
        if (s->radius[i] - v3_dot(s->centre[i], n) < deepest - slack) continue;
        vec3 t = v3_cross(s->centre[i], n);
        turning += v3_dot(t, v3_mul(d, t));
        sum = v3_add(sum, t);
        count++;
    }
    double coupling2 = v3_dot(sum, v3_mul(d, sum)) * s->inverse_mass;
    return larger_eigenvalue(count * s->inverse_mass, turning, coupling2);
}

double landing_lightest(const clast_world *w, const shape *s) {
    vec3 inverse = free_inverse(w, s);
    double slack = TOGETHER * smallest_radius(s), most = s->inverse_mass;
    for (int i = 0; i < s->spheres; i++)
        most = fmax(most, s->inverse_mass + turning_alone(s->centre[i], inverse));
    vec3 normals[LANDING_SIDES];
    int sides = landing_sides(w, s, normals);
    for (int i = 0; i < sides; i++) most = fmax(most, flat_landing(s, normals[i], inverse, slack));
    return most > s->inverse_mass ? 1 / most : s->mass;
}

/* ---- with friction that sticks --------------------------------------------------------------- */

/* The motion of a body in units in which its kinetic energy is half the square of it. */
enum { MOTIONS = 6 };
typedef struct motions {
    double of[MOTIONS];
} motions;
typedef struct stiffness_matrix {
    double at[MOTIONS][MOTIONS]; /* 1/kg: over the normal stiffness of one contact */
} stiffness_matrix;

typedef struct freedom {
    vec3 mass, inertia; /* roots of the inverse; 0 where the motion leaves still */
} freedom;

static freedom freedom_of(const clast_world *w, const shape *s) {
    vec3 d = free_inverse(w, s), one = v3(1, 1, 1);
    if (w->def.motion == CLAST_MOTION_IN_PLANE) one = v3_sub(one, v3_axis(w->def.plane_axis, 1));
    return (freedom){v3_scale(sqrt(s->inverse_mass), one), v3(sqrt(d.x), sqrt(d.y), sqrt(d.z))};
}

/* One spring at an arm: weight times the square of the way along d. */
static void add_spring(stiffness_matrix *k, const freedom *f, vec3 arm, vec3 d, double weight) {
    vec3 v = v3_mul(f->mass, d), w = v3_mul(f->inertia, v3_cross(arm, d));
    double way[MOTIONS] = {v.x, v.y, v.z, w.x, w.y, w.z};
    for (int i = 0; i < MOTIONS; i++)
        for (int j = 0; j < MOTIONS; j++) k->at[i][j] += weight * way[i] * way[j];
}

static void add_contact(stiffness_matrix *k, const freedom *f, vec3 arm, vec3 n, double ratio) {
    for (int axis = 0; axis < 3; axis++) add_spring(k, f, arm, v3_axis(axis, 1), ratio);
    add_spring(k, f, arm, n, 1 - ratio);
}

/* A' = J^T A J, the columns of the vectors likewise, with the rotation that clears one element. */
static void rotate(stiffness_matrix *a, stiffness_matrix *vectors, int p, int q) {
    if (a->at[p][q] == 0) return;
    double theta = (a->at[q][q] - a->at[p][p]) / (2 * a->at[p][q]);
    double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    double c = 1 / sqrt(t * t + 1), s = t * c;
    for (int i = 0; i < MOTIONS; i++) {
        double x = a->at[i][p], y = a->at[i][q], vx = vectors->at[i][p], vy = vectors->at[i][q];
        a->at[i][p] = c * x - s * y, a->at[i][q] = s * x + c * y;
        vectors->at[i][p] = c * vx - s * vy, vectors->at[i][q] = s * vx + c * vy;
    }
    for (int i = 0; i < MOTIONS; i++) {
        double x = a->at[p][i], y = a->at[q][i];
        a->at[p][i] = c * x - s * y, a->at[q][i] = s * x + c * y;
    }
}

/* Jacobi's method, which needs no function but the root; six sweeps reach rounding. */
static double largest_eigenvalue(stiffness_matrix a, motions *vector) {
    stiffness_matrix vectors = {{{0}}};
    for (int i = 0; i < MOTIONS; i++) vectors.at[i][i] = 1;
    for (int sweep = 0; sweep < 6; sweep++)
        for (int p = 0; p < MOTIONS; p++)
            for (int q = p + 1; q < MOTIONS; q++) rotate(&a, &vectors, p, q);
    int most = 0;
    for (int i = 1; i < MOTIONS; i++)
        if (a.at[i][i] > a.at[most][most]) most = i;
    for (int i = 0; i < MOTIONS; i++) vector->of[i] = vectors.at[i][most];
    return a.at[most][most];
}

/* 1/kg, all spheres that touch a plane of that normal at once. */
static double stuck_flat(const shape *s, const freedom *f, vec3 n, double slack, double ratio) {
    stiffness_matrix k = {{{0}}};
    motions ignored;
    double deepest = deepest_of(s, n);
    for (int i = 0; i < s->spheres; i++)
        if (s->radius[i] - v3_dot(s->centre[i], n) >= deepest - slack)
            add_contact(&k, f, v3_sub(s->centre[i], v3_scale(s->radius[i], n)), n, ratio);
    return largest_eigenvalue(k, &ignored);
}

/* A sphere of a shape that sticks to something at -R n from its centre. */
typedef struct held_sphere {
    vec3 centre;
    double radius, ratio;
} held_sphere;

static double stuck_at(const held_sphere *h, const freedom *f, vec3 n, motions *vector) {
    stiffness_matrix k = {{{0}}};
    add_contact(&k, f, v3_sub(h->centre, v3_scale(h->radius, n)), n, h->ratio);
    return largest_eigenvalue(k, vector);
}

/* The normal along the gradient of the energy that this motion stores, which is convex in the
 * normal (for a ratio above 1 with a multiple of its square): no step of it goes down. */
static vec3 stiffer_normal(const held_sphere *h, const freedom *f, vec3 n, const motions *x) {
    vec3 v = v3_mul(f->mass, v3(x->of[0], x->of[1], x->of[2]));
    vec3 spin = v3_mul(f->inertia, v3(x->of[3], x->of[4], x->of[5]));
    vec3 centre = v3_add(v, v3_cross(spin, h->centre));
    vec3 point = v3_sub(centre, v3_scale(h->radius, v3_cross(spin, n)));
    vec3 up = v3_scale(-h->ratio * h->radius, v3_cross(point, spin));
    up = v3_add(up, v3_scale((1 - h->ratio) * v3_dot(centre, n), centre));
    up = v3_add(up, v3_scale(fmax(0, h->ratio - 1) * v3_dot(centre, centre), n));
    double length = v3_norm(up);
    return length > 0 ? v3_scale(1 / length, up) : n;
}

/* 1/kg, in the direction in which the body gives way least: the best of the principal axes and of
 * that of the sphere, and up from there. */
static double stuck_sphere(const clast_world *w, const held_sphere *h, const freedom *f) {
    enum { AXES = 6, ROUNDS = 12 };
    double out = v3_norm(h->centre), most = 0;
    motions x, best = {{0}};
    vec3 normal = {0, 0, 0};
    for (int side = 0; side < AXES + 2; side++) {
        if (side < AXES ? leaves_plane(w, side / 2) : out == 0) continue;
        double sign = side % 2 ? -1 : 1;
        vec3 n = side < AXES ? v3_axis(side / 2, sign) : v3_scale(sign / out, h->centre);
        double rate = stuck_at(h, f, n, &x);
        if (rate > most) most = rate, best = x, normal = n;
    }
    for (int round = 0; round < ROUNDS; round++) {
        normal = stiffer_normal(h, f, normal, &best);
        most = fmax(most, stuck_at(h, f, normal, &best));
    }
    return most;
}

double landing_stuck_rate(const clast_world *w, const shape *s, double ratio) {
    freedom f = freedom_of(w, s);
    double slack = TOGETHER * smallest_radius(s), most = 0;
    double turning = fmax(f.inertia.x, fmax(f.inertia.y, f.inertia.z));
    vec3 normals[LANDING_SIDES];
    int sides = landing_sides(w, s, normals);
    for (int i = 0; i < sides; i++) most = fmax(most, stuck_flat(s, &f, normals[i], slack, ratio));
    for (int i = 0; i < s->spheres; i++) {
        held_sphere h = {s->centre[i], s->radius[i], ratio};
        double arm = (v3_norm(h.centre) + h.radius) * turning;
        double at_most = fmax(1, ratio) * (s->inverse_mass + arm * arm);
        if (at_most > most) most = fmax(most, stuck_sphere(w, &h, &f));
    }
    return most;
}
