/* particle.c - the particles of A00 chapter 3 and the world around them. */
#include <math.h>
#include <stdlib.h>

#include "experiments/particle-checks/checks.h"

static uint64_t all_hashes;

static void stop(const char *what) {
    fprintf(stderr, "particle-checks: %s\n", what);
    exit(4);
}

uint64_t checks_hash(void) {
    return all_hashes;
}

void checks_hash_add(uint64_t hash) {
    all_hashes = (all_hashes * 31) ^ hash;
}

/* ---- matter ---------------------------------------------------------------------------------- */

double matter_density(void) {
    double sphere = 4.0 / 3 * CHECKS_PI * pow(PSEUDO_RADIUS, 3);
    return PSEUDO_WEIGHT / GRAVITY / (5 * sphere);
}

/* Shear modulus, A00 1.26 to 1.28. */
static double rayleigh_factor(double radius) {
    return CHECKS_PI * radius / (0.1631 * POISSON + 0.8766);
}

double matter_young(double radius, double step) {
    double root = rayleigh_factor(radius) / step;
    return 2 * (1 + POISSON) * matter_density() * root * root;
}

double critical_step(double radius, double young) {
    return rayleigh_factor(radius) * sqrt(matter_density() * 2 * (1 + POISSON) / young);
}

/* ---- particles ------------------------------------------------------------------------------- */

double capsule_volume(double radius, double straight) {
    return CHECKS_PI * radius * radius * (straight + 4.0 / 3 * radius);
}

/* Cylinder and two half spheres. */
static clast_vec3 capsule_inertia(double r, double straight, double mass) {
    double share = straight / (straight + 4.0 / 3 * r); /* of the cylinder */
    double bar = share * mass, ends = mass - bar, h = straight;
    double along = bar * r * r / 2 + ends * 0.4 * r * r;
    double across =
        bar * (h * h / 12 + r * r / 4) + ends * (0.4 * r * r + h * h / 4 + 3.0 / 8 * h * r);
    return (clast_vec3){along, across, across};
}

capsule capsule_of(int spheres, double radius, double straight, double mass) {
    return (capsule){.spheres = spheres,
                     .radius = radius,
                     .spacing = spheres > 1 ? straight / (spheres - 1) : 0,
                     .mass = mass,
                     .inertia = capsule_inertia(radius, straight, mass)};
}

capsule pair_particle(void) {
    double mass = PAIR_WEIGHT / GRAVITY;
    double radius = cbrt(mass / matter_density() / capsule_volume(1, 1));
    return capsule_of(2, radius, radius, mass);
}

double pair_young(void) {
    return matter_young(pair_particle().radius, PAIR_CRITICAL_STEP);
}

capsule sliding_particle(int spheres) {
    const double radius = 0.01, straight = 4 * radius; /* three spheres just touch */
    return capsule_of(spheres, radius, straight,
                      matter_density() * capsule_volume(radius, straight));
}

double sliding_young(void) {
    return pair_young();
}

clast_quat upright(void) {
    return clast_quat_axis_angle((clast_vec3){0, 1, 0}, CHECKS_PI / 2);
}

/* ---- the world ------------------------------------------------------------------------------- */

static clast_vec3 gravity_of(const setting *s) {
    if (s->weightless) return (clast_vec3){0, 0, 0};
    return (clast_vec3){GRAVITY * sin(s->slope), 0, -GRAVITY * cos(s->slope)};
}

static clast_world *world_of(const setting *s) {
    clast_world_def d = clast_world_def_default();
    d.gravity = gravity_of(s);
    d.law = s->law;
    d.clump_contact = s->shared ? CLAST_CLUMP_SHARED : CLAST_CLUMP_EACH;
    d.time_step = s->step;
    d.impact_speed = 1;
    d.threads = 1;
    if (s->in_plane) d.motion = CLAST_MOTION_IN_PLANE;
    if (s->mixed) d.precision = CLAST_PRECISION_MIXED;
    if (s->guards_look_on) {
        d.guards = CLAST_GUARD_REPORT;
        d.max_overlap = d.max_displacement = d.max_residual = 1e9;
    }
    clast_world *w = clast_world_new(&d);
    if (!w) stop(clast_world_new_error());
    if (s->law == CLAST_LAW_USER && clast_world_use_law(w, PRINTED_LAW, "printed_law"))
        stop(clast_world_error(w));
    return w;
}

/* The restitution that stands for a damping ratio; without tangential dashpot e_t is 1. */
static clast_pair_def pair_of(const setting *s) {
    clast_pair_def pair = {.friction = s->friction};
    if (s->law == CLAST_LAW_USER) {
        pair.parameter[0] = s->damping, pair.parameter[1] = s->slip_damping;
        return pair;
    }
    pair.restitution = s->damping > 0 ? clast_restitution(s->law, s->damping) : 1;
    pair.tangential_restitution = s->slip_damping > 0 ? 0 : 1;
    return pair;
}

static void add_shape(clast_world *w, const capsule *p) {
    clast_vec3 centre[80];
    double radius[80];
    if (p->spheres > 80) stop("a particle of more than 80 spheres");
    for (int i = 0; i < p->spheres; i++) {
        centre[i] = (clast_vec3){(i - 0.5 * (p->spheres - 1)) * p->spacing, 0, 0};
        radius[i] = p->radius;
    }
    clast_shape_def shape = {.name = "capsule",
                             .spheres = p->spheres,
                             .centre = centre,
                             .radius = radius,
                             .mass = p->mass,
                             .inertia = p->inertia};
    if (clast_shape_add(w, &shape) < 0) stop(clast_world_error(w));
}

clast_world *matter_new(const setting *s, const capsule *p) {
    clast_world *w = world_of(s);
    clast_pair_def pair = pair_of(s);
    int matter =
        clast_material_add(w, &(clast_material_def){"matter", matter_density(), s->young, POISSON});
    int wall = clast_material_add(w, &(clast_material_def){"wall", matter_density(),
                                                           (s->rigid_wall ? RIGID : 1) * s->young,
                                                           POISSON});
    if (clast_pair_set(w, matter, matter, &pair) || clast_pair_set(w, matter, wall, &pair))
        stop(clast_world_error(w));
    add_shape(w, p);
    return w;
}

void floor_add(clast_world *w, const setting *s) {
    int part = clast_part_add(w, &(clast_part_def){.name = "floor"});
    clast_wall_def plane = {
        .name = "floor", .material = 1, .normal = {0, 0, 1}, .belt_velocity = {s->belt, 0, 0}};
    if (clast_wall_add(w, part, &plane) < 0) stop(clast_world_error(w));
}

void body_put(clast_world *w, const clast_body_def *body) {
    if (clast_body_add(w, body) < 0) stop(clast_world_error(w));
}

void world_step(clast_world *w) {
    if (clast_world_step(w)) stop(clast_world_error(w));
}

void world_end(clast_world *w) {
    checks_hash_add(clast_world_hash(w));
    clast_world_free(w);
}

/* ---- contacts -------------------------------------------------------------------------------- */

/* N: Hertz against the floor. */
static double elastic_force(const setting *s, const capsule *p, double overlap) {
    double own = (1 - POISSON * POISSON) / s->young;
    double modulus = 1 / (own + own / (s->rigid_wall ? RIGID : 1));
    return 4.0 / 3 * modulus * sqrt(p->radius * overlap) * overlap;
}

touch touch_of(clast_world *w, uint32_t id, const setting *s, const capsule *p) {
    enum { ROOM = 1024 };
    clast_contact contact[ROOM];
    touch sum = {.contacts = 0};
    size_t count = clast_world_contacts(w, contact, ROOM);
    if (count > ROOM) stop("more contacts than there is room for");
    for (size_t i = 0; i < count; i++) {
        const clast_contact *c = &contact[i];
        bool upper = c->b == id;
        if (c->a != id && !upper) continue;
        double sign = upper ? -1 : 1, elastic = elastic_force(s, p, c->overlap);
        sum.contacts++;
        sum.elastic += elastic;
        sum.dashpot += c->normal_force - elastic;
        sum.overlap = fmax(sum.overlap, c->overlap);
        sum.force.x += sign * c->force.x;
        sum.force.y += sign * c->force.y;
        sum.force.z += sign * c->force.z;
    }
    return sum;
}
