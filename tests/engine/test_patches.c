/* Walls from triangles: planes cut into pieces against planes, boxes and cylinders against what
 * they stand for, and everything that a mesh may not be. */
#include "tests/support/surface.h"

#include "engine/geometry.h"
#include "engine/numbers.h"
#include "engine/world.h"

/* ---- a plane in pieces ----------------------------------------------------------------------- */

typedef struct slide {
    double radius, height; /* m */
    clast_vec3 velocity, spin;
    double friction, restitution;
    clast_vec3 belt;
} slide;

typedef struct trace {
    body_state end;
    double spring; /* N */
    double energy; /* J, dissipated by friction */
    size_t most;   /* contacts */
} trace;

/* One sphere on a floor through the origin; the frame is turned and moved. */
static trace run_slide(const slide *c, const surface *floor, clast_quat q, clast_vec3 offset) {
    mat3 r = q_matrix(q);
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = m3_apply(&r, vec(0, 0, -9.81)), def.time_step = 1e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(c->restitution, c->friction);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", c->radius, m.soft);
    int group = clast_part_add(w, &(clast_part_def){.name = "floor"});
    clast_wall_def plane = {"plane",
                            CLAST_WALL_PLANE,
                            m.hard,
                            .point = offset,
                            .normal = m3_apply(&r, vec(0, 0, 1)),
                            .belt_velocity = m3_apply(&r, c->belt)};
    if (floor)
        mesh_on(w, group, m.hard, floor, plane.belt_velocity);
    else
        assert_true(clast_wall_add(w, group, &plane) >= 0);
    clast_vec3 at = vec(-0.0313, 0.0021, c->height);
    add_body(w, ball, plus(m3_apply(&r, at), offset), m3_apply(&r, c->velocity),
             m3_apply(&r, c->spin));
    trace t = {.most = 0};
    for (int i = 0; i < 12000; i++) {
        steps(w, 1);
        size_t now = clast_world_counters(w).contacts;
        t.most = now > t.most ? now : t.most;
    }
    records_collect(w);
    t.spring = w->records.count == 1 ? v3_norm(w->records.items[0].history.spring) : 0;
    t.energy = clast_world_energy(w).friction;
    t.end = body_of(w, 0);
    clast_world_free(w);
    return t;
}

static const double SMALL = 0.0007, LARGE = 0.02; /* m */

static const slide SLIDES[5] = {
    {0.02, 0.02, {0, 0, 0}, {0, 0, 0}, 0.4, 0.5, {0, 0, 0}},            /* rests */
    {0.02, 0.0199, {0.5, 0.07, 0}, {0, 0, 0}, 0.4, 0.5, {0, 0, 0}},     /* slides, then rolls */
    {0.0007, 0.0007, {0.4, -0.01, 0}, {0, 90, 0}, 0.3, 0.5, {0, 0, 0}}, /* smaller than pieces */
    {0.004, 0.012, {0.3, 0.02, -0.2}, {30, 0, 9}, 0.5, 0.8, {0, 0, 0}}, /* bounces */
    {0.004, 0.00399, {0, 0, 0}, {0, 0, 0}, 0.3, 0.5, {0.3, 0.1, 0}},    /* on a belt */
};

static void compare_traces(const trace *a, const trace *b, int kind, int cells) {
    double speed = norm(b->end.velocity) + 1e-3, spin = norm(b->end.spin) + 0.1;
    double off = fmax(norm(minus(a->end.position, b->end.position)) / 0.05,
                      fmax(norm(minus(a->end.velocity, b->end.velocity)) / speed,
                           norm(minus(a->end.spin, b->end.spin)) / spin));
    if (!(off < 1e-9)) fail_msg("slide %d, %d cells: off by %.2g", kind, cells, off);
    if (!(fabs(a->spring - b->spring) <= 1e-9 * (b->spring + 1e-3)))
        fail_msg("slide %d, %d cells: spring %.12g, not %.12g N", kind, cells, a->spring,
                 b->spring);
    CHECK_NEAR(a->energy, b->energy, 1e-9 * (fabs(b->energy) + 1e-4));
    assert_int_equal(a->most, 1);
}

static void a_plane_in_pieces_is_a_plane(void **state) {
    (void)state;
    dice d = {7, 0};
    static const int cells[5] = {1, 2, 5, 12, 32}; /* 2 to 2048 triangles */
    for (int kind = 0; kind < 5; kind++)
        for (int turned = 0; turned < 2; turned++) {
            clast_quat q = turned ? any_orientation(&d) : (clast_quat){1, 0, 0, 0};
            clast_vec3 offset = turned ? vec(0.3, -0.2, 0.7) : vec(0, 0, 0);
            trace want = run_slide(&SLIDES[kind], NULL, q, offset);
            for (int i = turned ? 2 : 0; i < 5; i += turned ? 2 : 1) {
                surface *s = empty_surface();
                add_sheet(s, vec(-.05, -.04, 0), vec(.1, 0, 0), vec(0.01, .08, 0), cells[i],
                          cells[i], i % 2 || turned ? &d : NULL);
                turn_surface(s, q, offset);
                trace got = run_slide(&SLIDES[kind], s, q, offset);
                compare_traces(&got, &want, kind, cells[i]);
            }
        }
    assert_true(SMALL < .1 / 32 && LARGE > .1 / 32);
}

/* 20 000 triangles of a plane: in squares, and as slivers 320 times as long as wide. */
static void twenty_thousand_triangles_are_a_plane(void **state) {
    (void)state;
    dice d = {8, 0};
    static const int cells[2][2] = {{100, 100}, {2000, 5}};
    for (int kind = 1; kind < 3; kind++)
        for (int cut = 0; cut < 2; cut++) {
            clast_quat q = any_orientation(&d);
            clast_vec3 offset = vec(0.1, 0.2, -0.4);
            trace want = run_slide(&SLIDES[kind], NULL, q, offset);
            surface *s = empty_surface();
            add_sheet(s, vec(-.05, -.04, 0), vec(.1, 0, 0), vec(0.01, .08, 0), cells[cut][0],
                      cells[cut][1], &d);
            assert_int_equal(s->triangles, 20000);
            turn_surface(s, q, offset);
            trace got = run_slide(&SLIDES[kind], s, q, offset);
            compare_traces(&got, &want, kind, cells[cut][0]);
        }
}

/* Whatever the cut, one plane is one patch; in single precision too, with slivers. */
static void one_plane_is_one_patch(void **state) {
    (void)state;
    dice d = {9, 0};
    for (int i = 0; i < 12; i++) {
        surface *s = empty_surface();
        clast_vec3 across = vec(0.003, i % 3 ? .08 : 1e-4, 0);
        add_sheet(s, vec(-.05, -.04, 0), vec(.1, 0, 0), across, 40, i % 2 ? 40 : 3, &d);
        turn_surface(s, any_orientation(&d), vec(roll(&d, -1, 1), roll(&d, -1, 1), 0));
        for (int v = 0; v < s->vertices && i >= 6; v++)
            s->vertex[v] = vec((float)s->vertex[v].x, (float)s->vertex[v].y, (float)s->vertex[v].z);
        int patches;
        clast_world *w = feeling_world(s, 0, &patches);
        if (patches != 1) fail_msg("sheet %d: %d patches", i, patches);
        clast_world_free(w);
    }
}

/* A sheet that is bent a little at every row is not flat, however fine the rows. */
static void a_fine_curve_is_no_plane(void **state) {
    (void)state;
    enum { ROWS = 9000 };
    surface *s = empty_surface();
    for (int i = 0; i <= ROWS; i++) {
        double sine, cosine;
        clast_sincos(1.5 * i / ROWS, &sine, &cosine);
        add_vertex(s, vec(sine, 0, cosine)), add_vertex(s, vec(sine, 1, cosine));
    }
    for (int32_t a = 0; a < 2 * ROWS; a += 2)
        add_face(s, a, a + 2, a + 1), add_face(s, a + 2, a + 3, a + 1);
    int patches;
    clast_world *w = feeling_world(s, 0, &patches);
    double worst = 0;
    for (int i = 10; i < 990; i++) {
        double sine, cosine, gap = INFINITY;
        clast_sincos(1.5 * i / 1000, &sine, &cosine);
        for (int k = 0; k < w->wall_count; k++)
            gap =
                fmin(gap, wall_approach(&w->walls[k], vec(1.1 * sine, .5, 1.1 * cosine)).distance);
        worst = fmax(worst, fabs(gap - 0.1));
    }
    print_message("quarter of a cylinder in %d rows: %d patches, off by %.1e of the radius\n", ROWS,
                  patches, worst);
    CHECK_BELOW(worst, 1e-6);
    clast_world_free(w);
}

/* Triangles on top of each other do not add up to a rectangle. */
static void a_doubled_triangle_is_a_triangle(void **state) {
    (void)state;
    surface *s = empty_surface();
    int32_t a = add_vertex(s, vec(0, 0, 0)), b = add_vertex(s, vec(1, 0, 0)),
            c = add_vertex(s, vec(0, 1, 0));
    add_face(s, a, b, c), add_face(s, a, c, b);
    int patches;
    clast_world *w = feeling_world(s, 0, &patches);
    assert_int_equal(patches, 1);
    assert_int_equal(feel(w, vec(.9, .9, .05), .1).walls, 0);
    assert_int_equal(feel(w, vec(.4, .4, .05), .1).walls, 1);
    clast_world_free(w);
}

/* ---- a box ----------------------------------------------------------------------------------- */

static const clast_vec3 HALF = {0.03, 0.02, 0.01};

static double beyond(double x, double half) {
    return fabs(x) - half > 0 ? fabs(x) - half : 0;
}

/* The shortest way from a convex box outside of it. */
static clast_vec3 way_from_box(clast_vec3 p) {
    return vec(copysign(beyond(p.x, HALF.x), p.x), copysign(beyond(p.y, HALF.y), p.y),
               copysign(beyond(p.z, HALF.z), p.z));
}

static clast_vec3 random_near_box(dice *d, double radius) {
    for (;;) {
        clast_vec3 p = {roll(d, -1, 1) * (HALF.x + radius), roll(d, -1, 1) * (HALF.y + radius),
                        roll(d, -1, 1) * (HALF.z + radius)};
        double distance = norm(way_from_box(p));
        if (distance < radius && distance > 0.9 * radius) return p;
    }
}

/* Six plates: what two or three of them share is felt two or three times. */
static clast_world *world_of_plates(void) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    two_materials m = add_materials(w, &pair);
    clast_shape_add_sphere(w, "ball", 0.01, m.soft);
    int group = clast_part_add(w, &(clast_part_def){.name = "box"});
    for (int i = 0; i < 6; i++) {
        double sign = i % 2 ? 1 : -1;
        clast_wall_def l = {.name = "side", .kind = CLAST_WALL_PLATE, .material = m.hard};
        double h[3] = {HALF.x, HALF.y, HALF.z}, n[3] = {0, 0, 0}, along[3] = {0, 0, 0};
        int axis = i / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        n[axis] = 1, along[u] = 1;
        l.normal = vec(n[0], n[1], n[2]), l.side = vec(along[0], along[1], along[2]);
        l.point = times(sign * h[axis], l.normal);
        l.half_side[0] = h[u], l.half_side[1] = h[v];
        assert_true(clast_wall_add(w, group, &l) >= 0);
    }
    if (clast_world_prepare(w)) fail_msg("%s", clast_world_error(w));
    return w;
}

/* Faces, edges and corners from all sides, by spheres smaller and larger than the box: the mesh
 * pushes once along the shortest way; plates do so on a face, away from its edges. */
static void a_box_is_felt_once(void **state) {
    (void)state;
    dice d = {3, 0};
    clast_world *plates = world_of_plates();
    for (int cut = 1; cut <= 5; cut += 2) {
        int patches, kinds[4] = {0, 0, 0, 0}, by_faces = 0;
        clast_world *w = feeling_world(box_surface(HALF, cut, cut > 1 ? &d : NULL), 0, &patches);
        assert_int_equal(patches, 6);
        for (int i = 0; i < 20000; i++) {
            double radius = i % 2 ? 0.004 : i % 4 ? 0.013 : 0.07;
            clast_vec3 p = random_near_box(&d, radius), way = way_from_box(p);
            clast_vec3 want = times(pow(radius - norm(way), 1.5) / norm(way), way);
            feeling f = feel(w, p, radius);
            int kind = (way.x != 0) + (way.y != 0) + (way.z != 0);
            if (f.walls != 1 || norm(minus(f.push, want)) > 1e-9 * norm(want))
                fail_msg("point %d (%.17g, %.17g, %.17g), radius %g, %d of the box: felt %d times, "
                         "%.3g of the force off",
                         i, p.x, p.y, p.z, radius, kind, f.walls,
                         norm(minus(f.push, want)) / norm(want));
            kinds[kind]++;
            if (kind != 1 || radius > 0.01) continue;
            feeling by_plates = feel(plates, p, radius);
            by_faces += by_plates.walls == 1;
            if (by_plates.walls == 1 && norm(minus(by_plates.push, f.push)) > 1e-9 * norm(want))
                fail_msg("point %d: plates differ", i);
        }
        print_message("box of %d triangles: %d faces, %d edges, %d corners\n", 12 * cut * cut,
                      kinds[1], kinds[2], kinds[3]);
        assert_true(by_faces > 500 && kinds[1] > 500 && kinds[2] > 500 && kinds[3] > 500);
        clast_world_free(w);
    }
    clast_world_free(plates);
}

/* Exactly on the lines where a face ends and an edge begins there is one contact, too. */
static void borders_between_face_and_edge(void **state) {
    (void)state;
    int patches;
    clast_world *w = feeling_world(box_surface(HALF, 1, NULL), 0, &patches);
    for (int i = -3; i <= 3; i++)
        for (int j = -3; j <= 3; j++) {
            double tiny[7] = {-1e-9, -1e-15, -1e-18, 0, 1e-18, 1e-15, 1e-9};
            clast_vec3 p = {HALF.x + tiny[i + 3], HALF.y + tiny[j + 3], HALF.z + 0.0039};
            feeling f = feel(w, p, 0.004);
            if (f.walls != 1) fail_msg("%d, %d: felt %d times", i, j, f.walls);
        }
    clast_world_free(w);
}

/* From inside, the walls of a box are three planes. */
static void a_concave_corner_is_felt_by_every_face(void **state) {
    (void)state;
    int patches;
    dice d = {4, 0};
    clast_world *w = feeling_world(box_surface(HALF, 3, &d), 0, &patches);
    double r = 0.003, o = 1e-4;
    assert_int_equal(feel(w, vec(0, 0, HALF.z - r + o), r).walls, 1);
    assert_int_equal(feel(w, vec(0.001, HALF.y - r + o, HALF.z - r + o), r).walls, 2);
    feeling f = feel(w, vec(HALF.x - r + o, HALF.y - r + 2 * o, HALF.z - r + 3 * o), r);
    assert_int_equal(f.walls, 3);
    CHECK_CLOSE(f.push.x, -pow(o, 1.5), 1e-9);
    CHECK_CLOSE(f.push.y, -pow(2 * o, 1.5), 1e-9);
    CHECK_CLOSE(f.push.z, -pow(3 * o, 1.5), 1e-9);
    clast_world_free(w);
}

/* ---- one prism, cut in other ways ------------------------------------------------------------ */

/* Spheres fall on the prism from all sides and bounce for a while. */
static void prism_trace(const surface *s, int moving, clast_vec3 *places, int count) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.time_step = 2e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.8, 0.3);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.002, m.soft);
    clast_part_def p = {.name = "prism", .velocity = {moving ? 0.2 : 0, 0, moving ? 0.1 : 0}};
    mesh_on(w, clast_part_add(w, &p), m.hard, s, vec(0, 0, 0));
    dice d = {31, 0};
    for (int i = 0; i < count; i++) {
        clast_vec3 to = {roll(&d, -.9, .9) * HALF.x, roll(&d, -.9, .9) * HALF.y, 0};
        clast_vec3 way = {roll(&d, -1, 1), roll(&d, -1, 1), roll(&d, -1, 1)};
        clast_vec3 from = plus(to, times(0.05 / norm(way), way));
        add_body(w, ball, from, times(-20, minus(from, to)), vec(50, 0, 20));
    }
    steps(w, 3500);
    assert_true(clast_world_energy(w).damping > 0);
    for (int i = 0; i < count; i++) places[i] = body_of(w, i).position;
    clast_world_free(w);
}

static void one_prism_cut_otherwise_gives_one_trace(void **state) {
    (void)state;
    enum { COUNT = 8 };
    dice d = {12, 0};
    for (int moving = 0; moving < 2; moving++) {
        clast_vec3 want[COUNT], got[COUNT];
        prism_trace(box_surface(HALF, 1, NULL), moving, want, COUNT);
        for (int cut = 2; cut <= 12; cut += 5) {
            prism_trace(box_surface(HALF, cut, &d), moving, got, COUNT);
            for (int i = 0; i < COUNT; i++)
                CHECK_NEAR(norm(minus(got[i], want[i])), 0, 1e-9 * 0.05);
        }
    }
}

/* ---- a moving bar ---------------------------------------------------------------------------- */

/* A bar pushes a row of spheres over a floor; a plane that moves likewise does the same. */
static void a_bar_pushes_like_a_plane(void **state) {
    (void)state;
    clast_vec3 end[2][3], spin[2][3];
    double work[2];
    for (int bar = 0; bar < 2; bar++) {
        clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
        def.gravity = vec(0, 0, -9.81), def.time_step = 1e-5;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(0.5, 0.4);
        two_materials m = add_materials(w, &pair);
        int ball = clast_shape_add_sphere(w, "ball", 0.004, m.soft);
        add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
                  vec(0, 0, 1));
        clast_part_def p = {.name = "bar", .velocity = {0.25, 0, 0}, .move_from = 0.01};
        int pusher = clast_part_add(w, &p);
        surface *s = box_surface(HALF, 4, NULL);
        turn_surface(s, (clast_quat){1, 0, 0, 0}, vec(-HALF.x - 0.00411713, 0, 0));
        if (bar)
            mesh_on(w, pusher, m.hard, s, vec(0, 0, 0));
        else
            add_plane(w, pusher, m.hard, vec(-0.00411713, 0, 0), vec(1, 0, 0));
        for (int i = 0; i < 3; i++)
            add_body(w, ball, vec(0, 0.009 * (i - 1), 0.004), vec(0, 0, 0), vec(0, 0, 0));
        steps(w, 20000);
        for (int i = 0; i < 3; i++)
            end[bar][i] = body_of(w, i).position, spin[bar][i] = body_of(w, i).spin;
        work[bar] = clast_world_part_load(w, pusher).work;
        clast_world_free(w);
    }
    assert_true(end[0][0].x > 0.02 && work[0] > 0);
    CHECK_CLOSE(work[1], work[0], 1e-9);
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(norm(minus(end[1][i], end[0][i])), 0, 1e-9 * 0.05);
        CHECK_NEAR(norm(minus(spin[1][i], spin[0][i])), 0, 1e-9 * norm(spin[0][i]));
    }
}

/* ---- nothing leaks --------------------------------------------------------------------------- */

static bool is_inside(const clast_world *w, clast_vec3 p, const double *side) {
    for (int i = 0; i < w->wall_count; i++)
        if (dot(minus(p, w->walls[i].point), w->walls[i].n) * side[i] <= 0) return false;
    return true;
}

/* Spheres fly about in a closed convex mesh until the end or until a guard stops the run. */
static bool stays_inside(const surface *s, double speed, uint64_t seed, clast_vec3 gravity) {
    clast_world_def def = clast_world_def_default();
    def.gravity = gravity, def.threads = 1, def.impact_speed = speed;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.9, 0.3);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.003, m.soft);
    mesh_on(w, clast_part_add(w, &(clast_part_def){.name = "mesh"}), m.hard, s, vec(0, 0, 0));
    dice d = {seed, 0};
    for (int i = 0; i < 4; i++) {
        clast_vec3 v = {roll(&d, -1, 1), roll(&d, -1, 1), roll(&d, -1, 1)};
        add_body(w, ball, vec(0.0065 * (i % 2 - .5), 0.0065 * (i / 2 - .5), 0),
                 times(speed / norm(v), v), vec(roll(&d, -99, 99), 0, 0));
    }
    if (clast_world_prepare(w)) fail_msg("%s", clast_world_error(w));
    double side[MOST_TRIANGLES / 20];
    for (int i = 0; i < w->wall_count; i++)
        side[i] = dot(minus(vec(0, 0, 0), w->walls[i].point), w->walls[i].n);
    clast_status status = CLAST_OK;
    for (int i = 0; i < 3000 && !status; i++) {
        status = clast_world_step(w);
        for (int k = 0; k < 4; k++)
            if (!status && !is_inside(w, body_of(w, k).position, side))
                fail_msg("seed %llu, %g m/s: body %d is outside at step %d",
                         (unsigned long long)seed, speed, k, i);
    }
    clast_world_free(w);
    return status == CLAST_OK;
}

static void nothing_leaks_from_a_closed_mesh(void **state) {
    (void)state;
    int kept = 0, stopped = 0;
    for (uint64_t seed = 1; seed <= 36; seed++) {
        double speed = 0.02 * pow(10, (double)(seed % 12) / 3);
        dice d = {seed, 0};
        surface *s = seed % 3 == 0   ? box_surface(vec(.012, .011, .01), 3, &d)
                     : seed % 3 == 1 ? tube_surface(0.015, 0.01, 24, true)
                                     : tube_surface(0.015, 0.01, 5, true);
        turn_surface(s, any_orientation(&d), vec(0, 0, 0));
        bool inside = stays_inside(s, speed, seed, vec(0, 0, seed % 2 ? -9.81 : 0));
        kept += inside, stopped += !inside;
    }
    print_message("closed meshes: %d kept their spheres, %d runs stopped by a guard\n", kept,
                  stopped);
    assert_true(kept > 10 && stopped > 5);
}

/* ---- what a mesh may not be ------------------------------------------------------------------ */

static void refuse(clast_mesh_def d, int group, const char *says) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    add_materials(w, &pair);
    clast_part_add(w, &(clast_part_def){.name = "mesh"});
    int walls = clast_world_wall_count(w);
    assert_int_equal(clast_mesh_add(w, group, &d), -1);
    if (!strstr(clast_world_error(w), says)) fail_msg("'%s', not '%s'", clast_world_error(w), says);
    assert_int_equal(clast_world_wall_count(w), walls);
    clast_world_free(w);
}

static void what_is_no_mesh_is_refused(void **state) {
    (void)state;
    clast_vec3 corner[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    int32_t faces[6] = {0, 1, 2, 1, 3, 2};
    clast_mesh_def good = {"it", 1, 4, 2, corner, faces, {0, 0, 0}, 0}, d = good;
    d.triangles = 0, refuse(d, 0, "mesh it has no triangles");
    d.triangles = -5, refuse(d, 0, "mesh it has no triangles");
    d = good, d.material = 2, refuse(d, 0, "mesh it has no such material");
    d.material = -1, refuse(d, 0, "mesh it has no such material");
    d = good, refuse(d, 1, "mesh it belongs to no part"), refuse(d, -1, "belongs to no part");
    d.vertices = 3, refuse(d, 0, "mesh it: triangle 1 names a vertex that does not exist");
    d = good, faces[4] = -1, refuse(d, 0, "triangle 1 names a vertex that does not exist");
    faces[4] = 1, refuse(d, 0, "mesh it: triangle 1 has no area");
    faces[4] = 3, faces[5] = 0, refuse(d, 0, "triangle 1 has no area"); /* in a line */
}

/* Corners that are not numbers, too far away, or in a line to rounding. */
static void corners_that_are_none_are_refused(void **state) {
    (void)state;
    clast_vec3 corner[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    int32_t face[3] = {0, 1, 2};
    clast_mesh_def d = {"it", 1, 3, 1, corner, face, {0, 0, 0}, 0};
    corner[2].x = NAN, refuse(d, 0, "mesh it: triangle 0 has a vertex that is not finite");
    corner[2].x = INFINITY, refuse(d, 0, "triangle 0 has a vertex that is not finite");
    corner[2] = vec(1e200, -1e200, 0), refuse(d, 0, "triangle 0");
    corner[2] = vec(1. / 3, 0, 0), refuse(d, 0, "triangle 0 has no area");
    corner[1] = vec(.1, .2, .3), corner[2] = vec(.3, .6, .9), refuse(d, 0, "has no area");
    corner[2] = vec(0, 1, 0);
    d.belt_velocity = vec(1, 0, 0), refuse(d, 0, "is not along the belt velocity");
    d.belt_velocity = vec(NAN, 0, 0), refuse(d, 0, "belt velocity that is not finite");
    d.belt_velocity = vec(0, 0, 0);
    d.smooth_angle = 1.6, refuse(d, 0, "smooth_angle is 1.6 rad");
    d.smooth_angle = NAN, refuse(d, 0, "smooth_angle is nan rad");
}

/* ---- many triangles -------------------------------------------------------------------------- */

/* A bowl of n triangles that all lie in planes of their own, and a sheet of as many in one plane.
 * Something quadratic would run into the time limit of the test. */
static void many_triangles_are_set_up(void **state) {
    (void)state;
    for (int bowl = 0; bowl < 2; bowl++) {
        int cells = bowl ? 70 : 97;
        surface *s = empty_surface();
        dice d = {2, 0};
        add_sheet(s, vec(-1, -1, 0), vec(2, 0, 0), vec(0, 2, 0), cells, cells, &d);
        for (int v = 0; v < s->vertices && bowl; v++)
            s->vertex[v].z = 0.2 * dot(s->vertex[v], s->vertex[v]);
        int patches;
        clast_world *w = feeling_world(s, 0, &patches);
        assert_true(bowl ? patches > 9000 : patches == 1);
        assert_int_equal(feel(w, vec(.01, .02, .0999), .1).walls > 0, 1);
        clast_world_free(w);
    }
}

/* A fan: all triangles of a lid meet in its middle. */
static void a_lid_of_many_triangles(void **state) {
    (void)state;
    int patches;
    clast_world *w = feeling_world(tube_surface(1, 1, 4500, true), 0, &patches);
    assert_int_equal(patches, 4502);
    CHECK_NEAR(wall_approach(&w->walls[w->wall_count - 1], vec(.3, .2, 1.25)).distance, .25, 1e-12);
    clast_world_free(w);
}

TEST_MAIN(cmocka_unit_test(a_plane_in_pieces_is_a_plane),
          cmocka_unit_test(twenty_thousand_triangles_are_a_plane),
          cmocka_unit_test(one_plane_is_one_patch), cmocka_unit_test(a_fine_curve_is_no_plane),
          cmocka_unit_test(a_doubled_triangle_is_a_triangle), cmocka_unit_test(a_box_is_felt_once),
          cmocka_unit_test(borders_between_face_and_edge),
          cmocka_unit_test(a_concave_corner_is_felt_by_every_face),
          cmocka_unit_test(one_prism_cut_otherwise_gives_one_trace),
          cmocka_unit_test(a_bar_pushes_like_a_plane),
          cmocka_unit_test(nothing_leaks_from_a_closed_mesh),
          cmocka_unit_test(what_is_no_mesh_is_refused),
          cmocka_unit_test(corners_that_are_none_are_refused),
          cmocka_unit_test(many_triangles_are_set_up), cmocka_unit_test(a_lid_of_many_triangles))
