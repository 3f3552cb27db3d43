/* The reach list and the contact list against brute force: whatever happens between two steps,
 * every pair that overlaps is in the contact list, once, and with its history. */
#include "tests/support/scene.h"

#include "engine/geometry.h"
#include "engine/world.h"

static const double R = 0.004;

/* ---- brute force ----------------------------------------------------------------------------- */

static int by_number(const void *left, const void *right) {
    const uint64_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

static uint64_t key_of(uint64_t a, uint64_t b) {
    return a << 32 | b;
}

/* Keys of the entries that touch, sorted. */
typedef struct key_list {
    size_t count, entries;
    uint64_t *key;
} key_list;

static key_list keys_of(const clast_world *w, bool walls) {
    key_list k = {0, 0, NULL};
    for (int t = 0; t < w->threads; t++)
        k.entries += walls ? w->shares[t].walls.count : w->shares[t].contacts.count;
    k.key = malloc((k.entries + 1) * sizeof *k.key);
    for (int t = 0; t < w->threads; t++) {
        const contact_list *l = walls ? &w->shares[t].walls : &w->shares[t].contacts;
        for (size_t i = 0; i < l->count; i++)
            if (contact_touches(w, l, i))
                k.key[k.count++] = key_of((uint64_t)l->a[i], (uint64_t)l->b[i]);
    }
    qsort(k.key, k.count, sizeof *k.key, by_number);
    return k;
}

static void demand_entry(const key_list *k, size_t a, size_t b, const char *kind, uint64_t seed,
                         const clast_world *w) {
    uint64_t key = key_of(a, b);
    if (bsearch(&key, k->key, k->count, sizeof key, by_number)) return;
    fail_msg("seed %llu, step %llu: %s %zu - %zu touch and are not listed",
             (unsigned long long)seed, (unsigned long long)w->step, kind, a, b);
}

static double overlap_of(const centre_row *a, const centre_row *b) {
    double dx = a->x - b->x, dy = a->y - b->y, dz = a->z - b->z;
    return (a->radius + b->radius) - sqrt(dx * dx + dy * dy + dz * dz);
}

/* Returns how many pairs of spheres touch. */
static size_t check_pairs(const clast_world *w, uint64_t seed) {
    key_list k = keys_of(w, false);
    size_t touching = 0;
    for (size_t a = 0; a < w->sphere_count; a++)
        for (size_t b = a + 1; b < w->sphere_count; b++) {
            if (body_of_sphere(w, a) == body_of_sphere(w, b)) continue;
            if (!(overlap_of(&w->rows.centre[a], &w->rows.centre[b]) > 0)) continue;
            demand_entry(&k, a, b, "spheres", seed, w);
            touching++;
        }
    if (touching != k.count)
        fail_msg("seed %llu, step %llu: %zu entries touch, %zu pairs do", (unsigned long long)seed,
                 (unsigned long long)w->step, k.count, touching);
    free(k.key);
    return touching;
}

/* The walls of a mesh that it touches and feels. */
static size_t check_walls_of(const clast_world *w, size_t sphere, const key_list *k,
                             uint64_t seed) {
    const centre_row *c = &w->rows.centre[sphere];
    vec3 centre = from_kernel(w, v3(c->x, c->y, c->z));
    wall_touch touch[64];
    wall room[64];
    size_t count = 0, felt = 0;
    int own[64];
    for (int i = 0; i < w->wall_count; i++) {
        if (!w->parts[w->walls[i].part].present) continue;
        assert_true(count < sizeof touch / sizeof *touch);
        touch[count] = touch_of_wall(wall_now(w, i, &room[count]), centre, c->radius);
        own[count] = i;
        count += touch[count].overlap > 0;
    }
    touches_settle(touch, count);
    for (size_t i = 0; i < count; i++) {
        if (touch[i].hidden) continue;
        demand_entry(k, sphere, (size_t)own[i], "sphere and wall", seed, w);
        felt++;
    }
    return felt;
}

static size_t check_walls(const clast_world *w, uint64_t seed) {
    key_list k = keys_of(w, true);
    size_t touching = 0;
    for (size_t s = 0; s < w->sphere_count; s++) touching += check_walls_of(w, s, &k, seed);
    if (touching != k.count)
        fail_msg("seed %llu, step %llu: %zu entries touch walls, %zu spheres do",
                 (unsigned long long)seed, (unsigned long long)w->step, k.count, touching);
    free(k.key);
    return touching;
}

static size_t check_lists(const clast_world *w, uint64_t seed) {
    return check_pairs(w, seed) + check_walls(w, seed);
}

/* ---- random clouds --------------------------------------------------------------------------- */

/* Guards only report, so that bodies may do what they like. */
static clast_world_def cloud_def(clast_law law) {
    clast_world_def def = bare_def(law);
    def.guards = CLAST_GUARD_REPORT;
    def.max_overlap = 1e9, def.max_displacement = 1e9, def.max_residual = 1e9;
    def.time_step = 2e-5;
    def.domain_min = vec(-0.1, -0.1, -0.1), def.domain_max = vec(0.1, 0.1, 0.1);
    def.outside = CLAST_OUTSIDE_REMOVE;
    def.spheres_per_thread = 1;
    return def;
}

/* A tetrahedron, or a strip of facets that are all joined smoothly. */
static void add_random_mesh(clast_world *w, dice *d, int of, int hard) {
    clast_vec3 corner[8];
    int32_t tetrahedron[12] = {0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    int32_t strip[18] = {0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4, 4, 5, 6, 5, 7, 6};
    for (int i = 0; i < 4; i++)
        corner[i] = vec(roll(d, -.1, .1), roll(d, -.1, .1), roll(d, -.1, .1));
    bool bent = corner[0].x > 0;
    for (int i = 7; i >= 0 && bent; i--)
        corner[i] = vec(.05 * (i / 2 - 1.5), .08 * (i % 2 - .5), -.06 + .1 * corner[i / 2].z);
    clast_mesh_def mesh = {.name = bent ? "strip" : "tetrahedron",
                           .material = hard,
                           .vertices = bent ? 8 : 4,
                           .triangles = bent ? 6 : 4,
                           .vertex = corner,
                           .triangle = bent ? strip : tetrahedron,
                           .smooth_angle = 1.2};
    if (clast_mesh_add(w, of, &mesh) < 0) fail_msg("%s", clast_world_error(w));
}

static void add_random_walls(clast_world *w, dice *d, int hard, double speed) {
    int walls = (int)roll(d, 0, 6);
    for (int i = 0; i < walls; i++) {
        clast_part_def p = {.name = "part",
                            .removed_at = roll(d, 0, 1) < .3 ? roll(d, 1e-4, 2e-3) : 0};
        if (roll(d, 0, 1) < .5) p.velocity = times(speed, vec(roll(d, -1, 1), 0, roll(d, -1, 1)));
        int group = clast_part_add(w, &p);
        clast_wall_def l = {.name = "wall",
                            .material = hard,
                            .normal = {roll(d, -1, 1), 0, 1},
                            .point = {0, 0, roll(d, -0.1, 0)},
                            .side = {0, 1, 0},
                            .half_side = {roll(d, .01, .1), roll(d, .01, .1)}};
        l.kind = roll(d, 0, 1) < .3 ? CLAST_WALL_PLANE : CLAST_WALL_PLATE;
        if (roll(d, 0, 1) < .3)
            add_random_mesh(w, d, group, hard);
        else
            assert_true(clast_wall_add(w, group, &l) >= 0);
    }
}

typedef struct cloud {
    clast_world *w;
    double speed;
    int bodies;
} cloud;

static int random_count(dice *d) {
    double kind = roll(d, 0, 1);
    return kind < .05 ? 0 : kind < .1 ? 1 : kind < .2 ? 3 : (int)roll(d, 5, 60);
}

static void add_random_bodies(cloud *c, dice *d, const int shapes[4], bool flat) {
    double spread = roll(d, 0, 1) < .2 ? 0.004 : roll(d, 0.01, 0.09); /* all in one cell, or not */
    for (int i = 0; i < c->bodies; i++) {
        clast_body_def b = {
            shapes[(int)roll(d, 0, 4)],
            {roll(d, -spread, spread), flat ? 0 : roll(d, -spread, spread),
             roll(d, -spread, spread)},
            {1, 0, 0, 0},
            times(c->speed, vec(roll(d, -1, 1), flat ? 0 : roll(d, -1, 1), roll(d, -1, 1))),
            {0, roll(d, -300, 300), 0}};
        if (flat)
            b.orientation = clast_quat_axis_angle(vec(0, 1, 0), roll(d, -3, 3));
        else
            b.orientation = any_orientation(d);
        assert_true(clast_body_add(c->w, &b) >= 0);
    }
}

static cloud random_cloud(uint64_t seed) {
    dice d = {seed, 0};
    clast_world_def def = cloud_def((clast_law)(int)roll(&d, 0, 3));
    bool flat = roll(&d, 0, 1) < .3;
    def.motion = flat ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D;
    def.threads = roll(&d, 0, 1) < .3 ? (int)roll(&d, 2, 12) : 1;
    def.skin = roll(&d, 0, 1) < .5 ? 0 : pow(10, roll(&d, -8, -1.5));
    def.precision = roll(&d, 0, 1) < .3 ? CLAST_PRECISION_MIXED : CLAST_PRECISION_DOUBLE;
    cloud c = {
        .w = new_world(&def), .speed = pow(10, roll(&d, -3, 2.8)), .bodies = random_count(&d)};
    clast_pair_def pair = pair_of(roll(&d, 0.05, 1), roll(&d, 0, 1) < .3 ? 0 : roll(&d, 0, 1));
    two_materials m = add_materials(c.w, &pair);
    double small = roll(&d, 0, 1) < .2 ? 0.02 * R : 0.4 * R;
    bool clumps = roll(&d, 0, 1) < .5;
    int shapes[4] = {clast_shape_add_sphere(c.w, "ball", R, m.soft),
                     clast_shape_add_sphere(c.w, "small", small, m.hard),
                     clumps ? add_rod(c.w, m.hard, R) : clast_shape_add_sphere(c.w, "c", R, m.hard),
                     clumps ? add_triangle(c.w, m.soft, .7 * R)
                            : clast_shape_add_sphere(c.w, "d", 2 * R, m.soft)};
    add_random_walls(c.w, &d, m.hard, c.speed);
    add_random_bodies(&c, &d, shapes, flat);
    return c;
}

/* A step too long for what has been put on top of each other: then there are no places. */
static bool has_blown_up(const clast_world *w) {
    return !(w->found.way < 0.1);
}

typedef struct cloud_count {
    size_t touching, steps, rebuilds, refreshes, removed, blown_up;
} cloud_count;

static void run_cloud(uint64_t seed, int steps_wanted, cloud_count *n) {
    cloud c = random_cloud(seed);
    for (int i = 0; i < steps_wanted; i++, n->steps++) {
        if (clast_world_step(c.w))
            fail_msg("seed %llu: %s", (unsigned long long)seed, clast_world_error(c.w));
        if (has_blown_up(c.w)) {
            n->blown_up++;
            break;
        }
        n->touching += check_lists(c.w, seed);
    }
    clast_counters k = clast_world_counters(c.w);
    if ((int)(k.bodies + k.removed) != c.bodies)
        fail_msg("seed %llu: a body is lost", (unsigned long long)seed);
    n->rebuilds += k.rebuilds, n->refreshes += k.refreshes, n->removed += k.removed;
    clast_world_free(c.w);
}

static void every_overlap_is_listed(void **state) {
    (void)state;
    enum { SEEDS = 50, STEPS = 60 };
    cloud_count n = {0};
    for (uint64_t seed = 1; seed <= SEEDS; seed++) run_cloud(seed, STEPS, &n);
    print_message("%zu steps: %zu contacts, %zu rebuilds, %zu refreshes, %zu bodies gone, %zu of "
                  "%d clouds blown up\n",
                  n.steps, n.touching, n.rebuilds, n.refreshes, n.removed, n.blown_up, SEEDS);
    assert_true(n.touching > n.steps && n.refreshes > 100 && n.removed > 100);
    assert_true(n.blown_up < SEEDS / 4);
}

/* ---- the corners of the cell grid ------------------------------------------------------------ */

/* Small worlds of spheres that a seed does not reach. */
static clast_world *ball_world(const clast_world_def *def, double radius, int *ball) {
    clast_world *w = new_world(def);
    clast_pair_def pair = pair_of(0.7, 0.4);
    *ball = clast_shape_add_sphere(w, "ball", radius, add_materials(w, &pair).soft);
    return w;
}

/* Two bodies touch; others are up to a thousand kilometres away. */
static void bodies_far_apart(void **state) {
    (void)state;
    for (int far = 1; far <= 9; far++) {
        clast_world_def def = cloud_def(CLAST_LAW_HERTZ_MINDLIN);
        double away = 0.01 * pow(10, far);
        def.domain_min = vec(-2 * away, -2 * away, -2 * away);
        def.domain_max = vec(2 * away, 2 * away, 2 * away);
        def.threads = 1 + far % 3;
        int ball;
        clast_world *w = ball_world(&def, R, &ball);
        add_body(w, ball, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        add_body(w, ball, vec(1.99 * R, 0, 0), vec(-1, 0, 0), vec(0, 0, 0));
        for (int i = 0; i < 8; i++)
            add_body(w, ball, times(away, vec(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)),
                     vec(0, 0, 0), vec(0, 0, 0));
        for (int i = 0; i < 20; i++) {
            steps(w, 1);
            check_lists(w, (uint64_t)far);
        }
        assert_int_equal(clast_world_counters(w).contacts, 1);
        clast_world_free(w);
    }
}

/* One boulder among grains a hundredth of its size, and the other way round. */
static void huge_ratios_of_size(void **state) {
    (void)state;
    clast_world_def def = cloud_def(CLAST_LAW_HERTZ_MINDLIN);
    def.threads = 2;
    dice d = {5, 0};
    int grain;
    clast_world *w = ball_world(&def, 0.0003, &grain);
    int boulder = clast_shape_add_sphere(w, "boulder", 0.03, 1);
    add_body(w, boulder, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
    for (int i = 0; i < 300; i++) {
        clast_vec3 n = {roll(&d, -1, 1), roll(&d, -1, 1), roll(&d, -1, 1)};
        add_body(w, grain, times(roll(&d, 0.0303, 0.032) / norm(n), n),
                 times(-roll(&d, 0, 5) / norm(n), n), vec(0, 0, 0));
    }
    size_t touching = 0;
    for (int i = 0; i < 300; i++) {
        steps(w, 1);
        touching += check_lists(w, 5);
    }
    print_message("boulder: %zu contacts\n", touching);
    assert_true(touching > 300);
    clast_world_free(w);
}

/* ---- many new contacts at once --------------------------------------------------------------- */

/* A lattice with gaps wider than the margin shrinks as a whole: contacts come by the thousand
 * within few steps, while the list is refreshed in place. */
static void a_lattice_closes_at_once(void **state) {
    (void)state;
    enum { N = 11 };
    for (int threads = 1; threads <= 3; threads += 2) {
        clast_world_def def = cloud_def(CLAST_LAW_HERTZ_MINDLIN);
        def.threads = threads, def.time_step = 1e-5;
        int ball;
        clast_world *w = ball_world(&def, R, &ball);
        for (int i = 0; i < N * N * N; i++) {
            clast_vec3 p = {i % N - N / 2, i / N % N - N / 2, i / (N * N) - N / 2};
            add_body(w, ball, times(2.05 * R, p), times(-0.9 * R / 1e-2, p), vec(0, 0, 0));
        }
        size_t before = 0, jump = 0, touching = 0;
        for (int i = 0; i < 150; i++) {
            steps(w, 1);
            size_t now = clast_world_counters(w).candidates;
            if (i > 0 && now > before + jump) jump = now - before;
            before = now;
            if (i % 5 == 0) touching = check_lists(w, (uint64_t)threads);
        }
        print_message("lattice: at most %zu new entries in a step, %zu contacts\n", jump, touching);
        assert_true(jump > 1000 && touching == 3 * N * N * (N - 1));
        clast_world_free(w);
    }
}

/* ---- ways ------------------------------------------------------------------------------------ */

/* Spheres that fly to and fro between two plates, far apart from each other: in all a hundred
 * radii, and never farther than a tenth of one from where they were. */
static void what_rattles_in_a_cage_goes_nowhere(void **state) {
    (void)state;
    enum { STEPS = 5000, BALLS = 8 };
    for (int threads = 1; threads <= 2; threads++) {
        clast_world_def def = cloud_def(CLAST_LAW_LINEAR);
        def.threads = threads, def.skin = 0.3 * R, def.gravity = vec(0, 0, 0);
        int ball;
        clast_world *w = ball_world(&def, R, &ball);
        clast_pair_def elastic = pair_of(1, 0);
        assert_int_equal(clast_pair_set(w, 0, 0, &elastic), CLAST_OK);
        int cage = clast_part_add(w, &(clast_part_def){.name = "cage"});
        add_plane(w, cage, 0, vec(-1.05 * R, 0, 0), vec(1, 0, 0));
        add_plane(w, cage, 0, vec(1.05 * R, 0, 0), vec(-1, 0, 0));
        for (int i = 0; i < BALLS; i++)
            add_body(w, ball, vec(0, 3 * R * (i - 3.5), 0), vec(1, 0, 0), vec(0, 0, 0));
        double path = 0;
        for (int i = 0; i < STEPS; i++) {
            steps(w, 1);
            path += w->found.way;
            if (i % 50 == 0) check_lists(w, (uint64_t)threads);
        }
        clast_counters c = clast_world_counters(w);
        print_message("cage: %.0f radii of way, %llu rebuilds\n", path / R,
                      (unsigned long long)c.rebuilds);
        assert_true(path > 20 * R);
        assert_int_equal(c.rebuilds, 2); /* at the start, and to learn the places */
        clast_world_free(w);
    }
}

/* ---- histories ------------------------------------------------------------------------------- */

typedef enum upset { NOTHING, REBUILD, REFRESH, BOTH } upset;

/* A bed that slides on a belt, upset before every step. */
static clast_world *sliding_bed(int threads, clast_precision precision, bool clumps) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0.7, -0.4, -9.81);
    def.threads = threads, def.spheres_per_thread = 1;
    def.precision = precision, def.time_step = 2e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.4, 0.5);
    two_materials m = add_materials(w, &pair);
    int shapes[2] = {clast_shape_add_sphere(w, "ball", R, m.soft),
                     clumps ? add_triangle(w, m.hard, .45 * R)
                            : clast_shape_add_sphere(w, "small", .8 * R, m.hard)};
    int group = clast_part_add(w, &(clast_part_def){.name = "tray"});
    clast_wall_def belt = {"belt", CLAST_WALL_PLANE, m.hard, .normal = {0, 0, 1},
                           .belt_velocity = {0.2, 0, 0}};
    assert_true(clast_wall_add(w, group, &belt) >= 0);
    for (int i = 0; i < 4; i++)
        add_plane(w, group, m.hard,
                  times(-0.017, vec(i == 0   ? 1
                                    : i == 1 ? -1
                                             : 0,
                                    i == 2   ? 1
                                    : i == 3 ? -1
                                             : 0,
                                    0)),
                  vec(i == 0   ? 1
                      : i == 1 ? -1
                               : 0,
                      i == 2   ? 1
                      : i == 3 ? -1
                               : 0,
                      0));
    dice d = {11, 0};
    for (int i = 0; i < 60; i++) {
        clast_body_def b = {
            shapes[i % 2],
            {.0085 * (i % 4 - 1.5), .0085 * (i / 4 % 4 - 1.5), .0045 + .0085 * (i / 16)},
            any_orientation(&d),
            {roll(&d, -.1, .1), roll(&d, -.1, .1), -.3},
            {roll(&d, -9, 9), roll(&d, -9, 9), 0}};
        assert_true(clast_body_add(w, &b) >= 0);
    }
    return w;
}

static uint64_t upset_hash(clast_world *w, upset u, double *sprung) {
    for (int i = 0; i < 700; i++) {
        if (i > 0 && (u == REBUILD || (u == BOTH && i % 3 == 0))) w->stale = true;
        if (i > 0 && (u == REFRESH || (u == BOTH && i % 2 == 0))) w->way.contacts.bound = INFINITY;
        steps(w, 1);
    }
    records_collect(w);
    *sprung = 0;
    for (size_t i = 0; i < w->records.count; i++)
        *sprung += v3_norm(w->records.items[i].history.spring);
    uint64_t hash = clast_world_hash(w);
    clast_world_free(w);
    return hash;
}

/* Rebuilds sort the bodies anew, change who is a and who is b, and cut the shares elsewhere. */
static void histories_survive_everything(void **state) {
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        clast_precision precision = kind % 2 ? CLAST_PRECISION_MIXED : CLAST_PRECISION_DOUBLE;
        double sprung;
        uint64_t want = upset_hash(sliding_bed(1, precision, kind / 2), NOTHING, &sprung);
        assert_true(sprung > 1e-3);
        for (upset u = REBUILD; u <= BOTH; u++)
            for (int threads = 1; threads <= 5; threads += 2) {
                uint64_t got = upset_hash(sliding_bed(threads, precision, kind / 2), u, &sprung);
                if (got != want)
                    fail_msg("kind %d, upset %d, %d threads: %016llx, not %016llx", kind, (int)u,
                             threads, (unsigned long long)got, (unsigned long long)want);
            }
    }
}

TEST_MAIN(cmocka_unit_test(every_overlap_is_listed), cmocka_unit_test(bodies_far_apart),
          cmocka_unit_test(huge_ratios_of_size), cmocka_unit_test(a_lattice_closes_at_once),
          cmocka_unit_test(histories_survive_everything),
          cmocka_unit_test(what_rattles_in_a_cage_goes_nowhere))
