/* What must not change: momentum, angular momentum, and energy without dissipation. */
#include "tests/support/scene.h"

typedef struct motion {
    clast_vec3 momentum, angular;
    double size_p, size_l; /* sums of magnitudes: what rounding is measured against */
} motion;

/* Inertia times spin, from the shape's principal moments. */
static clast_vec3 spin_momentum(clast_world *w, const body_state *b) {
    clast_vec3 i = clast_world_shape(w, b->shape).inertia, s = b->spin;
    clast_quat q = b->orientation;
    clast_vec3 x = {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z),
                    2 * (q.x * q.z - q.w * q.y)};
    clast_vec3 y = {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z),
                    2 * (q.y * q.z + q.w * q.x)};
    clast_vec3 z = cross(x, y);
    return plus(times(i.x * dot(s, x), x),
                plus(times(i.y * dot(s, y), y), times(i.z * dot(s, z), z)));
}

static motion motion_of(clast_world *w, int count) {
    motion m = {{0, 0, 0}, {0, 0, 0}, 0, 0};
    for (int id = 0; id < count; id++) {
        body_state b = body_of(w, id);
        clast_vec3 p = times(b.mass, b.velocity), l = cross(b.position, p),
                   own = spin_momentum(w, &b);
        m.momentum = plus(m.momentum, p);
        m.angular = plus(m.angular, plus(l, own));
        m.size_p += norm(p), m.size_l += norm(l) + norm(own);
    }
    return m;
}

enum { CLOUD = 40 };

/* A cloud that falls in on itself: spheres and clumps, friction and damping on. */
static clast_world *cloud(clast_law law, uint64_t seed) {
    clast_world_def def = bare_def(law);
    def.rayleigh_fraction = 0.5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.6, 0.35);
    two_materials m = add_materials(w, &pair);
    int shapes[4] = {clast_shape_add_sphere(w, "ball", 0.0067, m.soft), add_rod(w, m.hard, 0.004),
                     add_triangle(w, m.soft, 0.0037), add_uneven_rod(w, m.hard, 0.0042)};
    dice d = {seed, 0};
    for (int i = 0; i < CLOUD; i++) {
        clast_vec3 p = {0.027 * (i % 4 - 1.5), 0.027 * (i / 4 % 4 - 1.5), 0.027 * (i / 16 - 1)};
        clast_vec3 v =
            plus(times(-9.0, p), vec(roll(&d, -.1, .1), roll(&d, -.1, .1), roll(&d, -.1, .1)));
        clast_body_def b = {shapes[i % 4], p, any_orientation(&d), v,
                            {roll(&d, -9, 9), roll(&d, -9, 9), roll(&d, -9, 9)}};
        if (clast_body_add(w, &b) < 0) fail_msg("%s", clast_world_error(w));
    }
    return w;
}

static void check_cloud(clast_law law, uint64_t seed) {
    clast_world *w = cloud(law, seed);
    if (clast_world_prepare(w))
        fail_msg("seed %llu: %s", (unsigned long long)seed, clast_world_error(w));
    motion before = motion_of(w, CLOUD);
    size_t contacts = 0;
    while (clast_world_time(w) < 0.15) {
        steps(w, 50);
        contacts += contact_count(w);
    }
    if (contacts < 30) fail_msg("seed %llu: the cloud missed itself", (unsigned long long)seed);
    motion after = motion_of(w, CLOUD);
    CHECK_BELOW(norm(minus(after.momentum, before.momentum)), 3e-13 * before.size_p);
    CHECK_BELOW(norm(minus(after.angular, before.angular)), 3e-13 * before.size_l);
    clast_energy e = clast_world_energy(w);
    CHECK_BELOW(fabs(e.residual), 2e-3 * e.input);
    clast_world_free(w);
}

static void a_cloud_keeps_its_momenta(void **state) {
    (void)state;
    check_cloud(CLAST_LAW_HERTZ_MINDLIN, 11);
    check_cloud(CLAST_LAW_HERTZ_A00, 12);
    check_cloud(CLAST_LAW_LINEAR, 13);
}

/* An undamped ball on a floor for 200 bounces: the height comes back, without drift. */
static void a_long_bounce_does_not_drift(void **state) {
    (void)state;
    for (int l = 0; l < 3; l++) {
        clast_world_def def = bare_def((clast_law)l);
        def.gravity = vec(0, 0, -9.81);
        def.rayleigh_fraction = 1;
        def.contact_resolution = 60;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0.2);
        pair.stiffness = 900;
        two_materials m = add_materials(w, &pair);
        int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
        int part = clast_part_add(w, &(clast_part_def){.name = "floor"});
        add_plane(w, part, m.hard, vec(0, 0, 0), vec(0, 0, 1));
        add_body(w, ball, vec(0, 0, 0.0083), vec(0, 0, 0), vec(0, 0, 0));
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        double worst = 0;
        while (clast_world_time(w) < 20) {
            steps(w, 997);
            worst = fmax(worst, fabs(clast_world_energy(w).residual));
        }
        print_message("law %d: energy off by %.1e of m g h at most in 20 s\n", l,
                      worst / (body_of(w, 0).mass * 9.81 * 0.0033));
        CHECK_BELOW(worst, 2e-3 * body_of(w, 0).mass * 9.81 * 0.0033);
        clast_world_free(w);
    }
}

TEST_MAIN(cmocka_unit_test(a_cloud_keeps_its_momenta),
          cmocka_unit_test(a_long_bounce_does_not_drift))
