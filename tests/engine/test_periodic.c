/* Periodic axes (S12 2.8.3). Numbers are chosen so that a way around the cell does not round
 * (tests/support/cell.h): then where the faces are, and how often the cell is repeated, must not
 * change a bit of what is relative to it. */
#include "tests/support/cell.h"

enum { STEPS = 2500 };

/* ---- the same bits --------------------------------------------------------------------------- */

typedef struct tracked {
    clast_vec3 position, velocity, spin; /* position: as if there were no faces */
    clast_quat orientation;
} tracked;

static void track_all(clast_world *w, const double length[3], tracked *to) {
    clast_bodies b = clast_world_bodies(w);
    for (size_t i = 0; i < b.count; i++) {
        double at[3] = {b.x[i], b.y[i], b.z[i]};
        for (int k = 0; k < 3; k++) at[k] += b.image[k] ? b.image[k][i] * length[k] : 0;
        to[b.id[i]] = (tracked){vec(at[0], at[1], at[2]),
                                vec(b.vx[i], b.vy[i], b.vz[i]),
                                vec(b.wx[i], b.wy[i], b.wz[i]),
                                {b.qw[i], b.qx[i], b.qy[i], b.qz[i]}};
    }
}

static void demand_alike(const tracked *a, const tracked *b, clast_vec3 shift, int id) {
    clast_vec3 off = minus(minus(b->position, a->position), shift);
    if (norm(off) != 0) fail_msg("body %d is off by %g %g %g m", id, off.x, off.y, off.z);
    assert_memory_equal(&a->velocity, &b->velocity, sizeof a->velocity);
    assert_memory_equal(&a->spin, &b->spin, sizeof a->spin);
    assert_memory_equal(&a->orientation, &b->orientation, sizeof a->orientation);
}

/* One cell against the same one elsewhere, or repeated. */
static void compare(const cell_wish *plain, const cell_wish *other, uint64_t count) {
    tracked a[CELL_BODIES], b[2 * CELL_BODIES];
    double one[3] = {CELL_LENGTH, CELL_LENGTH, CELL_LENGTH}, two[3];
    for (int k = 0; k < 3; k++) two[k] = (other->doubled == k + 1 ? 2 : 1) * CELL_LENGTH;
    clast_world *w = cell_new(plain), *v = cell_new(other);
    size_t met = 0;
    for (int part = 0; part < 100; part++) {
        steps(w, count / 100), steps(v, count / 100);
        track_all(w, one, a), track_all(v, two, b);
        int n = (int)clast_world_bodies(w).count, repeats = other->doubled ? 2 : 1;
        for (int i = 0; i < repeats * n; i++) {
            clast_vec3 away = {other->doubled == 1, other->doubled == 2, other->doubled == 3};
            away = times(i < n ? 0 : CELL_LENGTH, away);
            demand_alike(&a[i % n], &b[i], plus(minus(other->shift, plain->shift), away), i);
        }
        size_t now = clast_world_counters(w).contacts;
        assert_int_equal(clast_world_counters(v).contacts, (size_t)repeats * now);
        met += now;
    }
    CHECK_BELOW(40, (double)met); /* they do meet */
    clast_world_free(w), clast_world_free(v);
}

static const clast_vec3 SHIFT = {3 * 0x1p-8 + 5 * 0x1p-39, 0x1p-6 + 0x1p-7 + 0x1p-31,
                                 0x1p-5 - 0x1p-30};

/* Along the periodic axes of the wish. */
static clast_vec3 shift_of(const cell_wish *c) {
    return vec(c->periodic[0] ? SHIFT.x : 0, c->periodic[1] ? SHIFT.y : 0,
               c->periodic[2] ? SHIFT.z : 0);
}

static void compare_shifted(cell_wish plain, uint64_t count) {
    cell_wish other = plain;
    other.shift = shift_of(&plain);
    compare(&plain, &other, count);
}

static void where_the_faces_are_is_not_felt(void **state) {
    (void)state;
    for (int axes = 1; axes < 8; axes++) {
        cell_wish c = {.periodic = {axes & 1, axes & 2, axes & 4}, .law = (clast_law)(axes % 3)};
        c.spheres = axes % 2 == 0;
        c.clump_contact = axes == 3 ? CLAST_CLUMP_SHARED : CLAST_CLUMP_EACH;
        compare_shifted(c, STEPS);
    }
}

/* The bodies of one half of a cell twice as long are felt by those of the other as their own images
 * were. */
static void how_often_the_cell_is_repeated_is_not_felt(void **state) {
    (void)state;
    for (int axis = 1; axis <= 3; axis++)
        for (int spheres = 0; spheres < 2; spheres++) {
            cell_wish c = {.spheres = spheres, .law = (clast_law)(spheres + axis) % 3};
            c.periodic[axis - 1] = c.periodic[axis % 3] = true;
            cell_wish other = c;
            other.doubled = axis;
            if (axis == 1) c.no_plates = other.no_plates = true; /* they would be of other sizes */
            compare(&c, &other, 1500);
        }
}

static void any_scheme(void **state) {
    (void)state;
    static const clast_scheme schemes[] = {CLAST_SCHEME_VELOCITY_VERLET, CLAST_SCHEME_GEAR4,
                                           CLAST_SCHEME_BDF2, CLAST_SCHEME_NUMEROV_CENTRAL};
    for (int i = 0; i < 4; i++) {
        cell_wish c = {.periodic = {true, true, i % 2},
                       .spheres = i > 1,
                       .law = CLAST_LAW_LINEAR,
                       .scheme = schemes[i]};
        compare_shifted(c, 1000);
    }
}

static void in_a_plane_and_in_mixed_precision(void **state) {
    (void)state;
    cell_wish c = {.periodic = {true, false, false}, .motion = CLAST_MOTION_IN_PLANE};
    compare_shifted(c, 6 * STEPS);
    c = (cell_wish){.periodic = {true, true, true}, .precision = CLAST_PRECISION_MIXED};
    compare_shifted(c, STEPS);
}

/* ---- who touches whom ------------------------------------------------------------------------ */

enum { CROWD = 60 };

typedef struct crowd {
    clast_vec3 at[CROWD], length;
    double radius[CROWD];
    bool periodic[3];
} crowd;

static double nearest(double d, double length) {
    return d - length * round(d / length);
}

static bool do_touch(const crowd *c, int i, int j) {
    clast_vec3 d = minus(c->at[i], c->at[j]);
    if (c->periodic[0]) d.x = nearest(d.x, c->length.x);
    if (c->periodic[1]) d.y = nearest(d.y, c->length.y);
    if (c->periodic[2]) d.z = nearest(d.z, c->length.z);
    return norm(d) < c->radius[i] + c->radius[j];
}

static clast_world *crowd_world(crowd *c, dice *d) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    c->length = vec(roll(d, 0.0201, 0.15), roll(d, 0.0201, 0.15), roll(d, 0.0201, 0.15));
    def.domain_min = vec(-0.03, 0.4, -1);
    def.domain_max = plus(def.domain_min, c->length);
    for (int k = 0; k < 3; k++) c->periodic[k] = def.periodic[k] = roll(d, 0, 1) < 0.7;
    def.max_overlap = 100, def.time_step = 1e-6;
    def.threads = (int)roll(d, 1, 4), def.spheres_per_thread = 1;
    def.skin = roll(d, 0, 1) < 0.5 ? 0 : roll(d, 0, 0.01);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.5);
    two_materials m = add_materials(w, &pair);
    int large = clast_shape_add_sphere(w, "large", 0.005, m.soft);
    int small = clast_shape_add_sphere(w, "small", 0.002, m.hard);
    for (int i = 0; i < CROWD; i++) {
        clast_vec3 at = {roll(d, 0, c->length.x), roll(d, 0, c->length.y), roll(d, 0, c->length.z)};
        c->at[i] = plus(def.domain_min, at);
        c->radius[i] = i % 2 ? 0.005 : 0.002;
        add_body(w, i % 2 ? large : small, c->at[i], vec(0, 0, 0), vec(0, 0, 0));
    }
    return w;
}

/* Cells of one, two, three and many along each axis, against every pair. */
static void check_crowd(uint64_t seed) {
    dice d = {seed, 0};
    crowd c;
    clast_world *w = crowd_world(&c, &d);
    if (clast_world_prepare(w))
        fail_msg("seed %llu: %s", (unsigned long long)seed, clast_world_error(w));
    static clast_contact contacts[CROWD * CROWD];
    size_t got = clast_world_contacts(w, contacts, CROWD * CROWD), want = 0;
    for (int i = 0; i < CROWD; i++)
        for (int j = i + 1; j < CROWD; j++) {
            if (!do_touch(&c, i, j)) continue;
            if (want >= got || contacts[want].a != (uint32_t)i || contacts[want].b != (uint32_t)j)
                fail_msg("seed %llu: %d and %d do not touch", (unsigned long long)seed, i, j);
            clast_vec3 from = minus(contacts[want].point, c.at[i]);
            if (norm(from) > c.radius[i])
                fail_msg("seed %llu: the point is not at body %d", (unsigned long long)seed, i);
            want++;
        }
    if (want != got) fail_msg("seed %llu: %zu, not %zu", (unsigned long long)seed, got, want);
    clast_world_free(w);
}

static void all_pairs_across_faces_are_found(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) check_crowd(seed);
}

/* ---- falls and walls ------------------------------------------------------------------------- */

static clast_world *lonely(clast_vec3 gravity, bool along_z, clast_vec3 velocity, int *ball) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = gravity, def.time_step = 1e-4, def.max_displacement = 10;
    def.domain_min = vec(0, 0, 0), def.domain_max = vec(0.1, 0.03, 0.1);
    def.periodic[1] = true, def.periodic[2] = along_z;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.6, 0.5);
    two_materials m = add_materials(w, &pair);
    *ball = clast_shape_add_sphere(w, "ball", 0.006, m.soft);
    add_body(w, *ball, vec(0.05, 0.02, along_z ? 0.05 : 0.0059), velocity, vec(0, 0, 0));
    return w;
}

/* It goes on for ever, and its books close. */
static void an_endless_fall(void **state) {
    (void)state;
    int ball;
    clast_world *w = lonely(vec(0, 1.3, -9.81), true, vec(0, 0, 0), &ball);
    steps(w, 10000);
    clast_bodies b = clast_world_bodies(w);
    double t = clast_world_time(w), y = 0.02 + 0.65 * t * t, z = 0.05 - 4.905 * t * t;
    CHECK_NEAR(b.y[0] + 0.03 * b.image[1][0], y, 1e-12 * y);
    CHECK_NEAR(b.z[0] + 0.1 * b.image[2][0], z, 1e-10);
    assert_true(b.image[0] == NULL && b.image[1][0] > 10 && b.image[2][0] < -40);
    assert_true(b.y[0] >= 0 && b.y[0] <= 0.03 && b.z[0] >= 0 && b.z[0] <= 0.1);
    clast_energy e = clast_world_energy(w);
    CHECK_CLOSE(e.kinetic, 0.5 * b.mass[0] * (1.69 + 96.2361) * t * t, 1e-6);
    CHECK_NEAR(e.residual, 0, 1e-12 * e.input);
    clast_world_free(w);
}

typedef enum floor_kind { PLANE, PLATE, TWO_PLATES, BAR, OPEN_BAR } floor_kind;

/* A bar along y from low to high, its top at z = 0; closed at its ends or not. */
static void add_bar(clast_world *w, int part, int material, double low, double high, bool open) {
    clast_vec3 corner[8];
    for (int i = 0; i < 8; i++)
        corner[i] = vec(i & 1 ? 0.09 : 0.01, i & 2 ? high : low, i & 4 ? 0 : -0.02);
    static const int32_t faces[36] = {4, 5, 7, 4, 7, 6, 0, 3, 1, 0, 2, 3, 0, 4, 6, 0, 6, 2,
                                      1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};
    clast_mesh_def mesh = {.name = "bar",
                           .material = material,
                           .vertices = 8,
                           .triangles = open ? 8 : 12,
                           .vertex = corner,
                           .triangle = faces};
    if (clast_mesh_add(w, part, &mesh) < 0) fail_msg("%s", clast_world_error(w));
}

static void add_floor(clast_world *w, floor_kind kind) {
    int part = clast_part_add(w, &(clast_part_def){.name = "floor"});
    if (kind == PLANE) add_plane(w, part, 1, vec(0.05, 0, 0), vec(0, 0, 1));
    if (kind == BAR) add_bar(w, part, 1, 0, 0.03, false);
    if (kind == OPEN_BAR) add_bar(w, part, 1, -0.5, 0.53, true);
    if (kind != PLATE && kind != TWO_PLATES) return;
    clast_wall_def plate = {.name = "one",
                            .kind = CLAST_WALL_PLATE,
                            .material = 1,
                            .normal = {0, 0, 1},
                            .side = {0, 1, 0},
                            .point = {0.05, 0.015, 0},
                            .half_side = {0.015, 0.04}};
    if (kind == TWO_PLATES) plate.half_side[0] = 0.0075, plate.point.y = 0.0075;
    assert_true(clast_wall_add(w, part, &plate) >= 0);
    plate.name = "two", plate.point.y = 0.0225;
    if (kind == TWO_PLATES) assert_true(clast_wall_add(w, part, &plate) >= 0);
}

/* A ball that rolls around the cell meets no edge at a face, be the floor cut there or not. */
static void a_floor_without_end(void **state) {
    (void)state;
    for (floor_kind kind = PLATE; kind <= OPEN_BAR; kind++) {
        int ball;
        clast_vec3 g = {0, 0.4, -9.81}, v = {0, 0.3, 0};
        clast_world *w = lonely(g, false, v, &ball), *plain = lonely(g, false, v, &ball);
        add_floor(w, kind), add_floor(plain, PLANE);
        for (int i = 0; i < 8000; i++) {
            steps(w, 1), steps(plain, 1);
            body_state a = body_of(plain, 0), b = body_of(w, 0);
            if (kind == TWO_PLATES) { /* the spring begins anew at their seam */
                CHECK_NEAR(b.position.z, a.position.z, 1e-9);
                continue;
            }
            CHECK_NEAR(b.position.z, a.position.z, 1e-13);
            CHECK_NEAR(b.velocity.y, a.velocity.y, 1e-10);
            assert_int_equal(clast_world_counters(w).contacts,
                             clast_world_counters(plain).contacts);
        }
        assert_true(clast_world_bodies(w).image[1][0] > 5);
        clast_world_free(w), clast_world_free(plain);
    }
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void demand_refusal(clast_world *w, const char *part_of_message) {
    assert_int_equal(clast_world_prepare(w), CLAST_ERR_ARGUMENT);
    if (!strstr(clast_world_error(w), part_of_message))
        fail_msg("found '%s', expected '%s'", clast_world_error(w), part_of_message);
    clast_world_free(w);
}

static void what_cannot_be_is_refused(void **state) {
    (void)state;
    int ball;
    clast_world *w = lonely(vec(0, 0, 0), true, vec(0, 0, 0), &ball);
    clast_shape_add_sphere(w, "boulder", 0.0076, 0);
    demand_refusal(w, "periodic along y and 30 mm long, expected two cells of the largest body's "
                      "15.2 mm");
    w = lonely(vec(0, 0, 0), true, vec(0, 0, 0), &ball);
    int part = clast_part_add(w, &(clast_part_def){.name = "part"});
    add_plane(w, part, 0, vec(0, 0, 0), vec(0, 1e-3, 1));
    demand_refusal(w, "normal has a component along y");
    w = lonely(vec(0, 0, 0), false, vec(0, 0, 0), &ball);
    part = clast_part_add(w, &(clast_part_def){.name = "part"});
    add_bar(w, part, 0, 0.001, 0.029, false);
    demand_refusal(w, "neither spans the domain nor leaves room");
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.motion = CLAST_MOTION_IN_PLANE, def.plane_axis = 2, def.periodic[2] = true;
    assert_null(clast_world_new(&def));
    assert_non_null(strstr(clast_world_new_error(), "across the plane of motion"));
}

/* A tile of bumps as long as the cell would be felt on one side of a face alone. */
static void a_bumpy_tile_is_refused(void **state) {
    (void)state;
    int ball;
    clast_world *w = lonely(vec(0, 0, 0), false, vec(0, 0, 0), &ball);
    int part = clast_part_add(w, &(clast_part_def){.name = "part"});
    clast_vec3 corner[6] = {{0, 0, 0},          {0.1, 0, 0},    {0.1, 0.015, -0.005},
                            {0, 0.015, -0.005}, {0.1, 0.03, 0}, {0, 0.03, 0}};
    static const int32_t faces[12] = {0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5};
    clast_mesh_def tile = {.name = "tile",
                           .material = 0,
                           .vertices = 6,
                           .triangles = 4,
                           .vertex = corner,
                           .triangle = faces};
    assert_int_equal(clast_mesh_add(w, part, &tile), 2);
    demand_refusal(w, "not the same all along");
}

TEST_MAIN(cmocka_unit_test(where_the_faces_are_is_not_felt),
          cmocka_unit_test(how_often_the_cell_is_repeated_is_not_felt),
          cmocka_unit_test(any_scheme), cmocka_unit_test(in_a_plane_and_in_mixed_precision),
          cmocka_unit_test(all_pairs_across_faces_are_found), cmocka_unit_test(an_endless_fall),
          cmocka_unit_test(a_floor_without_end), cmocka_unit_test(what_cannot_be_is_refused),
          cmocka_unit_test(a_bumpy_tile_is_refused))
