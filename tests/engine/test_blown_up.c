/* Runs that have blown up under `guards = report`: bodies at 1e300 m, at infinity and nowhere. The
 * lists stay small, the steps end, and the others do not notice. */
#include "tests/support/scene.h"

#include "engine/cells.h"

enum { HEALTHY = 64, SICK = 7, STEPS = 1500 };

static const double R = 0.004;

/* Bodies above a floor, in a cube or in one layer; the last `sick` of them far from the rest. */
typedef struct wish {
    bool flat;
    int threads;
    clast_scheme scheme;
} wish;

static clast_world *bed(wish how, int sick) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    def.guards = CLAST_GUARD_REPORT;
    def.time_step = 2e-5;
    def.threads = how.threads, def.spheres_per_thread = 1;
    def.scheme = how.scheme;
    def.domain_min = vec(-0.5, -0.3, -0.2), def.domain_max = vec(0.7, 0.4, 1);
    if (how.flat) def.motion = CLAST_MOTION_IN_PLANE, def.plane_axis = 1;
    clast_world *w = new_world(&def);
    clast_pair_def law = pair_of(0.6, 0.4);
    two_materials m = add_materials(w, &law);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    int ground = clast_part_add(w, &(clast_part_def){.name = "ground"});
    add_plane(w, ground, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    dice d = {20260311, 0};
    for (int i = 0; i < HEALTHY; i++) {
        int row = how.flat ? 8 : 4;
        double gap = 2.1 * R, jitter = 0.04 * R, shift = how.flat ? 0 : roll(&d, -jitter, jitter);
        add_body(w, ball,
                 vec(gap * (i % row) + roll(&d, -jitter, jitter),
                     how.flat ? 0 : gap * (i / row % row) + shift,
                     1.2 * R + gap * (how.flat ? i / row : i / (row * row)) + roll(&d, 0, jitter)),
                 vec(roll(&d, -0.4, 0.4), 0, -0.4), vec(0, 0, 0));
    }
    for (int i = 0; i < sick; i++)
        add_body(w, ball, vec(-0.3 + 0.1 * i, 0, 0.7), vec(0, 0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

/* To be there after one step. */
static void send_off(clast_world *w) {
    const double x[SICK] = {1e300, 0, INFINITY, -INFINITY, NAN, 0, -3e9};
    const double z[SICK] = {-1e300, INFINITY, 0, -INFINITY, 0, NAN, 1e14};
    for (int i = 0; i < SICK; i++) {
        int32_t slot = w->slot_of_id[HEALTHY + i];
        w->bodies.vx[slot] = x[i] / w->dt;
        w->bodies.vz[slot] = z[i] / w->dt;
    }
}

static void demand_small_grid(const clast_world *w) {
    const cell_grid *g = &w->cells.grid;
    size_t cells = (size_t)g->x.count * (size_t)g->y.count * (size_t)g->z.count;
    assert_true(g->x.count > 0 && g->y.count > 0 && g->z.count > 0);
    assert_true(cells <= 4 * w->bodies.count + 64);
}

static void the_others_do_not_notice(wish how) {
    clast_world *alone = bed(how, 0), *w = bed(how, SICK);
    send_off(w);
    for (int i = 0; i < STEPS; i++) {
        assert_int_equal(clast_world_step(w), CLAST_OK);
        demand_small_grid(w);
    }
    size_t most = 0;
    for (int i = 0; i < STEPS; i++) {
        steps(alone, 1);
        size_t now = contact_count(alone);
        most = now > most ? now : most;
    }
    assert_true(clast_world_counters(w).guard_trips > 0);
    CHECK_BELOW(20, (double)most); /* they do meet */
    for (int id = 0; id < HEALTHY; id++) {
        body_state a = body_of(alone, id), b = body_of(w, id);
        assert_true(a.present && b.present);
        assert_memory_equal(&a.position, &b.position, sizeof a.position);
        assert_memory_equal(&a.velocity, &b.velocity, sizeof a.velocity);
        assert_memory_equal(&a.spin, &b.spin, sizeof a.spin);
    }
    clast_world_energy(w), clast_world_contacts(w, NULL, 0);
    clast_world_free(alone);
    clast_world_free(w);
}

static void bodies_far_away_or_nowhere(void **state) {
    (void)state;
    the_others_do_not_notice((wish){.flat = false, .threads = 1});
    the_others_do_not_notice((wish){.flat = true, .threads = 1});
}

static void bodies_far_away_or_nowhere_threads(void **state) {
    (void)state;
    the_others_do_not_notice((wish){.flat = false, .threads = 3});
}

/* These ask for lists at trial states, before anybody has left the domain. */
static void trials_far_away_or_nowhere(void **state) {
    (void)state;
    the_others_do_not_notice((wish){.threads = 1, .scheme = CLAST_SCHEME_VELOCITY_VERLET});
    the_others_do_not_notice((wish){.threads = 1, .scheme = CLAST_SCHEME_GEAR4});
}

/* Nobody left whose place is a number. */
static void all_of_them_nowhere(void **state) {
    (void)state;
    clast_world *w = bed((wish){.threads = 1}, 0);
    for (size_t i = 0; i < w->bodies.count; i++)
        w->bodies.vx[i] = w->bodies.vy[i] = w->bodies.vz[i] = NAN;
    for (int i = 0; i < 50; i++) {
        assert_int_equal(clast_world_step(w), CLAST_OK);
        demand_small_grid(w);
    }
    clast_world_free(w);
}

/* A place is in the cell that it lies in, or in the nearest one at the edge. */
static void places_stay_in_the_grid(void **state) {
    (void)state;
    cell_grid g = {{-1, 0.25, 8, false}, {0, 0.25, 3, false}, {2, 0.25, 5, false}};
    const double odd[] = {-INFINITY, -1e300, -7, NAN, 0.1, 9, 1e300, INFINITY};
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 8; k++) {
            cell_place p = cell_at(&g, odd[i], odd[k], odd[7 - i]);
            assert_true(p.i >= 0 && p.i < g.x.count && p.j >= 0 && p.j < g.y.count);
            assert_true(p.k >= 0 && p.k < g.z.count);
        }
    cell_place inside = cell_at(&g, -0.3, 0.6, 2.3), outside = cell_at(&g, -9, 9, 1e300);
    assert_true(inside.i == 2 && inside.j == 2 && inside.k == 1);
    assert_true(outside.i == 0 && outside.j == 2 && outside.k == 4);
}

TEST_MAIN(cmocka_unit_test(bodies_far_away_or_nowhere),
          cmocka_unit_test(bodies_far_away_or_nowhere_threads),
          cmocka_unit_test(trials_far_away_or_nowhere), cmocka_unit_test(all_of_them_nowhere),
          cmocka_unit_test(places_stay_in_the_grid))
