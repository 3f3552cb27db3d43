#include "tests/support/sandwich.h"

static const double PI = 3.14159265358979323846, RADIUS = 0.005, STIFFNESS = 310, DENSITY = 1130;

oscillator sandwich_new(const sandwich *s) {
    double press = s->press > 0 ? s->press : 0.1, e = s->restitution > 0 ? s->restitution : 1;
    oscillator o = {.radius = RADIUS, .mass = DENSITY * 4.0 / 3 * PI * RADIUS * RADIUS * RADIUS};
    /* two springs; two dashpots of 2 ratio sqrt(k m) each */
    o.omega = sqrt(2 * STIFFNESS / o.mass);
    o.zeta = sqrt(2) * clast_damping_ratio(CLAST_LAW_LINEAR, e);
    clast_world_def def = bare_def(s->law);
    def.scheme = s->scheme;
    def.time_step = s->step / o.omega;
    def.max_overlap = s->max_overlap > 0 ? s->max_overlap : 0.5;
    def.max_displacement = 1e3;
    def.max_residual = 1e9;
    def.guards = s->guards;
    o.world = new_world(&def);
    clast_pair_def pair = pair_of(e, 0);
    pair.stiffness = STIFFNESS;
    two_materials m = add_materials(o.world, &pair);
    int ball = clast_shape_add_sphere(o.world, "ball", RADIUS, m.soft);
    int part = clast_part_add(o.world, &(clast_part_def){.name = "press"});
    double height = (1 - press) * RADIUS;
    add_plane(o.world, part, m.hard, vec(0, 0, -height), vec(0, 0, 1));
    add_plane(o.world, part, m.hard, vec(0, 0, height), vec(0, 0, -1));
    add_body(o.world, ball, vec(0, 0, s->x), vec(0, 0, s->v), vec(0, 0, 0));
    return o;
}

double sandwich_position(const oscillator *o) {
    return body_of(o->world, 0).position.z;
}

double sandwich_velocity(const oscillator *o) {
    return body_of(o->world, 0).velocity.z;
}

double sandwich_exact(const oscillator *o, const sandwich *s, double time, double *velocity) {
    double damped = o->omega * sqrt(1 - o->zeta * o->zeta), rate = o->zeta * o->omega;
    double fade = exp(-rate * time), c = cos(damped * time), n = sin(damped * time);
    if (velocity)
        *velocity = fade * (s->v * c - (o->omega * o->omega * s->x + rate * s->v) / damped * n);
    return fade * (s->x * c + (s->v + rate * s->x) / damped * n);
}
