/* Feeds and outlets: how much comes and when, where it is put, what is kept of who came and went,
 * books, restarts, and the same bits. */
#include "tests/support/scene.h"

static const double R = 0.005;

enum { KINDS = 3 };

typedef struct plant {
    clast_world *w;
    int feed, outlet;
    int kind[KINDS];
} plant;

typedef struct plant_wish {
    int threads, per_thread; /* 0: 1 */
    clast_isa isa;
    double skin, rate, until; /* rate 0: a usual one; until 0: without end */
    clast_full full;
    bool clumps;
    double walled; /* m: height of the floor, no outlet; 0: bodies fall into the outlet */
} plant_wish;

/* Bodies of three sizes rain into a box without a floor. */
static plant new_plant(const plant_wish *wish) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    def.time_step = 1e-4;
    def.threads = wish->threads ? wish->threads : 1;
    def.spheres_per_thread = wish->per_thread ? wish->per_thread : 1;
    def.isa = wish->isa, def.skin = wish->skin;
    def.domain_min = vec(-0.1, -0.1, -0.5), def.domain_max = vec(0.1, 0.1, 0.2);
    plant p = {.w = new_world(&def)};
    clast_pair_def pair = pair_of(0.3, 0.4);
    two_materials m = add_materials(p.w, &pair);
    for (int k = 0; k < KINDS - wish->clumps; k++)
        p.kind[k] = clast_shape_add_sphere(p.w, "ball", R * (0.8 + 0.2 * k), m.soft);
    if (wish->clumps) p.kind[KINDS - 1] = add_triangle(p.w, m.soft, 0.5 * R);
    int box = clast_part_add(p.w, &(clast_part_def){.name = "box"});
    add_plane(p.w, box, m.hard, vec(-0.03, 0, 0), vec(1, 0, 0));
    add_plane(p.w, box, m.hard, vec(0.03, 0, 0), vec(-1, 0, 0));
    add_plane(p.w, box, m.hard, vec(0, -0.03, 0), vec(0, 1, 0));
    add_plane(p.w, box, m.hard, vec(0, 0.03, 0), vec(0, -1, 0));
    if (wish->walled != 0) add_plane(p.w, box, m.hard, vec(0, 0, wish->walled), vec(0, 0, 1));
    const double share[KINDS] = {3, 2, 1};
    clast_feed_def feed = {.name = "hopper",
                           .region_min = {-0.03, -0.03, 0.05},
                           .region_max = {0.03, 0.03, 0.08},
                           .shapes = KINDS,
                           .shape = p.kind,
                           .share = share,
                           .mass_rate = wish->rate > 0 ? wish->rate : 0.05,
                           .from = 0.01,
                           .until = wish->until,
                           .velocity = {0.1, -0.2, -0.3},
                           .spin = {5, 0, 0},
                           .turned = wish->clumps,
                           .full = wish->full};
    p.feed = clast_feed_add(p.w, &feed);
    clast_outlet_def out = {.name = "end", .point = {0, 0, -0.2}, .normal = {0, 0, -2}};
    p.outlet = clast_outlet_add(p.w, &out);
    if (p.feed < 0 || p.outlet < 0) fail_msg("%s", clast_world_error(p.w));
    return p;
}

static double mass_inside(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    double mass = 0;
    for (size_t i = 0; i < b.count; i++) mass += b.mass[i];
    return mass;
}

/* ---- how much -------------------------------------------------------------------------------- */

/* Never more than the rate times the time and one body, and never behind by more than a step. */
static void a_feed_keeps_its_rate(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.threads = 1});
    double heaviest = 0;
    for (int k = 0; k < KINDS; k++) heaviest = fmax(heaviest, clast_world_shape(p.w, k).mass);
    for (int i = 0; i < 5000; i++) {
        steps(p.w, 1);
        double due = 0.05 * (clast_world_time(p.w) - 0.01);
        clast_flow f = clast_world_feed_flow(p.w, p.feed);
        if (due < 0) {
            assert_true(f.bodies == 0 && f.owed == 0);
            continue;
        }
        if (f.refused == 0 && !(f.mass > due && f.mass <= due + heaviest))
            fail_msg("%.9g kg at %.6g s, due %.9g", f.mass, clast_world_time(p.w), due);
        if (i % 500) continue;
        clast_flow out = clast_world_outlet_flow(p.w, p.outlet);
        clast_counters c = clast_world_counters(p.w);
        assert_int_equal(f.bodies, out.bodies + c.bodies);
        assert_int_equal(c.fed, f.bodies);
        CHECK_NEAR(f.mass - out.mass, mass_inside(p.w), 1e-15);
    }
    clast_flow f = clast_world_feed_flow(p.w, p.feed);
    print_message("fed %llu bodies, refused %llu times\n", (unsigned long long)f.bodies,
                  (unsigned long long)f.refused);
    assert_true(f.bodies > 30 && clast_world_outlet_flow(p.w, p.outlet).bodies > 20);
    clast_world_free(p.w);
}

static void a_feed_of_numbers_begins_and_ends(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.time_step = 1e-4;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    clast_feed_def feed = {.name = "drops",
                           .region_min = {-5, -5, 0},
                           .region_max = {5, 5, 0},
                           .shapes = 1,
                           .shape = &ball,
                           .number_rate = 100,
                           .from = 0.125,
                           .until = 0.375};
    assert_int_equal(clast_feed_add(w, &feed), 0);
    run_to(w, 0.1248);
    assert_int_equal(clast_world_counters(w).bodies, 0);
    run_to(w, 0.1755); /* at 0.125, 0.135, ... */
    assert_int_equal(clast_world_counters(w).bodies, 6);
    run_to(w, 0.6); /* the last is due when the feed ends */
    assert_int_equal(clast_world_counters(w).bodies, 26);
    clast_bodies b = clast_world_bodies(w);
    for (size_t i = 0; i < b.count; i++) assert_true(b.z[i] == 0);
    clast_world_free(w);
}

/* Kinds come with their shares: within four standard deviations of 3 : 2 : 1. */
static void kinds_come_with_their_shares(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.rate = 0.5});
    double count[KINDS] = {0}, n = 0;
    clast_passage all[64];
    while (n < 1000) {
        steps(p.w, 10);
        for (size_t got; (got = clast_world_arrivals(p.w, all, 64)) > 0;)
            for (size_t i = 0; i < got; i++) count[all[i].shape]++, n++;
    }
    for (int k = 0; k < KINDS; k++) {
        double share = (3.0 - k) / 6;
        CHECK_NEAR(count[k] / n, share, 4 * sqrt(share * (1 - share) / n));
    }
    clast_world_free(p.w);
}

/* ---- where ----------------------------------------------------------------------------------- */

/* Nothing overlaps anything when it comes; it has the velocity that was asked for. */
static void bodies_arrive_clear_of_others(void **state) {
    (void)state;
    for (int clumps = 0; clumps < 2; clumps++) {
        plant p = new_plant(&(plant_wish){.rate = 0.5, .clumps = clumps});
        clast_passage one[64]; /* what is owed may come at once */
        int arrivals = 0;
        for (int i = 0; i < 6000; i++) {
            steps(p.w, 1);
            size_t n = clast_world_arrivals(p.w, one, 64);
            for (size_t k = 0; k < n; k++) {
                arrivals++;
                assert_int_equal(one[k].step, clast_world_steps(p.w));
                body_state b = body_of(p.w, (int)one[k].id);
                assert_true(norm(minus(b.position, one[k].position)) == 0);
                CHECK_NEAR(norm(minus(b.velocity, vec(0.1, -0.2, -0.3))), 0, 1e-14);
                CHECK_NEAR(norm(minus(b.spin, vec(5, 0, 0))), 0, 1e-12);
                clast_contact c[64];
                size_t contacts = clast_world_contacts(p.w, c, 64);
                for (size_t j = 0; j < contacts && j < 64; j++)
                    assert_true(c[j].a != one[k].id && c[j].b != one[k].id);
            }
        }
        assert_true(arrivals > 100);
        clast_world_free(p.w);
    }
}

/* Orientations are drawn from all: the mean of the square of each component of an axis is a third.
 */
static void clumps_arrive_turned(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.rate = 0.5, .clumps = true});
    double sum[3] = {0}, n = 0;
    while (n < 100) {
        clast_passage one[8];
        steps(p.w, 1);
        size_t got = clast_world_arrivals(p.w, one, 8);
        for (size_t i = 0; i < got; i++) {
            clast_quat q = body_of(p.w, (int)one[i].id).orientation;
            CHECK_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1, 1e-12);
            double z = 1 - 2 * (q.x * q.x + q.y * q.y);
            sum[0] += z, sum[1] += z * z, n++;
        }
    }
    CHECK_NEAR(sum[0] / n, 0, 4 / sqrt(3 * n));
    CHECK_NEAR(sum[1] / n, 1.0 / 3, 4 * sqrt(4.0 / 45 / n));
    clast_world_free(p.w);
}

/* ---- no room --------------------------------------------------------------------------------- */

/* A box that fills up: the feed waits, says how much it owes, and the run goes on. */
static void a_full_feed_waits(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.rate = 1, .walled = 0.04});
    run_to(p.w, 0.3);
    clast_flow f = clast_world_feed_flow(p.w, p.feed);
    assert_true(f.refused > 5 && f.bodies > 20);
    CHECK_CLOSE(f.owed, 1 * (clast_world_time(p.w) - 0.01) - f.mass, 1e-12);
    assert_int_equal(clast_world_counters(p.w).bodies, f.bodies);
    clast_world_free(p.w);
}

static void a_full_feed_may_stop_the_run(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.rate = 1, .walled = 0.04, .full = CLAST_FULL_STOP});
    assert_int_equal(clast_world_run(p.w, 0.3), CLAST_ERR_GUARD);
    assert_non_null(strstr(clast_world_error(p.w), "feed hopper found no room for a ball in 100"));
    clast_world_free(p.w);
}

/* ---- records --------------------------------------------------------------------------------- */

/* Every body that left had come, with the same mass, and was beyond the outlet for the first time.
 */
static void who_left_had_come(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.threads = 1});
    static double came[200];
    static int kind[200];
    clast_passage one[4];
    size_t left = 0;
    for (int i = 0; i < 5000; i++) {
        steps(p.w, 1);
        size_t waiting = clast_world_arrivals(p.w, NULL, 0);
        assert_int_equal(waiting > 0, clast_world_arrivals(p.w, one, 1) > 0);
        if (waiting > 0 && one[0].step == clast_world_steps(p.w) && one[0].gate == p.feed) {
            came[one[0].id] = one[0].mass, kind[one[0].id] = one[0].shape;
            CHECK_NEAR(one[0].time, clast_world_time(p.w), 0);
        }
        size_t n = clast_world_departures(p.w, one, 4);
        for (size_t k = 0; k < n; k++, left++) {
            assert_true(one[k].gate == p.outlet && one[k].mass == came[one[k].id]);
            assert_true(one[k].shape == kind[one[k].id]);
            assert_true(one[k].position.z < -0.2 && one[k].velocity.z < 0);
            CHECK_NEAR(one[k].position.z, -0.2, -1.01 * one[k].velocity.z * 1e-4);
            assert_false(body_of(p.w, (int)one[k].id).present);
        }
    }
    assert_int_equal(left, clast_world_outlet_flow(p.w, p.outlet).bodies);
    clast_world_free(p.w);
}

static void a_box_and_the_domain_take_bodies(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.time_step = 1e-3;
    def.outside = CLAST_OUTSIDE_REMOVE;
    def.domain_min = vec(-1, -1, -1), def.domain_max = vec(1, 1, 1);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    clast_outlet_def box = {
        .name = "box", .kind = CLAST_OUTLET_BOX, .min = {0.1, -0.1, -0.1}, .max = {0.2, 0.1, 0.1}};
    assert_int_equal(clast_outlet_add(w, &box), 0);
    add_body(w, ball, vec(0, 0, 0), vec(1, 0, 0), vec(0, 0, 0));
    add_body(w, ball, vec(0, 0.3, 0), vec(2.5, 0, 0), vec(0, 0, 0));
    run_to(w, 0.5);
    clast_passage gone[4];
    assert_int_equal(clast_world_departures(w, gone, 4), 2);
    assert_true(gone[0].id == 0 && gone[0].gate == 0);
    CHECK_NEAR(gone[0].time, 0.1, 1.1e-3);
    assert_true(gone[1].id == 1 && gone[1].gate == CLAST_OUTLET_DOMAIN);
    CHECK_NEAR(gone[1].time, 0.4, 1.1e-3);
    assert_int_equal(clast_world_outlet_flow(w, CLAST_OUTLET_DOMAIN).bodies, 1);
    assert_int_equal(clast_world_outlet_flow(w, 0).bodies, 1);
    assert_int_equal(clast_world_departures(w, gone, 4), 0);
    clast_world_free(w);
}

/* ---- books ----------------------------------------------------------------------------------- */

static void books_close_over_coming_and_going(void **state) {
    (void)state;
    for (int clumps = 0; clumps < 2; clumps++) {
        plant p = new_plant(&(plant_wish){.rate = 0.3, .clumps = clumps});
        run_to(p.w, 0.6);
        clast_energy e = clast_world_energy(p.w);
        double total = e.kinetic + e.rotational + e.gravity + e.elastic + e.damping + e.friction +
                       e.global + e.removed - e.fed;
        print_message("fed %.4g J, removed %.4g J, residual %.2e of the input\n", e.fed, e.removed,
                      fabs(e.residual) / e.input);
        CHECK_NEAR(total, e.residual, 1e-9 * e.input);
        CHECK_BELOW(fabs(e.residual), 5e-3 * e.input);
        assert_true(e.fed > 0 && e.removed > 0 && e.damping > 0 && e.friction > 0);
        clast_world_free(p.w);
    }
}

/* Nothing but free fall: what came is what is there and what left, to rounding. */
static void free_fall_is_booked_to_rounding(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0.3, 0, -9.81);
    def.time_step = 1e-4;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.3, 0.4);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    clast_feed_def feed = {.name = "drops",
                           .region_min = {-1, -1, 0},
                           .region_max = {1, 1, 0.5},
                           .shapes = 1,
                           .shape = &ball,
                           .number_rate = 50,
                           .spin = {1, 2, 3},
                           .velocity = {0.4, 0, 0.2}};
    clast_outlet_def out = {.name = "end", .point = {0, 0, -0.5}, .normal = {0, 0, -1}};
    assert_true(clast_feed_add(w, &feed) >= 0 && clast_outlet_add(w, &out) >= 0);
    run_to(w, 1);
    clast_energy e = clast_world_energy(w);
    assert_true(clast_world_outlet_flow(w, 0).bodies > 10 && e.kinetic > 0);
    CHECK_NEAR(e.residual, 0, 1e-12 * e.input);
    CHECK_NEAR(e.friction, 0, 1e-12 * e.input);
    clast_world_free(w);
}

/* ---- the same bits --------------------------------------------------------------------------- */

static uint64_t hash_of(const plant_wish *wish) {
    plant p = new_plant(wish);
    run_to(p.w, 0.25);
    assert_true(clast_world_outlet_flow(p.w, p.outlet).bodies > 3);
    uint64_t hash = clast_world_hash(p.w);
    clast_world_free(p.w);
    return hash;
}

static void any_threads_skin_and_lanes(void **state) {
    (void)state;
    for (int clumps = 0; clumps < 2; clumps++) {
        plant_wish wish = {.rate = 0.5, .clumps = clumps};
        uint64_t want = hash_of(&wish);
        wish.threads = 3;
        assert_true(hash_of(&wish) == want);
        wish.threads = 1, wish.skin = 0.003;
        assert_true(hash_of(&wish) == want);
        wish.skin = 0, wish.isa = CLAST_ISA_BASELINE;
        assert_true(hash_of(&wish) == want);
    }
}

/* A feed fills an empty world and stops, and an outlet empties it: threads come and go with the
 * bodies, and nobody sees it. */
static void threads_come_and_go(void **state) {
    (void)state;
    plant_wish wish = {.rate = 0.2, .until = 0.15};
    plant alone = new_plant(&wish);
    wish.threads = 3, wish.per_thread = 3;
    plant p = new_plant(&wish);
    int most = 0, changes = 0, last = 0;
    for (int i = 0; i < 5000; i++) {
        steps(alone.w, 1), steps(p.w, 1);
        int now = clast_world_plan(p.w).threads, bodies = (int)clast_world_counters(p.w).bodies;
        if (i == 0) assert_int_equal(now, 1);
        if (bodies < 5 && now > 1) fail_msg("%d threads for %d bodies", now, bodies);
        changes += i > 0 && now != last;
        most = now > most ? now : most, last = now;
    }
    print_message("%d threads at most, %d at the end, %d changes, %zu bodies left\n", most, last,
                  changes, clast_world_counters(p.w).bodies);
    assert_true(most == 3 && last == 1 && clast_world_counters(p.w).bodies == 0);
    assert_true(clast_world_hash(p.w) == clast_world_hash(alone.w));
    clast_world_free(alone.w), clast_world_free(p.w);
}

/* A thread comes with its last sphere and goes when a fifth of its spheres is missing. */
static void a_thread_stays_for_a_fifth(void **state) {
    (void)state;
    enum { EACH = 10, UP = 2 * EACH, DOWN = UP - UP / 5 };
    plant p = new_plant(&(plant_wish){.rate = 0.4, .until = 0.2, .threads = 2, .per_thread = EACH});
    int last = 1, rises = 0, falls = 0, kept[3] = {0};
    for (int i = 0; i < 6000; i++) {
        int before = (int)clast_world_counters(p.w).spheres;
        steps(p.w, 1);
        int now = clast_world_plan(p.w).threads, spheres = (int)clast_world_counters(p.w).spheres;
        if (now > last && ++rises) assert_true(before >= UP || spheres >= UP);
        if (now < last && ++falls) assert_true(before < DOWN || spheres < DOWN);
        kept[now] += spheres > DOWN && spheres < UP;
        last = now;
    }
    print_message("%d rises, %d falls; between, %d steps with one thread and %d with two\n", rises,
                  falls, kept[1], kept[2]);
    assert_true(rises > 0 && falls == rises && kept[1] > 0 && kept[2] > 0);
    clast_world_free(p.w);
}

/* Save, load, go on: the same state, and the records that had not been read. */
static void a_restart_feeds_on(void **state) {
    (void)state;
    plant_wish wish = {.rate = 0.5, .clumps = true};
    plant p = new_plant(&wish);
    clast_passage one[8], other[8];
    run_to(p.w, 0.1);
    while (clast_world_arrivals(p.w, one, 8) > 0) {
    }
    run_to(p.w, 0.2);
    scratch_name file = scratch_file("flow.h5");
    assert_int_equal(clast_checkpoint_save(p.w, file.text, NULL), CLAST_OK);
    plant q = new_plant(&wish);
    if (clast_checkpoint_load(q.w, file.text, NULL)) fail_msg("%s", clast_world_error(q.w));
    remove(file.text);
    run_to(p.w, 0.3), run_to(q.w, 0.3);
    assert_true(clast_world_hash(p.w) == clast_world_hash(q.w));
    clast_counters a = clast_world_counters(p.w), b = clast_world_counters(q.w);
    assert_true(a.fed == b.fed && a.removed == b.removed && a.bodies == b.bodies);
    size_t n = clast_world_arrivals(p.w, NULL, 0);
    assert_true(n > 8 && clast_world_arrivals(q.w, NULL, 0) == n);
    for (size_t got; (got = clast_world_arrivals(p.w, one, 8)) > 0;) {
        assert_int_equal(clast_world_arrivals(q.w, other, 8), got);
        for (size_t i = 0; i < got; i++)
            assert_true(one[i].id == other[i].id && one[i].time == other[i].time &&
                        one[i].position.x == other[i].position.x);
    }
    clast_world_free(p.w), clast_world_free(q.w);
}

/* Pairs pushed together, of which some fly into the outlet; later bodies are fed. */
static clast_world *new_leavers(void) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.time_step = 1e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.3, 0.4);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    for (int i = 0; i < 20; i++) {
        double side = i % 2 ? 1 : -1, z = 0.05 * (i / 2);
        add_body(w, ball, vec(0.98 * R * side, 0, z), vec(0, i < 12 ? 2 : 0, 0), vec(0, 0, 0));
    }
    clast_feed_def feed = {.name = "late",
                           .region_min = {-0.2, -0.2, -0.2},
                           .region_max = {0.2, -0.1, -0.1},
                           .shapes = 1,
                           .shape = &ball,
                           .number_rate = 2000,
                           .from = 6e-3};
    clast_outlet_def out = {.name = "end", .point = {0, 0.01, 0}, .normal = {0, 1, 0}};
    assert_true(clast_feed_add(w, &feed) >= 0 && clast_outlet_add(w, &out) >= 0);
    return w;
}

/* A world that goes on has felt its bodies of the start, and has fewer afterwards: who comes then
 * feels nothing of them. */
static void a_restart_forgets_its_start(void **state) {
    (void)state;
    clast_world *w = new_leavers();
    scratch_name file = scratch_file("leavers.h5");
    run_to(w, 5.5e-3);
    assert_int_equal(clast_world_bodies(w).count, 8);
    assert_int_equal(clast_checkpoint_save(w, file.text, NULL), CLAST_OK);
    clast_world *again = new_leavers();
    if (clast_checkpoint_load(again, file.text, NULL)) fail_msg("%s", clast_world_error(again));
    run_to(w, 8e-3), run_to(again, 8e-3);
    assert_true(clast_world_counters(w).fed > 3);
    assert_true(clast_world_hash(w) == clast_world_hash(again));
    clast_world_free(w), clast_world_free(again);
    remove(file.text);
}

static void a_restart_knows_its_feed(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.rate = 0.5});
    run_to(p.w, 0.05);
    scratch_name file = scratch_file("flow.h5");
    assert_int_equal(clast_checkpoint_save(p.w, file.text, NULL), CLAST_OK);
    plant q = new_plant(&(plant_wish){.rate = 0.4});
    assert_int_equal(clast_checkpoint_load(q.w, file.text, NULL), CLAST_ERR_MISMATCH);
    assert_non_null(strstr(clast_world_error(q.w), "feed hopper"));
    remove(file.text);
    clast_world_free(p.w), clast_world_free(q.w);
}

/* A world through which many pass holds no more than one with few in it: what grows is four bytes
 * for each id. */
static void memory_does_not_grow_with_who_left(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.rate = 0.5});
    clast_passage all[64];
    size_t early = 0, bodies = 0;
    for (int i = 0; i < 40; i++) {
        run_to(p.w, 0.1 * (i + 1));
        while (clast_world_arrivals(p.w, all, 64) > 0) {
        }
        while (clast_world_departures(p.w, all, 64) > 0) {
        }
        clast_counters c = clast_world_counters(p.w);
        if (i == 9) early = c.bytes, bodies = c.fed;
        if (i == 39) {
            print_message("%zu bytes after %zu bodies, %zu after %zu\n", early, bodies, c.bytes,
                          c.fed);
            assert_true(c.fed > 3 * bodies);
            CHECK_BELOW((double)c.bytes, 1.2 * (double)early + 8.0 * (double)c.fed);
        }
    }
    clast_world_free(p.w);
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void expect_feed(clast_world *w, const clast_feed_def *d, const char *want) {
    assert_int_equal(clast_feed_add(w, d), -1);
    if (!strstr(clast_world_error(w), want)) fail_msg("%s", clast_world_error(w));
}

static void bad_definitions_are_refused(void **state) {
    (void)state;
    plant p = new_plant(&(plant_wish){.threads = 1});
    clast_feed_def good = clast_world_feed(p.w, p.feed), d = good;
    d.mass_rate = 0;
    expect_feed(p.w, &d, "one of the two");
    d = good, d.number_rate = 3;
    expect_feed(p.w, &d, "one of the two");
    d = good, d.region_max.z = 0;
    expect_feed(p.w, &d, "corner below");
    d = good, d.until = 0.01;
    expect_feed(p.w, &d, "ends before");
    d = good, d.shapes = 0;
    expect_feed(p.w, &d, "no shape");
    d = good, d.orientation.w = 3;
    expect_feed(p.w, &d, "unit quaternion");
    assert_int_equal(clast_outlet_add(p.w, &(clast_outlet_def){.name = "o"}), -1);
    assert_non_null(strstr(clast_world_error(p.w), "outlet o has no normal"));
    d = good, d.region_max.z = 0.3;
    assert_true(clast_feed_add(p.w, &d) >= 0);
    assert_int_equal(clast_world_prepare(p.w), CLAST_ERR_ARGUMENT);
    assert_non_null(strstr(clast_world_error(p.w), "reaches out of the domain"));
    clast_world_free(p.w);
}

static void other_schemes_take_no_feed(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.scheme = CLAST_SCHEME_BDF2;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    clast_feed_def feed = {.name = "drops", .shapes = 1, .shape = &ball, .number_rate = 1};
    assert_int_equal(clast_feed_add(w, &feed), 0);
    assert_int_equal(clast_world_prepare(w), CLAST_ERR_ARGUMENT);
    assert_non_null(strstr(clast_world_error(w), "feeds need the leapfrog"));
    clast_world_free(w);
}

TEST_MAIN(cmocka_unit_test(a_feed_keeps_its_rate),
          cmocka_unit_test(a_feed_of_numbers_begins_and_ends),
          cmocka_unit_test(kinds_come_with_their_shares),
          cmocka_unit_test(bodies_arrive_clear_of_others), cmocka_unit_test(clumps_arrive_turned),
          cmocka_unit_test(a_full_feed_waits), cmocka_unit_test(a_full_feed_may_stop_the_run),
          cmocka_unit_test(who_left_had_come), cmocka_unit_test(a_box_and_the_domain_take_bodies),
          cmocka_unit_test(books_close_over_coming_and_going),
          cmocka_unit_test(free_fall_is_booked_to_rounding),
          cmocka_unit_test(any_threads_skin_and_lanes), cmocka_unit_test(threads_come_and_go),
          cmocka_unit_test(a_thread_stays_for_a_fifth), cmocka_unit_test(a_restart_feeds_on),
          cmocka_unit_test(a_restart_forgets_its_start), cmocka_unit_test(a_restart_knows_its_feed),
          cmocka_unit_test(memory_does_not_grow_with_who_left),
          cmocka_unit_test(bad_definitions_are_refused),
          cmocka_unit_test(other_schemes_take_no_feed))
