/* Random small scenes of every kind: they never crash, never lose a body, and make no energy unless
 * they are driven. A failure prints its seed. */
#include "tests/support/scene.h"

enum { SCENES = 100 };

typedef struct random_scene {
    clast_world *w;
    bool driven, leaking;
    int bodies;
} random_scene;

static int random_shape(clast_world *w, dice *d, int material) {
    double r = roll(d, 0.002, 0.006);
    int kind = (int)roll(d, 0, 4);
    if (kind == 0) return clast_shape_add_sphere(w, "ball", r, material);
    if (kind == 1) return add_rod(w, material, r);
    return kind == 2 ? add_triangle(w, material, r) : add_uneven_rod(w, material, r);
}

static void random_walls(random_scene *s, dice *d, int material) {
    int walls = (int)roll(d, 0, 5);
    for (int i = 0; i < walls; i++) {
        bool moving = roll(d, 0, 1) < 0.2, belt = roll(d, 0, 1) < 0.2;
        clast_part_def p = {.name = "part", .removed_at = roll(d, 0, 1) < 0.2 ? 0.02 : 0};
        if (moving) p.velocity = vec(roll(d, -.2, .2), 0, roll(d, -.2, .2));
        clast_wall_def l = {.name = "wall", .material = material, .normal = {roll(d, -1, 1), 0, 1},
                            .point = {0, 0, roll(d, -0.12, -0.06)}, .side = {0, 1, 0},
                            .half_side = {roll(d, .01, .1), roll(d, .01, .1)}};
        l.kind = roll(d, 0, 1) < 0.5 ? CLAST_WALL_PLANE : CLAST_WALL_PLATE;
        if (belt) l.belt_velocity = vec(0, roll(d, -1, 1), 0);
        s->driven |= moving || belt;
        assert_true(clast_wall_add(s->w, clast_part_add(s->w, &p), &l) >= 0);
    }
}

static random_scene make(uint64_t seed) {
    dice d = {seed, 0};
    clast_world_def def = bare_def((clast_law)(int)roll(&d, 0, 7));
    def.tangent = (clast_tangent)(int)roll(&d, 0, 3);
    def.limit = (clast_friction_limit)(int)roll(&d, 0, 2);
    def.motion = roll(&d, 0, 1) < 0.3 ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D;
    def.gravity = vec(roll(&d, -3, 3), 0, roll(&d, -12, 0));
    def.global_damping = roll(&d, 0, 1) < 0.2 ? roll(&d, 0, 5) : 0;
    def.threads = roll(&d, 0, 1) < 0.1 ? 2 : 1, def.spheres_per_thread = 1;
    def.skin = roll(&d, 0, 1) < 0.5 ? 0 : pow(10, roll(&d, -5, -1.5));
    def.rayleigh_fraction = 0.6, def.impact_speed = 2;
    def.domain_min = vec(-0.3, -0.3, -0.3), def.domain_max = vec(0.3, 0.3, 0.3);
    def.outside = CLAST_OUTSIDE_REMOVE;
    random_scene s = {.w = new_world(&def), .bodies = (int)roll(&d, 0, 25)};
    clast_pair_def pair = pair_of(roll(&d, 0.05, 1), roll(&d, 0, 1) < 0.2 ? 0 : roll(&d, 0, 1.2));
    pair.cohesion = roll(&d, 0, 1) < 0.2 ? roll(&d, 0, 1e-3) : 0;
    pair.rolling_friction = roll(&d, 0, 1) < 0.3 ? roll(&d, 0, 0.5) : 0;
    two_materials m = add_materials(s.w, &pair);
    int shapes[3] = {random_shape(s.w, &d, m.soft), random_shape(s.w, &d, m.hard),
                     random_shape(s.w, &d, m.soft)};
    random_walls(&s, &d, m.hard);
    bool flat = def.motion == CLAST_MOTION_IN_PLANE;
    for (int i = 0; i < s.bodies; i++) {
        clast_vec3 at = {0.028 * (i % 3 - 1), flat ? 0 : 0.028 * (i / 3 % 3 - 1),
                         0.028 * (flat ? i / 3 : i / 9)};
        clast_body_def b = {shapes[(int)roll(&d, 0, 3)], at, {1, 0, 0, 0},
                            {roll(&d, -1, 1), flat ? 0 : roll(&d, -1, 1), roll(&d, -1, 1)},
                            {0, roll(&d, -50, 50), 0}};
        if (flat) b.orientation = clast_quat_axis_angle(vec(0, 1, 0), roll(&d, -3, 3));
        else b.orientation = any_orientation(&d), b.spin.x = roll(&d, -50, 50);
        assert_true(clast_body_add(s.w, &b) >= 0);
    }
    return s;
}

static double mechanical(clast_world *w) {
    clast_energy e = clast_world_energy(w);
    return e.kinetic + e.rotational + e.gravity + e.elastic;
}

/* False when the random scene cannot start (a body in a wall). */
static bool check_scene(uint64_t seed) {
    random_scene s = make(seed);
    if (clast_world_prepare(s.w)) {
        clast_world_free(s.w);
        return false;
    }
    double most = mechanical(s.w), start = most;
    for (int i = 0; i < 12; i++) {
        for (int k = 0; k < 60; k++)
            if (clast_world_step(s.w))
                fail_msg("seed %llu: %s", (unsigned long long)seed, clast_world_error(s.w));
        clast_energy e = clast_world_energy(s.w);
        double now = mechanical(s.w) + e.removed;
        if (!s.driven && !(now <= most + 2e-3 * (e.input + 1e-9)))
            fail_msg("seed %llu: energy grows from %.9g to %.9g J (start %.9g, input %.3g)",
                     (unsigned long long)seed, most, now, start, e.input);
        if (!(fabs(e.residual) <= 5e-3 * (e.input + 1e-9)))
            fail_msg("seed %llu: residual %.3g of %.3g J", (unsigned long long)seed, e.residual,
                     e.input);
        if (!s.driven) most = fmin(most, now);
        clast_counters c = clast_world_counters(s.w);
        if ((int)(c.bodies + c.removed) != s.bodies)
            fail_msg("seed %llu: a body is lost", (unsigned long long)seed);
    }
    clast_world_free(s.w);
    return true;
}

static void random_scenes_keep_the_rules(void **state) {
    (void)state;
    int used = 0;
    uint64_t seed = 1;
    for (; used < SCENES && seed < 10 * SCENES; seed++) used += check_scene(seed);
    print_message("%d scenes of %llu seeds\n", used, (unsigned long long)seed);
    assert_true(used == SCENES);
}

TEST_MAIN(cmocka_unit_test(random_scenes_keep_the_rules))
