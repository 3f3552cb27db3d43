#include "tests/support/collision.h"

const clast_law LAWS[LAW_COUNT] = {
    CLAST_LAW_HERTZ_A00, CLAST_LAW_HERTZ_MINDLIN,     CLAST_LAW_LINEAR,      CLAST_LAW_MAW,
    CLAST_LAW_HOOKE,     CLAST_LAW_HERTZ_BRILLIANTOV, CLAST_LAW_WALTON_BRAUN};
const char *const LAW_NAMES[LAW_COUNT] = {
    "hertz-a00", "hertz-mindlin", "linear", "maw", "hooke", "hertz-brilliantov", "walton-braun"};

static const double YOUNG[2] = {7.3e6, 61e6}, POISSON[2] = {0.37, 0.23}, DENSITY[2] = {1130, 2610};
static const double PI = 3.14159265358979323846;

static collision with_defaults(const collision *given) {
    collision c = *given;
    if (c.radius_a == 0) c.radius_a = 0.0031;
    if (c.radius_b == 0) c.radius_b = 0.0053;
    if (c.speed == 0) c.speed = 0.83;
    if (c.resolution == 0) c.resolution = 100;
    return c;
}

static double mass_of(double density, double r) { return density * 4.0 / 3.0 * PI * r * r * r; }

static double effective_mass(const collision *c) {
    double a = mass_of(DENSITY[0], c->radius_a), b = mass_of(DENSITY[1], c->radius_b);
    return c->against_plane ? a : a * b / (a + b);
}

static double effective_radius(const collision *c) {
    return c->against_plane ? c->radius_a : c->radius_a * c->radius_b / (c->radius_a + c->radius_b);
}

double contact_modulus(void) {
    double a = (1 - POISSON[0] * POISSON[0]) / YOUNG[0];
    return 1 / (a + (1 - POISSON[1] * POISSON[1]) / YOUNG[1]);
}

double contact_stiffness(const collision *given) {
    collision c = with_defaults(given);
    double m = effective_mass(&c), r = effective_radius(&c), e = contact_modulus(), v = 1;
    if (c.law == CLAST_LAW_HOOKE) return 4.0 / 3 * e * r;
    if (c.law == CLAST_LAW_MAW)
        return 16.0 / 15 * sqrt(r) * e * pow(15 * m * v * v / (16 * sqrt(r) * e), 0.2);
    return c.pair.stiffness;
}

double contact_time(const collision *given) {
    collision c = with_defaults(given);
    double m = effective_mass(&c), v = c.speed * cos(c.angle);
    if (clast_law_info_of(c.law)->linear) {
        double e = c.law == CLAST_LAW_WALTON_BRAUN ? c.pair.restitution : 1;
        return 0.5 * (1 + e) * PI * sqrt(m / contact_stiffness(&c));
    }
    return 2.9432751 * pow(15 * m / (16 * sqrt(effective_radius(&c)) * contact_modulus()), 0.4) *
           pow(v, -0.2);
}

static clast_world *world_of(const collision *c, double dt) {
    clast_world_def def = bare_def(c->law);
    def.unloading = c->unloading;
    def.tangent = c->tangent;
    def.limit = c->limit;
    def.time_step = dt;
    def.max_residual = 1e9;
    def.max_displacement = 1e3;
    clast_world *w = new_world(&def);
    clast_pair_def elastic = c->pair; /* of pairs that do not meet: needs no solving */
    elastic.restitution = 1;
    two_materials m = add_materials(w, &elastic);
    assert_int_equal(clast_pair_set(w, m.soft, m.hard, &c->pair), CLAST_OK);
    int a = clast_shape_add_sphere(w, "a", c->radius_a, m.soft);
    int b = clast_shape_add_sphere(w, "b", c->radius_b, m.hard);
    double vn = c->speed * cos(c->angle), vt = c->speed * sin(c->angle),
           gap = vn * dt * (1 + c->phase);
    add_body(w, a, vec(0, 0, c->radius_a + gap), vec(vt, 0, -vn), vec(0, c->spin, 0));
    if (c->against_plane) {
        int part = clast_part_add(w, &(clast_part_def){.name = "ground"});
        add_plane(w, part, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    } else {
        add_body(w, b, vec(0, 0, -c->radius_b), vec(0, 0, 0), vec(0, 0, 0));
    }
    return w;
}

/* Kinetic energy without that of the centre of mass of the pair. */
static double inner_energy(clast_world *w, const collision *c) {
    double e = motion_energy(w);
    if (c->against_plane) return e;
    body_state a = body_of(w, 0), b = body_of(w, 1);
    clast_vec3 p = plus(times(a.mass, a.velocity), times(b.mass, b.velocity));
    return e - 0.5 * dot(p, p) / (a.mass + b.mass);
}

static double normal_speed(clast_world *w, const collision *c) {
    double v = body_of(w, 0).velocity.z;
    return c->against_plane ? v : v - body_of(w, 1).velocity.z;
}

rebound collide(const collision *given) {
    collision c = with_defaults(given);
    double dt = contact_time(&c) / c.resolution;
    clast_world *w = world_of(&c, dt);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    rebound r = {.energy_before = inner_energy(w, &c), .effective_mass = effective_mass(&c),
                 .effective_radius = effective_radius(&c)};
    body_state before = body_of(w, 0);
    bool touched = false;
    for (long i = 0; i < (long)(40 * c.resolution) + 400; i++) {
        steps(w, 1);
        clast_contact k;
        size_t touching = clast_world_contacts(w, &k, 1);
        if (touching)
            touched = true, r.duration += dt, r.overlap_max = fmax(r.overlap_max, k.overlap);
        if (touched && !touching) break;
    }
    r.touched = touched;
    assert_true(contact_count(w) == 0 && (touched || c.angle > 1.3)); /* grazing spheres may miss */
    body_state after = body_of(w, 0);
    r.restitution = normal_speed(w, &c) / (c.speed * cos(c.angle));
    r.energy_after = inner_energy(w, &c);
    r.normal_impulse = after.mass * (after.velocity.z - before.velocity.z);
    r.tangential_impulse = after.mass * (after.velocity.x - before.velocity.x);
    r.velocity = after.velocity, r.spin = after.spin;
    r.residual = clast_world_energy(w).residual;
    clast_world_free(w);
    return r;
}
