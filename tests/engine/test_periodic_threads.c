/* Worlds with periodic axes: the same bits for any number of threads, any skin and any lanes, after
 * a restart; what a gas and a flow in them must keep. */
#include "tests/support/cell.h"

#include "engine/world.h"

enum { STEPS = 1500 };

static void expect(const cell_wish *wish, uint64_t want, const char *what) {
    uint64_t got = cell_hash(wish, STEPS);
    if (got != want)
        fail_msg("%s: hash %016llx, not %016llx", what, (unsigned long long)got,
                 (unsigned long long)want);
}

static cell_wish wish_of(int kind) {
    cell_wish c = {.periodic = {true, kind != 1, kind == 2}, .law = (clast_law)kind, .threads = 1};
    c.clump_contact = kind < 2 ? CLAST_CLUMP_SHARED : CLAST_CLUMP_EACH;
    return c;
}

static void any_threads_skin_and_lanes(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        cell_wish c = wish_of(kind);
        uint64_t want = cell_hash(&c, STEPS);
        c.threads = 3, expect(&c, want, "three threads");
        c.threads = 2, c.skin = 1e-5, expect(&c, want, "two threads and a thin skin");
        c.threads = 1, c.skin = 0.01, expect(&c, want, "a thick skin");
        c.isa = CLAST_ISA_BASELINE, expect(&c, want, "baseline");
        c.isa = CLAST_ISA_AVX2, expect(&c, want, "avx2");
    }
}

/* Storage stirred now and then: names decide. */
static void any_order_of_storage(void **state) {
    (void)state;
    cell_wish c = wish_of(2);
    uint64_t want = cell_hash(&c, STEPS);
    clast_world *w = cell_new(&c);
    for (int i = 0; i < STEPS; i++) {
        steps(w, 1);
        if (i % 61) continue;
        uint32_t order[CELL_BODIES];
        for (uint32_t k = 0; k < CELL_BODIES; k++) order[k] = (k * 11 + (uint32_t)i) % CELL_BODIES;
        carry_lists(w);
        body_permute(w, order);
        lists_rebuild(w);
        contacts_restore(w);
    }
    assert_true(clast_world_hash(w) == want);
    clast_world_free(w);
}

static void restart_of(cell_wish c, uint64_t count) {
    uint64_t want = cell_hash(&c, 2 * count);
    scratch_name file = scratch_file("periodic.h5");
    clast_world *w = cell_new(&c);
    steps(w, count);
    assert_int_equal(clast_checkpoint_save(w, file.text, NULL), CLAST_OK);
    clast_world_free(w);
    w = cell_new(&c);
    if (clast_checkpoint_load(w, file.text, NULL)) fail_msg("%s", clast_world_error(w));
    steps(w, count);
    assert_true(clast_world_hash(w) == want);
    clast_world_free(w);
    c.periodic[0] = false; /* another scene */
    w = cell_new(&c);
    assert_int_equal(clast_checkpoint_load(w, file.text, NULL), CLAST_ERR_MISMATCH);
    assert_non_null(strstr(clast_world_error(w), "periodic along x"));
    clast_world_free(w);
    remove(file.text);
}

/* At many places of a run, among them steps that end beyond a face. */
static void as_if_never_stopped(void **state) {
    (void)state;
    for (uint64_t i = 0; i < 6; i++) restart_of(wish_of((int)i % 3), 333 + 101 * i);
    cell_wish c = {.periodic = {true, true, false}, .law = CLAST_LAW_LINEAR};
    for (uint64_t i = 0; i < 4; i++) {
        c.scheme = i % 2 ? CLAST_SCHEME_GEAR4 : CLAST_SCHEME_VELOCITY_VERLET;
        restart_of(c, 211 + 57 * i);
    }
}

/* ---- a gas ----------------------------------------------------------------------------------- */

enum { SIDE = 5, GAS = SIDE * SIDE * SIDE };

static clast_world *gas(void) {
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    double cell = 0.0142;
    def.domain_min = vec(0, 0, 0), def.domain_max = vec(SIDE * cell, SIDE * cell, SIDE * cell);
    for (int k = 0; k < 3; k++) def.periodic[k] = true;
    def.time_step = 4e-6, def.skin = 0.002;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
    dice d = {5, 0};
    for (int i = 0; i < GAS; i++) {
        clast_vec3 at = times(cell, vec(i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE));
        double e = 0.2 * cell;
        at = plus(at, vec(roll(&d, 0, e), roll(&d, 0, e), roll(&d, 0, e)));
        add_body(w, ball, at, vec(roll(&d, -1, 1), 0, 0), vec(0, 0, 0));
    }
    return w;
}

static clast_vec3 momentum(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    clast_vec3 p = {0, 0, 0};
    for (size_t i = 0; i < b.count; i++)
        p = plus(p, times(b.mass[i], vec(b.vx[i], b.vy[i], b.vz[i])));
    return p;
}

static void add_squares(clast_world *w, double sum[3]) {
    clast_bodies b = clast_world_bodies(w);
    const double *v[3] = {b.vx, b.vy, b.vz};
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < b.count; i++) sum[k] += v[k][i] * v[k][i];
}

/* Elastic spheres that all move along x at first. Momentum is kept to the rounding of the
 * velocities, energy to the order of the scheme. After some twenty collisions each, a direction has
 * a third of the motion: one reading of 3 x 125 numbers scatters by sqrt(2 / 125 x 2 / 3) = 0.10
 * about it, and 20 readings with a collision or two between them by 0.025 to 0.03; four of that are
 * allowed. */
static void a_gas_keeps_what_it_has_and_forgets_the_rest(void **state) {
    (void)state;
    clast_world *w = gas();
    steps(w, 1);
    clast_vec3 before = momentum(w);
    double motion = motion_energy(w), sum[3] = {0, 0, 0};
    steps(w, 15000);
    for (int i = 0; i < 20; i++) steps(w, 750), add_squares(w, sum);
    double size = sqrt(2 * motion * clast_world_bodies(w).mass[0] * GAS);
    CHECK_BELOW(norm(minus(momentum(w), before)), 1e-14 * size);
    clast_energy e = clast_world_energy(w);
    CHECK_NEAR(e.kinetic + e.elastic, motion, 2e-3 * motion);
    CHECK_NEAR(e.residual, 0, 2e-3 * motion);
    double all = sum[0] + sum[1] + sum[2];
    print_message("shares of the motion %.4f %.4f %.4f, residual %.1e\n", sum[0] / all,
                  sum[1] / all, sum[2] / all, e.residual / motion);
    for (int k = 0; k < 3; k++) CHECK_NEAR(3 * sum[k] / all, 1, 0.12);
    clast_world_free(w);
}

/* ---- a flow ---------------------------------------------------------------------------------- */

/* A chute at 24 degrees, periodic along the flow and across it: spheres over ridges that span it,
 * soft and dissipative. */
typedef struct chute {
    clast_world *w;
    double length, width;
    int bodies;
} chute;

#define GRAIN 0.005 /* m, radius */

static void add_ridges(clast_world *w, int bottom, int of, double length, double width, int n) {
    double pitch = length / n, height = 0.6 * GRAIN, half = 0.5 * pitch * 0.98;
    for (int i = 0; i < 2 * n; i++) {
        double up = i % 2 ? -1 : 1, slope = height / half;
        clast_vec3 at = {pitch * (i / 2 + 0.5) - up * 0.5 * half, 0.5 * width, 0.5 * height};
        clast_wall_def side = {.name = "ridge",
                               .kind = CLAST_WALL_PLATE,
                               .material = of,
                               .normal = {-up * slope, 0, 1},
                               .side = {0, 1, 0},
                               .point = at,
                               .half_side = {0.5 * width, 0.5 * hypot(half, height)}};
        if (clast_wall_add(w, bottom, &side) < 0) fail_msg("%s", clast_world_error(w));
    }
}

static chute chute_new(int across) {
    chute c = {.length = 12.6 * GRAIN, .width = 2.1 * GRAIN * across};
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    double tilt = 24 * 3.14159265358979 / 180;
    def.gravity = vec(9.81 * sin(tilt), 0, -9.81 * cos(tilt));
    def.domain_min = vec(0, 0, -0.01), def.domain_max = vec(c.length, c.width, 0.3);
    def.periodic[0] = def.periodic[1] = true;
    def.time_step = 4e-5, def.max_residual = 0.2;
    c.w = new_world(&def);
    clast_pair_def pair = {.restitution = 0.6, .friction = 0.5, .stiffness = 600};
    two_materials m = add_materials(c.w, &pair);
    int ball = clast_shape_add_sphere(c.w, "ball", GRAIN, m.hard);
    int bottom = clast_part_add(c.w, &(clast_part_def){.name = "bottom"});
    add_plane(c.w, bottom, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    add_ridges(c.w, bottom, m.hard, c.length, c.width, 5);
    dice d = {3, 0};
    for (c.bodies = 0; c.bodies < 6 * across * 7; c.bodies++) {
        int i = c.bodies % 6, j = c.bodies / 6 % across, k = c.bodies / 6 / across;
        add_body(c.w, ball,
                 vec(2.1 * GRAIN * (i + 0.5) + roll(&d, 0, 1e-5),
                     2.1 * GRAIN * (j + 0.5) + roll(&d, 0, 1e-5), GRAIN * (1.8 + 2.05 * k)),
                 vec(0.3, 0, 0), vec(0, 0, 0));
    }
    return c;
}

enum { LAYERS = 4 };

typedef struct flow {
    double speed, layer[LAYERS]; /* m/s: of all, and from below */
} flow;

static flow read_flow(chute *c) {
    clast_bodies b = clast_world_bodies(c->w);
    flow f = {0, {0}};
    int count[LAYERS] = {0};
    for (size_t i = 0; i < b.count; i++) {
        int k = (int)(b.z[i] / (3.5 * GRAIN));
        k = k < LAYERS ? k : LAYERS - 1;
        f.speed += b.vx[i] / (double)b.count;
        f.layer[k] += b.vx[i], count[k]++;
    }
    for (int k = 0; k < LAYERS; k++) f.layer[k] /= count[k] ? count[k] : 1;
    return f;
}

static flow mean_flow(chute *c, int readings, uint64_t apart) {
    flow mean = {0, {0}};
    for (int i = 0; i < readings; i++) {
        steps(c->w, apart);
        flow now = read_flow(c);
        mean.speed += now.speed / readings;
        for (int k = 0; k < LAYERS; k++) mean.layer[k] += now.layer[k] / readings;
    }
    return mean;
}

static double lost(clast_world *w) {
    clast_energy e = clast_world_energy(w);
    return e.damping + e.friction;
}

/* Once it is steady, what gravity does on the way goes into the contacts. */
static flow steady_flow(int across) {
    chute c = chute_new(across);
    mean_flow(&c, 1, 60000);
    double loss = -lost(c.w), fall = clast_world_energy(c.w).gravity;
    flow first = mean_flow(&c, 40, 500), second = mean_flow(&c, 40, 500);
    loss += lost(c.w), fall -= clast_world_energy(c.w).gravity;
    print_message("width %d: %.3f and %.3f m/s; layers %.3f %.3f %.3f %.3f; %.4f J of %.4f lost\n",
                  across, first.speed, second.speed, second.layer[0], second.layer[1],
                  second.layer[2], second.layer[3], loss, fall);
    CHECK_CLOSE(first.speed, second.speed, 0.1);
    CHECK_CLOSE(loss, fall, 0.05);
    for (int k = 1; k < LAYERS; k++) CHECK_BELOW(second.layer[k - 1], second.layer[k]);
    second.speed = 0.5 * (first.speed + second.speed);
    clast_world_free(c.w);
    return second;
}

/* Twice as wide it is another flow with the same mean, within what either scatters by. */
static void a_chute_flows_steadily(void **state) {
    (void)state;
    CHECK_CLOSE(steady_flow(3).speed, steady_flow(6).speed, 0.1);
}

TEST_MAIN(cmocka_unit_test(any_threads_skin_and_lanes), cmocka_unit_test(any_order_of_storage),
          cmocka_unit_test(as_if_never_stopped),
          cmocka_unit_test(a_gas_keeps_what_it_has_and_forgets_the_rest),
          cmocka_unit_test(a_chute_flows_steadily))
