/* timestep.c - the limits of the time step and the choice between them. */
#include "engine/numbers.h"
#include "engine/world.h"

static double smallest_radius(const shape *s) {
    double r = s->radius[0];
    for (int i = 1; i < s->spheres; i++) r = fmin(r, s->radius[i]);
    return r;
}

/* A00 1.26-1.28 for the smallest sphere of one shape. */
static double rayleigh_of(const clast_world *w, const shape *s) {
    const material *m = &w->materials[s->material];
    double shear = m->young / (2 * (1 + m->poisson));
    double smallest = smallest_radius(s);
    return NUMBER_PI * smallest / (0.1631 * m->poisson + 0.8766) * sqrt(m->density / shear);
}

double timestep_rayleigh(const clast_world *w) {
    double least = INFINITY;
    for (int i = 0; i < w->shape_count; i++) {
        double step = rayleigh_of(w, &w->shapes[i]);
        if (step < least) least = step;
    }
    return least;
}

/* Fastest impact to be expected: asked for, or the start's fastest plus the fall through the
 * domain. */
double timestep_impact_speed(const clast_world *w) {
    if (w->def.impact_speed > 0) return w->def.impact_speed;
    vec3 d = v3_sub(w->def.domain_max, w->def.domain_min), g = w->def.gravity;
    double fastest2 = 0;
    const body_store *b = &w->bodies;
    for (size_t i = 0; i < b->count; i++) {
        double v2 = b->vx[i] * b->vx[i] + b->vy[i] * b->vy[i] + b->vz[i] * b->vz[i];
        if (v2 > fastest2) fastest2 = v2;
    }
    double fall = fabs(d.x * g.x) + fabs(d.y * g.y) + fabs(d.z * g.z);
    double v = sqrt(fastest2 + 2 * fall);
    return v > 0 ? v : 1;
}

/* ---- clumps ----------------------------------------------------------------------------------
 * A contact with arm r and normal n gives way by 1/m + (r x n) I^-1 (r x n) per impulse, so a clump
 * that lands on its outermost sphere is lighter than its mass; one that lands flat on several
 * spheres meets that many times the stiffness of one. */

enum { SIDES = 6 };

static const double TOGETHER = 0.05; /* of the smallest radius: touch at once, within an overlap */

/* The larger eigenvalue of the symmetric matrix {{a, b}, {b, d}}; b as its square. */
static double larger_eigenvalue(double a, double d, double b2) {
    double half = 0.5 * (a - d);
    return 0.5 * (a + d) + sqrt(half * half + b2);
}

static bool turns_about(const clast_world *w, int axis) {
    return w->def.motion != CLAST_MOTION_IN_PLANE || w->def.plane_axis == axis;
}

/* 1/(kg m2), 0 about an axis that the motion leaves still. */
static vec3 free_inverse(const clast_world *w, const shape *s) {
    return v3(turns_about(w, 0) ? s->inverse_inertia.x : 0,
              turns_about(w, 1) ? s->inverse_inertia.y : 0,
              turns_about(w, 2) ? s->inverse_inertia.z : 0);
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

/* 1/kg, of a flat landing with that normal: the largest eigenvalue of all that touch at once, by
 * the motion of the centre, turning (by its trace) and what couples the two. */
static double flat_landing(const shape *s, vec3 n, vec3 d, double slack) {
    double deepest = -INFINITY, count = 0, turning = 0;
    vec3 sum = {0, 0, 0};
    for (int i = 0; i < s->spheres; i++)
        deepest = fmax(deepest, s->radius[i] - v3_dot(s->centre[i], n));
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

/* kg: mass over stiffness in its stiffest landing, on one sphere or flat along a principal axis, in
 * units of the stiffness of one contact. That of a single sphere is its mass. */
static double lightest_landing(const clast_world *w, const shape *s) {
    vec3 inverse = free_inverse(w, s);
    double slack = TOGETHER * smallest_radius(s), most = s->inverse_mass;
    for (int i = 0; i < s->spheres; i++)
        most = fmax(most, s->inverse_mass + turning_alone(s->centre[i], inverse));
    for (int side = 0; side < SIDES; side++) {
        if (w->def.motion == CLAST_MOTION_IN_PLANE && side / 2 == w->def.plane_axis) continue;
        vec3 n = v3_axis(side / 2, side % 2 ? -1 : 1);
        most = fmax(most, flat_landing(s, n, inverse, slack));
    }
    return most > s->inverse_mass ? 1 / most : s->mass;
}

static double landing_mass(const clast_world *w, const expected_contact *e) {
    double a = lightest_landing(w, e->a);
    return e->b ? law_effective_mass(a, lightest_landing(w, e->b)) : a;
}

/* ---- contacts -------------------------------------------------------------------------------- */

typedef struct stiffest {
    double duration; /* s, of a contact */
    double critical; /* s, 2 / omega at its largest overlap */
} stiffest;

/* Hertz: T = 2.943 (15 m / (16 sqrt(R) E))^(2/5) v^(-1/5) (S12 2.41 with its constant worked out),
 * overlap (15 m v^2 / (16 sqrt(R) E))^(2/5); linear: pi sqrt(m / k) (S12 2.22 without damping),
 * half of it with either stiffness of a law that yields (S12 2.52). */
static stiffest contact_of(const clast_world *w, const expected_contact *e, double v) {
    const clast_law_info *law = clast_law_info_of(w->def.law);
    const pair_coef *c = e->coef;
    double mass = landing_mass(w, e), whole = law_whole_mass(e), radius = e->radius;
    if (w->def.law == CLAST_LAW_USER) {
        double own = sqrt(user_law_stiffness(w, c, radius, whole, v) / mass);
        return (stiffest){NUMBER_PI / own, 2 / own};
    }
    if (law->linear) {
        double omega = sqrt(c->k_normal * law_scale(w->def.law, radius, whole) / mass);
        double loading = law->yields ? sqrt(c->stiffness / mass) : omega;
        return (stiffest){NUMBER_PI / 2 / loading + NUMBER_PI / 2 / omega, 2 / omega};
    }
    double q = 15 * mass / (16 * sqrt(radius) * c->e_star);
    double overlap = number_fifth_root(q * q * v * v * v * v);
    double k_n = 2 * c->e_star * sqrt(radius * overlap);
    return (stiffest){2.9432751 * overlap / v, 2 * sqrt(mass / k_n)};
}

static void keep_least(const clast_world *w, const expected_contact *e, void *context) {
    stiffest *least = context, s = contact_of(w, e, w->plan.impact_speed);
    if (s.duration < least->duration) least->duration = s.duration;
    if (s.critical < least->critical) least->critical = s.critical;
}

/* Needs law_prepare(). */
clast_status timestep_choose(clast_world *w) {
    clast_plan *p = &w->plan;
    stiffest s = {INFINITY, INFINITY};
    law_each_contact(w, keep_least, &s);
    p->rayleigh_step = timestep_rayleigh(w);
    p->contact_time = s.duration;
    p->critical_step = s.critical;
    w->dt = w->def.time_step;
    if (w->dt == 0) {
        double a = w->def.rayleigh_fraction * p->rayleigh_step;
        double b = s.duration / w->def.contact_resolution;
        bool by_contact = clast_law_info_of(w->def.law)->linear; /* waves know nothing of it */
        if (by_contact) a = b;
        w->dt = a < b ? a : b;
    }
    if (!(w->dt > 0 && w->dt < 1e6))
        return world_fail(w, CLAST_ERR_ARGUMENT,
                          "no contact in this scene sets a time step: give one");
    p->time_step = w->dt;
    p->resolution = s.duration / w->dt;
    return CLAST_OK;
}
