/* The pair list against brute force, over random clouds of clumps whose sizes stand 1 : 5. */
#include "tests/support/scene.h"

enum { SEEDS = 120, MOST = 4000 };

static clast_world *random_cloud(uint64_t seed, double skin) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.max_overlap = 1.9;
    def.time_step = 1e-6;
    def.skin = skin;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0.3);
    two_materials m = add_materials(w, &pair);
    int shapes[5] = {clast_shape_add_sphere(w, "small", 0.002, m.soft),
                     clast_shape_add_sphere(w, "large", 0.010, m.hard), add_rod(w, m.hard, 0.004),
                     add_triangle(w, m.soft, 0.0023), add_uneven_rod(w, m.hard, 0.006)};
    dice d = {seed, 0};
    int bodies = (int)roll(&d, 1, 60);
    double half = roll(&d, 0.01, 0.06), flat = roll(&d, 0, 1) < 0.3 ? 0.05 : 1;
    for (int i = 0; i < bodies; i++) {
        clast_vec3 p = {roll(&d, -half, half), flat * roll(&d, -half, half), roll(&d, -half, half)};
        clast_body_def b = {
            shapes[(int)roll(&d, 0, 5)], p, any_orientation(&d), {0, 0, 0}, {0, 0, 0}};
        assert_true(clast_body_add(w, &b) >= 0);
    }
    int part = clast_part_add(w, &(clast_part_def){.name = "walls"});
    add_plane(w, part, m.hard, vec(0, 0, -half), vec(roll(&d, -1, 1), 0.3, 1));
    clast_wall_add(w, part, &(clast_wall_def){"plate", CLAST_WALL_PLATE, m.soft, {0, 0, 0},
                                              {roll(&d, 0.1, 1), 0, 1}, {0, 1, 0},
                                              {half, 0.5 * half}, {0, 0, 0}});
    return w;
}

typedef struct name {
    uint32_t a, b;
    int32_t sphere_a, sphere_b;
    double overlap;
} name;

static int by_name(const void *left, const void *right) {
    const name *x = left, *y = right;
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    if (x->b != y->b) return x->b < y->b ? -1 : 1;
    if (x->sphere_a != y->sphere_a) return x->sphere_a < y->sphere_a ? -1 : 1;
    return (x->sphere_b > y->sphere_b) - (x->sphere_b < y->sphere_b);
}

static double clamped(double x, double limit) { return fmax(-limit, fmin(limit, x)); }

/* Overlap with a wall, written from its definition. */
static double wall_overlap(const clast_wall_def *d, clast_vec3 p, double r) {
    clast_vec3 n = d->normal, u = d->side, v = cross(n, u), from = minus(p, d->point);
    if (d->kind == CLAST_WALL_PLANE) return r - dot(from, n);
    clast_vec3 nearest = plus(times(clamped(dot(from, u), d->half_side[0]), u),
                              times(clamped(dot(from, v), d->half_side[1]), v));
    return r - norm(minus(from, nearest));
}

static int first_of(const clast_spheres *s, int sphere) {
    while (sphere > 0 && s->body[sphere - 1] == s->body[sphere]) sphere--;
    return sphere;
}

static size_t by_brute_force(clast_world *w, name *found) {
    clast_bodies b = clast_world_bodies(w);
    clast_spheres s = clast_world_spheres(w);
    size_t count = 0;
    for (int i = 0; i < (int)s.count; i++) {
        clast_vec3 p = {s.x[i], s.y[i], s.z[i]};
        uint32_t id = b.id[s.body[i]];
        int own = i - first_of(&s, i);
        for (int j = 0; j < (int)s.count; j++) {
            uint32_t other = b.id[s.body[j]];
            double overlap =
                s.radius[i] + s.radius[j] - norm(minus(p, vec(s.x[j], s.y[j], s.z[j])));
            if (other > id && overlap > 0)
                found[count++] = (name){id, other, own, j - first_of(&s, j), overlap};
        }
        for (int l = 0; l < clast_world_wall_count(w); l++) {
            clast_wall_def d = clast_world_wall(w, l);
            double overlap = wall_overlap(&d, p, s.radius[i]);
            if (overlap > 0)
                found[count++] = (name){id, CLAST_WALL_ID + (uint32_t)l, own, 0, overlap};
        }
        assert_true(count < MOST);
    }
    qsort(found, count, sizeof *found, by_name);
    return count;
}

static void compare(clast_world *w, uint64_t seed) {
    static name want[MOST];
    static clast_contact got[MOST];
    size_t n = by_brute_force(w, want), k = clast_world_contacts(w, got, MOST);
    if (n != k)
        fail_msg("seed %llu: %zu contacts, brute force finds %zu", (unsigned long long)seed, k, n);
    for (size_t i = 0; i < n; i++) {
        name g = {got[i].a, got[i].b, got[i].sphere_a, got[i].sphere_b, got[i].overlap};
        if (by_name(&g, &want[i]) != 0 || fabs(g.overlap - want[i].overlap) > 1e-15)
            fail_msg("seed %llu: contact %zu differs", (unsigned long long)seed, i);
    }
}

static bool prepared(clast_world *w) { return clast_world_prepare(w) == CLAST_OK; }

static void the_list_finds_what_brute_force_finds(void **state) {
    (void)state;
    int used = 0;
    for (uint64_t seed = 1; used < SEEDS; seed++) {
        clast_world *w = random_cloud(seed, seed % 3 == 0 ? 1e-5 : seed % 3 == 1 ? 0 : 0.01);
        if (prepared(w)) compare(w, seed), used++;
        else assert_non_null(strstr(clast_world_error(w), "overlap"));
        clast_world_free(w);
        if (seed > 100 * SEEDS) fail_msg("too few of the random clouds start");
    }
}

/* The same while bodies move, across rebuilds and with a skin that is never refreshed in vain. */
static void the_list_stays_complete_in_motion(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
        def.skin = seed % 2 ? 0 : 0.004;
        def.rayleigh_fraction = 1;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0.3);
        two_materials m = add_materials(w, &pair);
        int shapes[3] = {clast_shape_add_sphere(w, "s", 0.002, m.soft), add_rod(w, m.hard, 0.005),
                         add_uneven_rod(w, m.hard, 0.006)};
        dice d = {seed, 0};
        for (int i = 0; i < 27; i++) {
            clast_vec3 p = {0.026 * (i % 3 - 1), 0.026 * (i / 3 % 3 - 1), 0.026 * (i / 9 - 1)};
            clast_body_def b = {shapes[(int)roll(&d, 0, 3)], p, any_orientation(&d), times(-30, p),
                                {roll(&d, -90, 90), roll(&d, -90, 90), roll(&d, -90, 90)}};
            assert_true(clast_body_add(w, &b) >= 0);
        }
        int part = clast_part_add(w, &(clast_part_def){.name = "ram", .velocity = {0, 0, 0.4}});
        add_plane(w, part, m.hard, vec(0, 0, -0.06), vec(0, 0, 1));
        size_t seen = 0;
        for (int k = 0; k < 60; k++) {
            steps(w, 31);
            compare(w, seed);
            seen += contact_count(w);
        }
        if (seen < 20) fail_msg("seed %llu: hardly any contact", (unsigned long long)seed);
        assert_true(clast_world_counters(w).rebuilds > 3);
        clast_world_free(w);
    }
}

TEST_MAIN(cmocka_unit_test(the_list_finds_what_brute_force_finds),
          cmocka_unit_test(the_list_stays_complete_in_motion))
