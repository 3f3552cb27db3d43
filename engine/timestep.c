/* timestep.c - the limits of the time step and the choice between them. */
#include <stdlib.h>

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

/* ---- contacts -------------------------------------------------------------------------------- */

/* What a contact amounts to at its largest overlap. */
typedef struct impact {
    double duration;  /* s */
    double stiffness; /* N/m, normal */
} impact;

/* landing_stuck_rate() of a shape, kept with the ratio that it was last asked for. */
typedef struct kept_rate {
    double ratio, rate;
} kept_rate;

typedef struct stiffest {
    double duration; /* s, of a contact */
    double critical; /* s, 2 / omega at its largest overlap */
    kept_rate *kept; /* per shape */
} stiffest;

static double landing_mass(const clast_world *w, const expected_contact *e) {
    double a = landing_lightest(w, e->a);
    return e->b ? law_effective_mass(a, landing_lightest(w, e->b)) : a;
}

/* Hertz: T = 2.943 (15 m / (16 sqrt(R) E))^(2/5) v^(-1/5) (S12 2.41 with its constant worked out),
 * overlap (15 m v^2 / (16 sqrt(R) E))^(2/5); linear: pi sqrt(m / k) (S12 2.22 without damping),
 * half of it with either stiffness of a law that yields (S12 2.52). */
static impact impact_of(const clast_world *w, const expected_contact *e, double mass, double v) {
    const clast_law_info *law = clast_law_info_of(w->def.law);
    const pair_coef *c = e->coef;
    double whole = law_whole_mass(e), radius = e->radius;
    if (w->def.law == CLAST_LAW_USER) {
        double own = user_law_stiffness(w, c, radius, whole, v);
        return (impact){NUMBER_PI * sqrt(mass / own), own};
    }
    if (law->linear) {
        double k = c->k_normal * law_scale(w->def.law, radius, whole), omega = sqrt(k / mass);
        double loading = law->yields ? sqrt(c->stiffness / mass) : omega;
        return (impact){NUMBER_PI / 2 / loading + NUMBER_PI / 2 / omega, k};
    }
    double q = 15 * mass / (16 * sqrt(radius) * c->e_star);
    double overlap = number_fifth_root(q * q * v * v * v * v);
    return (impact){2.9432751 * overlap / v, 2 * c->e_star * sqrt(radius * overlap)};
}

/* Tangential over normal stiffness of a contact that sticks; 0 where nothing springs back. */
static double sticking_ratio(const clast_world *w, const expected_contact *e, double v) {
    const pair_coef *c = e->coef;
    if (w->def.law == CLAST_LAW_USER)
        return user_law_tangent_ratio(w, c, e->radius, law_whole_mass(e), v);
    bool sticks = c->friction > 0 || c->cohesion > 0;
    return sticks && law_has_spring(w) ? c->k_tangent / c->k_normal : 0;
}

/* Most scenes have one ratio for all their contacts. */
static double stuck_rate(const clast_world *w, stiffest *all, const shape *s, double ratio) {
    kept_rate *kept = &all->kept[s - w->shapes];
    if (kept->ratio != ratio) *kept = (kept_rate){ratio, landing_stuck_rate(w, s, ratio)};
    return kept->rate;
}

static void keep_least(const clast_world *w, const expected_contact *e, void *context) {
    stiffest *all = context;
    double v = w->plan.impact_speed, mass = landing_mass(w, e), rate = 1 / mass;
    impact i = impact_of(w, e, mass, v);
    double ratio = sticking_ratio(w, e, v);
    if (ratio > 0) {
        double stuck = stuck_rate(w, all, e->a, ratio);
        if (e->b) stuck += stuck_rate(w, all, e->b, ratio);
        rate = fmax(rate, stuck);
    }
    double critical = 2 / sqrt(i.stiffness * rate);
    if (i.duration < all->duration) all->duration = i.duration;
    if (critical < all->critical) all->critical = critical;
}

static stiffest stiffest_contact(const clast_world *w) {
    stiffest all = {INFINITY, INFINITY, calloc((size_t)w->shape_count + 1, sizeof(kept_rate))};
    CLAST_ASSERT(all.kept);
    law_each_contact(w, keep_least, &all);
    free(all.kept);
    return all;
}

/* Of the critical step of one contact: several at once make a body up to four times as stiff. */
static const double CROWDED = 0.5;

/* Needs law_prepare(). */
clast_status timestep_choose(clast_world *w) {
    clast_plan *p = &w->plan;
    stiffest s = stiffest_contact(w);
    p->rayleigh_step = timestep_rayleigh(w);
    p->contact_time = s.duration;
    p->critical_step = s.critical;
    w->dt = w->def.time_step;
    if (w->dt == 0) {
        double a = w->def.rayleigh_fraction * p->rayleigh_step;
        double b = s.duration / w->def.contact_resolution;
        bool by_contact = clast_law_info_of(w->def.law)->linear; /* waves know nothing of it */
        if (by_contact) a = b;
        w->dt = fmin(fmin(a, b), CROWDED * s.critical);
    }
    if (!(w->dt > 0 && w->dt < 1e6))
        return world_fail(w, CLAST_ERR_ARGUMENT,
                          "no contact in this scene sets a time step: give one");
    p->time_step = w->dt;
    p->resolution = s.duration / w->dt;
    return CLAST_OK;
}
