/* Curved surfaces of flat facets against what they stand for: one contact with a smooth patch,
 * which goes from facet to facet with its memory; two where the patch bends round the sphere. */
#include "tests/support/surface.h"

#include "engine/geometry.h"
#include "engine/numbers.h"

static const double ALONE = -1; /* smooth_angle: every facet for itself */

/* ---- a cylinder of facets: what a sphere feels ----------------------------------------------- */

typedef struct cylinder_errors {
    double force, direction; /* of those at the cylinder */
    double twice;            /* share of the angles at which two facets are felt */
} cylinder_errors;

enum { ANGLES = 2880 };

/* A sphere of `r` that overlaps a cylinder of radius 0.1 by 4 % of r, inside or outside of it. */
static cylinder_errors errors_of_cylinder(int n, bool inside, double smooth_angle) {
    double radius = 0.1, r = 0.02, overlap = 0.04 * r;
    int patches, many = 0;
    clast_world *w = feeling_world(tube_surface(radius, 0.1, n, true), smooth_angle, &patches);
    cylinder_errors e = {0, 0, 0};
    for (int i = 0; i < ANGLES; i++) {
        double sine, cosine, away = inside ? radius - r + overlap : radius + r - overlap;
        clast_sincos(2 * NUMBER_PI * (i + 0.31) / ANGLES, &sine, &cosine);
        clast_vec3 out = vec(cosine, sine, 0);
        feeling f = feel(w, plus(times(away, out), vec(0, 0, 0.003)), r);
        double size = norm(f.push);
        e.force = fmax(e.force, fabs(size / pow(overlap, 1.5) - 1));
        e.direction =
            fmax(e.direction, norm(plus(times(1 / size, f.push), times(inside ? 1 : -1, out))));
        many += f.walls > 1;
        assert_true(f.walls >= 1);
    }
    e.twice = (double)many / ANGLES;
    clast_world_free(w);
    return e;
}

/* The force has the error of the distance to the facets: second order. Its direction turns with
 * the facets: first order, as it swings about that of the cylinder. */
static void a_cylinder_is_felt_once(void **state) {
    (void)state;
    for (int inside = 0; inside < 2; inside++) {
        cylinder_errors e[4];
        for (int i = 0; i < 4; i++) {
            e[i] = errors_of_cylinder(64 << i, inside, 0);
            assert_true(e[i].twice == 0);
        }
        print_message("%s of a cylinder of 64, 128, 256, 512 facets: force off by %.1e %.1e %.1e "
                      "%.1e, direction by %.1e %.1e %.1e %.1e\n",
                      inside ? "inside" : "outside", e[0].force, e[1].force, e[2].force, e[3].force,
                      e[0].direction, e[1].direction, e[2].direction, e[3].direction);
        for (int i = 1; i < 3; i++) {
            CHECK_NEAR(order_of(e[i].force, e[i + 1].force, 2), 2, 0.1);
            CHECK_NEAR(order_of(e[i].direction, e[i + 1].direction, 2), 1, 0.1);
        }
    }
}

/* What the patch is for: facets for themselves push twice around every seam, however fine. */
static void facets_for_themselves_push_twice(void **state) {
    (void)state;
    double radius = 0.1, r = 0.02;
    cylinder_errors e = errors_of_cylinder(512, true, ALONE);
    CHECK_NEAR(e.twice, radius / (radius - r + .04 * r) - 1, 0.02);
    CHECK_NEAR(e.force, 1, 0.02);
}

/* Joined below the angle, apart above it: 360 / 11 and 360 / 10 degrees. */
static void the_angle_decides(void **state) {
    (void)state;
    for (int n = 10; n <= 11; n++) {
        int patches;
        clast_world *w = feeling_world(tube_surface(0.1, 0.1, n, false), 0, &patches);
        double half = NUMBER_PI / n, sine, cosine;
        clast_sincos(half, &sine, &cosine);
        /* on the bisector of the seam at angle 0 */
        feeling f = feel(w, vec((0.1 * cosine - 0.0192) / cosine, 0, 0), 0.02);
        assert_int_equal(f.walls, n == 10 ? 2 : 1);
        CHECK_CLOSE(f.deepest, 0.0008, 1e-9);
        clast_world_free(w);
    }
}

/* ---- surfaces of their own ------------------------------------------------------------------- */

/* A floor that a fillet joins to a wall: `n` facets over the right angle, `fillet` (m) its radius.
 */
static surface *channel_surface(double fillet, int n) {
    surface *s = empty_surface();
    for (int i = -1; i <= n + 1; i++) {
        double sine, cosine, turn = i < 0 ? 0 : i > n ? 1 : (double)i / n;
        clast_sincos(turn * NUMBER_PI / 2, &sine, &cosine);
        clast_vec3 p = vec(-fillet + fillet * sine, 0, fillet - fillet * cosine);
        if (i < 0) p.x = -0.2;
        if (i > n) p.z = 0.2;
        for (int side = -1; side <= 1; side += 2) add_vertex(s, plus(p, vec(0, 0.1 * side, 0)));
    }
    for (int i = 0; i < n + 2; i++) {
        int32_t a = 2 * i;
        add_face(s, a, a + 2, a + 1), add_face(s, a + 2, a + 3, a + 1);
    }
    return s;
}

/* A sphere on the floor and against the wall feels both, as in a sharp corner, though all is one
 * smooth patch. One that fits into the fillet feels the fillet. */
static void a_fillet_keeps_floor_and_wall_apart(void **state) {
    (void)state;
    double r = 0.02, down = 3e-4, aside = 2e-4;
    int patches;
    clast_world *w = feeling_world(channel_surface(0.004, 6), 0, &patches);
    assert_int_equal(patches, 8);
    assert_true(w->walls[0].smooth == 0 && w->walls[7].smooth == 0);
    feeling f = feel(w, vec(-r + aside, 0, r - down), r);
    assert_int_equal(f.walls, 2);
    CHECK_CLOSE(f.push.z, pow(down, 1.5), 1e-9);
    CHECK_CLOSE(f.push.x, -pow(aside, 1.5), 1e-9);
    f = feel(w, vec(-0.004, 0, 0.004), 0.004 + 1e-5);
    assert_int_equal(f.walls, 1);
    clast_world_free(w);
}

/* The two sides of a tube that a sphere fills. */
static void both_sides_of_a_tube(void **state) {
    (void)state;
    int patches;
    surface *s = empty_surface();
    /* a flat tube: half circles of radius 0.02 whose ends are 0.04 apart */
    enum { HALF_FACETS = 16 };
    for (int i = 0; i < 2 * (HALF_FACETS + 1); i++) {
        double sine, cosine;
        bool right = i > HALF_FACETS;
        int k = right ? i - HALF_FACETS - 1 : i;
        clast_sincos(NUMBER_PI * ((double)k / HALF_FACETS + (right ? 1.5 : 0.5)), &sine, &cosine);
        clast_vec3 p = vec(0.02 * cosine + (right ? 0.02 : -0.02), 0, 0.02 * sine);
        add_vertex(s, plus(p, vec(0, -0.1, 0))), add_vertex(s, plus(p, vec(0, 0.1, 0)));
    }
    for (int i = 0; i < s->vertices / 2; i++) {
        int32_t a = 2 * i, b = 2 * ((i + 1) % (s->vertices / 2));
        add_face(s, a, b, a + 1), add_face(s, b, b + 1, a + 1);
    }
    clast_world *w = feeling_world(s, 0, &patches);
    feeling f = feel(w, vec(0, 0, 1e-4), 0.0203);
    assert_int_equal(f.walls, 2);
    CHECK_CLOSE(f.push.z, pow(2e-4, 1.5) - pow(4e-4, 1.5), 1e-9);
    clast_world_free(w);
}

/* Two facets that meet at 20 degrees, with a sliver between them or not: the sliver changes the
 * force of one that touches both by what it takes from the corner. */
static void a_sliver_in_a_seam_is_not_felt(void **state) {
    (void)state;
    double sine, cosine, r = 0.02, push[2];
    clast_sincos(10 * NUMBER_PI / 180, &sine, &cosine);
    for (int sliver = 0; sliver < 2; sliver++) {
        surface *s = empty_surface();
        double half = sliver ? 1e-5 : 0;
        for (int i = 0; i < 3 + sliver; i++) {
            double x = i == 0 ? -0.1 : i == 2 + sliver ? 0.1 : sliver ? (i == 1 ? -half : half) : 0;
            for (int side = -1; side <= 1; side += 2)
                add_vertex(s, vec(x, 0.1 * side, fabs(x) * sine / cosine));
        }
        for (int32_t a = 0; a < s->vertices - 2; a += 2)
            add_face(s, a, a + 2, a + 1), add_face(s, a + 2, a + 3, a + 1);
        int patches;
        clast_world *w = feeling_world(s, 0, &patches);
        assert_int_equal(patches, 2 + sliver);
        feeling f = feel(w, vec(1e-9, 0, (r - 1e-4) / cosine), r);
        assert_int_equal(f.walls, 1);
        push[sliver] = norm(f.push);
        clast_world_free(w);
    }
    CHECK_CLOSE(push[0], pow(1e-4 + 1e-9 * sine, 1.5), 1e-9);
    CHECK_CLOSE(push[1], push[0], 1e-9);
}

/* ---- from facet to facet --------------------------------------------------------------------- */

typedef struct drum_case {
    int facets;         /* 0: the cylinder itself, by a plane that is put anew under the sphere */
    double speed, spin; /* m/s along the drum's wall; rad/s */
    double friction, restitution;
    double smooth_angle;
    int sectors; /* of every facet: how it is cut */
} drum_case;

typedef struct drum_run {
    double turns;         /* rad, about the axis of the drum */
    double energy, start; /* J, all that is not lost: at the end, at the start */
    double jump, force;   /* N: largest change of the force within a step, largest force */
    double spring_jump;   /* N, largest change of the length of the tangential spring */
    double slid;          /* J, lost by friction */
    double highest;       /* J, of motion and height */
    size_t most, least;   /* contacts */
} drum_run;

static const double DRUM = 0.1, BALL = 0.02; /* m */

static surface *drum_surface(int facets, int sectors) {
    surface *s = empty_surface();
    for (int i = 0; i < facets; i++) {
        double from[2], to[2];
        clast_sincos(2 * NUMBER_PI * (i + 0.37) / facets, &from[1], &from[0]);
        clast_sincos(2 * NUMBER_PI * (i + 1.37) / facets, &to[1], &to[0]);
        add_sheet(s, vec(DRUM * from[0], -0.05, DRUM * from[1]),
                  vec(DRUM * (to[0] - from[0]), 0, DRUM * (to[1] - from[1])), vec(0, 0.1, 0), 1,
                  sectors, NULL);
    }
    weld(s);
    return s;
}

static double all_energy(const clast_energy *e) {
    return e->kinetic + e->rotational + e->gravity + e->elastic;
}

/* A ball in a drum that lies on its side, started at its bottom with the elastic force that keeps
 * it on the path. */
__attribute__((unused)) static drum_run roll_in_drum(const drum_case *c, int count) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81), def.time_step = 5e-6;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(c->restitution, c->friction);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", BALL, m.soft);
    mesh_with(w, clast_part_add(w, &(clast_part_def){.name = "drum"}), m.hard,
              drum_surface(c->facets, c->sectors), c->smooth_angle);
    double height = -(DRUM - BALL + 1.3e-4);
    add_body(w, ball, vec(0, 0.001, height), vec(c->speed, 0, 0), vec(0, c->spin, 0));
    if (clast_world_prepare(w)) fail_msg("%s", clast_world_error(w));
    clast_energy e = clast_world_energy(w);
    drum_run r = {.start = all_energy(&e), .least = 99};
    clast_contact before = {.overlap = 0}, now[4];
    double spring = 0, angle = 0;
    for (int i = 0; i < count; i++) {
        steps(w, 1);
        size_t contacts = clast_world_contacts(w, now, 4);
        r.most = contacts > r.most ? contacts : r.most;
        r.least = contacts < r.least ? contacts : r.least;
        if (contacts != 1) continue;
        records_collect(w);
        double length = v3_norm(w->records.items[0].history.spring);
        if (before.overlap > 0) {
            r.jump = fmax(r.jump, norm(minus(now[0].force, before.force)));
            r.spring_jump = fmax(r.spring_jump, fabs(length - spring));
        }
        r.force = fmax(r.force, norm(now[0].force));
        before = now[0], spring = length;
        e = clast_world_energy(w);
        r.highest = fmax(r.highest, all_energy(&e));
        clast_vec3 p = body_of(w, 0).position;
        double to = atan2(p.x, -p.z);
        r.turns += remainder(to - angle, 2 * NUMBER_PI);
        angle = to;
    }
    e = clast_world_energy(w);
    r.energy = all_energy(&e), r.slid = e.friction;
    clast_world_free(w);
    return r;
}

TEST_MAIN(cmocka_unit_test(a_cylinder_is_felt_once),
          cmocka_unit_test(facets_for_themselves_push_twice), cmocka_unit_test(the_angle_decides),
          cmocka_unit_test(a_fillet_keeps_floor_and_wall_apart),
          cmocka_unit_test(both_sides_of_a_tube), cmocka_unit_test(a_sliver_in_a_seam_is_not_felt))
