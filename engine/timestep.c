/* timestep.c - the limits of the time step and the choice between them. */
#include "engine/numbers.h"
#include "engine/world.h"

/* A00 1.26-1.28 for the smallest sphere of one shape. */
static double rayleigh_of(const clast_world *w, const shape *s) {
    const material *m = &w->materials[s->material];
    double smallest = s->radius[0];
    for (int i = 1; i < s->spheres; i++)
        if (s->radius[i] < smallest) smallest = s->radius[i];
    double shear = m->young / (2 * (1 + m->poisson));
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

typedef struct stiffest {
    double duration; /* s, of a contact */
    double critical; /* s, 2 / omega at its largest overlap */
} stiffest;

/* Hertz: T = 2.943 (15 m / (16 sqrt(R) E))^(2/5) v^(-1/5) (S12 2.41 with its constant worked out),
 * overlap (15 m v^2 / (16 sqrt(R) E))^(2/5); linear: pi sqrt(m / k) (S12 2.22 without damping),
 * half of it with either stiffness of a law that yields (S12 2.52). */
static stiffest contact_of(const clast_world *w, double mass, double radius, const pair_coef *c,
                           double v) {
    const clast_law_info *law = clast_law_info_of(w->def.law);
    if (w->def.law == CLAST_LAW_USER) {
        double own = sqrt(user_law_stiffness(w, c, radius, mass, v) / mass);
        return (stiffest){NUMBER_PI / own, 2 / own};
    }
    if (law->linear) {
        double omega = sqrt(c->k_normal * law_scale(w->def.law, radius, mass) / mass);
        double loading = law->yields ? sqrt(c->stiffness / mass) : omega;
        return (stiffest){NUMBER_PI / 2 / loading + NUMBER_PI / 2 / omega, 2 / omega};
    }
    double q = 15 * mass / (16 * sqrt(radius) * c->e_star);
    double overlap = number_fifth_root(q * q * v * v * v * v);
    double k_n = 2 * c->e_star * sqrt(radius * overlap);
    return (stiffest){2.9432751 * overlap / v, 2 * sqrt(mass / k_n)};
}

static void keep_least(const clast_world *w, const pair_coef *c, double mass, double radius,
                       void *context) {
    stiffest *least = context, s = contact_of(w, mass, radius, c, w->plan.impact_speed);
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
