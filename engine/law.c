/* law.c - the contact laws by name: what they read, the coefficients of a pair of materials, and
 * what one contact stores or bears at most. Forces are in contact_law.h. */
#include "engine/numbers.h"
#include "engine/world.h"

static const clast_law_info LAWS[] = {
    [CLAST_LAW_HERTZ_A00] = {"hertz-a00", .spring = true, .shares = true},
    [CLAST_LAW_HERTZ_MINDLIN] = {"hertz-mindlin", .spring = true, .shares = true},
    [CLAST_LAW_LINEAR] = {"linear", .linear = true, .stiffness = true, .spring = true,
                          .shares = true},
    [CLAST_LAW_MAW] = {"maw", .linear = true, .spring = true, .shares = true},
    [CLAST_LAW_HOOKE] = {"hooke", .linear = true, .shares = true},
    [CLAST_LAW_HERTZ_BRILLIANTOV] = {"hertz-brilliantov", .dissipation = true},
    [CLAST_LAW_WALTON_BRAUN] = {"walton-braun", .linear = true, .stiffness = true, .yields = true},
    [CLAST_LAW_USER] = {"user", .linear = true, .spring = true},
};

const clast_law_info *clast_law_info_of(clast_law law) {
    CLAST_ASSERT((size_t)law < sizeof LAWS / sizeof *LAWS);
    return &LAWS[law];
}

bool law_has_spring(const clast_world *w) {
    if (w->def.law == CLAST_LAW_USER || w->def.tangent == CLAST_TANGENT_BY_LAW)
        return clast_law_info_of(w->def.law)->spring;
    return w->def.tangent == CLAST_TANGENT_SPRING;
}

/* ---- coefficients of a pair ------------------------------------------------------------------ */

/* What the stiffnesses of a pair are multiplied by in a contact of these effective sizes (dashpots:
 * by its root). Hooke 2.36: R*. Maw 2.29: (R*^2 m*)^(1/5). */
double law_scale(clast_law law, double radius, double mass) {
    if (law == CLAST_LAW_HOOKE) return radius;
    if (law == CLAST_LAW_MAW) return number_fifth_root(radius * radius * mass);
    return 1;
}

/* S12 2.29 without that scale: (16/15)^(4/5) E^(4/5) v^(2/5). */
static double maw_stiffness(double e_star, double v) {
    double energy = 16.0 / 15.0 * e_star;
    return number_fifth_root(energy * energy * energy * energy * v * v);
}

static double normal_stiffness(const clast_world *w, const pair_coef *c) {
    switch (w->def.law) {
    case CLAST_LAW_MAW:
        return maw_stiffness(c->e_star, w->plan.impact_speed);
    case CLAST_LAW_HOOKE:
        return 4.0 / 3.0 * c->e_star;
    case CLAST_LAW_WALTON_BRAUN:
        return c->stiffness / (c->restitution * c->restitution); /* S12 2.51 */
    case CLAST_LAW_LINEAR:
        return c->stiffness;
    default:
        return 2 * c->e_star;
    }
}

/* Linear laws: a ratio of the stiffness that a contact loads with. */
static double tangential_stiffness(const clast_world *w, const pair_coef *c) {
    if (!clast_law_info_of(w->def.law)->linear) return 8 * c->g_star;
    double ratio = c->ratio > 0 ? c->ratio : law_has_spring(w) ? 2.0 / 7.0 : 1;
    return ratio * (w->def.law == CLAST_LAW_WALTON_BRAUN ? c->stiffness : c->k_normal);
}

/* S12 2.34 with the sign of FACTS 1: c_t over critical; nothing cuts a tangential swing off. */
static double tangential_damping(const pair_coef *c) {
    if (c->tangential_restitution == 0) return c->damping;
    double log = number_log(c->tangential_restitution);
    return -log / sqrt(NUMBER_PI * NUMBER_PI + log * log);
}

static void set_coefficients(const clast_world *w, pair_coef *c) {
    c->k_normal = normal_stiffness(w, c);
    c->k_tangent = tangential_stiffness(w, c);
    c->c_normal = 2 * c->damping * sqrt(c->k_normal);
    c->c_tangent = 2 * tangential_damping(c) * sqrt(c->k_tangent);
    if (w->def.law == CLAST_LAW_HERTZ_BRILLIANTOV)
        c->c_normal = c->c_tangent = 4.0 / 3.0 * c->e_star * c->dissipation;
    if (w->def.law == CLAST_LAW_WALTON_BRAUN) {
        c->c_normal = 0;
        c->yield = 1 - c->restitution * c->restitution; /* S12 2.50 */
    }
}

/* ---- contacts to be expected ----------------------------------------------------------------- */

static double largest_radius(const shape *s) {
    double r = 0;
    for (int i = 0; i < s->spheres; i++) r = s->radius[i] > r ? s->radius[i] : r;
    return r;
}

double law_effective_mass(double a, double b) {
    return a * b / (a + b);
}

/* kg, effective, as the law takes it: that of the bodies, wherever they touch. */
double law_whole_mass(const expected_contact *e) {
    return e->b ? law_effective_mass(e->a->mass, e->b->mass) : e->a->mass;
}

/* All pairs of shapes and all shapes with all walls, at their largest spheres. */
void law_each_contact(const clast_world *w, law_visitor *visit, void *context) {
    for (int i = 0; i < w->shape_count; i++) {
        const shape *a = &w->shapes[i];
        const pair_coef *row = &w->coefs[a->material * w->material_count];
        double ra = largest_radius(a);
        for (int j = 0; j <= i; j++) {
            const shape *b = &w->shapes[j];
            double rb = largest_radius(b);
            expected_contact e = {&row[b->material], a, b, ra * rb / (ra + rb)};
            if (e.coef->set) visit(w, &e, context);
        }
        for (int l = 0; l < w->wall_count; l++) {
            expected_contact e = {&row[w->walls[l].def.material], a, NULL, ra};
            if (e.coef->set) visit(w, &e, context);
        }
    }
}

/* ---- preparing ------------------------------------------------------------------------------- */

/* s, unit of time of a Hertz contact: (m^2 / (k^2 v))^(1/5), k = 4/3 E* sqrt(R*). */
static double hertz_time(double speed, double mass, double radius, double e_star) {
    double inverse = mass / (4.0 / 3.0 * e_star * sqrt(radius));
    return number_fifth_root(inverse * inverse / speed);
}

double clast_dissipation(double restitution, double speed, double mass, double radius,
                         double e_star) {
    CLAST_ASSERT(speed > 0 && mass > 0 && radius > 0 && e_star > 0);
    return clast_damping_ratio(CLAST_LAW_HERTZ_BRILLIANTOV, restitution) *
           hertz_time(speed, mass, radius, e_star);
}

typedef struct lightest {
    const pair_coef *one, *other; /* of a pair, both ways round */
    double mass, radius;
} lightest;

static void find_lightest(const clast_world *w, const expected_contact *e, void *context) {
    (void)w;
    lightest *l = context;
    double mass = law_whole_mass(e);
    if ((e->coef != l->one && e->coef != l->other) || mass >= l->mass) return;
    l->mass = mass, l->radius = e->radius;
}

/* A is a constant of the materials, the rebound at one speed also depends on size: solved for the
 * lightest contact that the two can make. 0 for materials that do not meet. */
static double solved_dissipation(const clast_world *w, const pair_coef *one,
                                 const pair_coef *other) {
    lightest l = {one, other, INFINITY, 0};
    law_each_contact(w, find_lightest, &l);
    if (l.mass == INFINITY) return 0;
    double v = one->reference_speed > 0 ? one->reference_speed : w->plan.impact_speed;
    return one->damping * hertz_time(v, l.mass, l.radius, one->e_star);
}

/* Needs shapes, walls and the impact speed. */
void law_prepare_pair(clast_world *w, int a, int b) {
    pair_coef *one = &w->coefs[a * w->material_count + b];
    pair_coef *other = &w->coefs[b * w->material_count + a];
    if (clast_law_info_of(w->def.law)->dissipation && !one->dissipation_given)
        one->dissipation = solved_dissipation(w, one, other);
    set_coefficients(w, one);
    *other = *one;
}

/* Rolling friction stops a relative spin within a step, but never turns it round: each contact may
 * take a sixteenth of the smallest moment, for a sphere has at most twelve equal neighbours and a
 * few walls; a clump has as many per sphere. */
static double turning_of(const shape *s) {
    double least = fmin(s->inertia.x, fmin(s->inertia.y, s->inertia.z));
    return least / (16 * s->spheres);
}

void law_prepare(clast_world *w) {
    w->plan.impact_speed = timestep_impact_speed(w);
    for (int a = 0; a < w->material_count; a++)
        for (int b = 0; b <= a; b++)
            if (w->coefs[a * w->material_count + b].set) law_prepare_pair(w, a, b);
    for (int i = 0; i < w->shape_count; i++) w->shapes[i].turning = turning_of(&w->shapes[i]);
}

/* ---- one contact ----------------------------------------------------------------------------- */

/* While it loads for the first time; effective radius and mass. */
double law_elastic_force(const clast_world *w, const pair_coef *c, double radius, double mass,
                         double overlap) {
    if (w->def.law == CLAST_LAW_USER) return user_law_elastic_force(w, c, radius, mass, overlap);
    if (w->def.law == CLAST_LAW_WALTON_BRAUN) return c->stiffness * overlap;
    if (clast_law_info_of(w->def.law)->linear)
        return c->k_normal * law_scale(w->def.law, radius, mass) * overlap;
    return 2.0 / 3.0 * c->k_normal * sqrt(radius * overlap) * overlap;
}

stored_energy law_stored_energy(const clast_world *w, const pair_coef *c, double radius,
                                double mass, const history *h) {
    if (w->def.law == CLAST_LAW_USER) return user_law_stored_energy(w, c, radius, mass, h);
    double s2 = v3_dot(h->spring, h->spring), d = h->overlap;
    if (clast_law_info_of(w->def.law)->linear) {
        double scale = law_scale(w->def.law, radius, mass), rest = d - h->plastic;
        double x = rest > 0 ? rest : 0;
        return (stored_energy){0.5 * (c->k_normal * scale) * x * x,
                               0.5 * s2 / (c->k_tangent * scale)};
    }
    double a = sqrt(radius * d);
    return (stored_energy){8.0 / 15.0 * c->e_star * a * d * d, 0.5 * s2 / (8 * c->g_star * a)};
}
