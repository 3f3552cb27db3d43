/* walls_test.c - walls of triangles: every key of walls.yaml is found again in the world. */
#include "tests/scene/testing.h"

#include "engine/world.h"
#include "experiments/scene/scene.h"
#include "meshes/shapes.h"

static const char WALLS[] = CLAST_SCENES "/walls.yaml", ELBOW[] = CLAST_SCENES "/elbow.yaml";
static const double DEGREE = 3.141592653589793 / 180;

static scene *load_file(const char *path, const char *const *set, int count) {
    char *faults = NULL;
    scene_options options = {.set = set, .set_count = count};
    scene *s = scene_load(path, &options, &faults);
    if (!s || faults) fail_msg("%s", faults ? faults : "no scene, no faults");
    return s;
}

static scene *load(const char *const *set, int count) {
    return load_file(WALLS, set, count);
}

static const scene_mesh *find(const scene *s, const char *name) {
    for (int i = 0; i < s->mesh_count; i++)
        if (strcmp(s->meshes[i].name, name) == 0) return &s->meshes[i];
    fail_msg("no mesh %s", name);
    return NULL;
}

static const char *part_of(const scene *s, int index) {
    return clast_world_part(s->world, clast_world_wall_part(s->world, index)).name;
}

static void near(double got, double want) {
    if (!(fabs(got - want) < 1e-14)) fail_msg("got %.17g, expected %.17g", got, want);
}

static void has_vertex(const scene_mesh *m, size_t i, double x, double y, double z) {
    const double *p = m->vertex + 3 * i;
    if (!(fabs(p[0] - x) < 1e-7 && fabs(p[1] - y) < 1e-7 && fabs(p[2] - z) < 1e-7))
        fail_msg("%s: got %.9g %.9g %.9g, expected %g %g %g", m->name, p[0], p[1], p[2], x, y, z);
}

/* y up, millimetres, doubled, turned by a right angle about z, moved, three times; single precision
 * as assimp reads it. */
static void a_file_is_put_in_its_place(void **state) {
    (void)state;
    scene *s = load(NULL, 0);
    for (int i = 0; i < 3; i++) {
        char name[20];
        snprintf(name, sizeof name, "wedge-%d", i + 1);
        const scene_mesh *m = find(s, name);
        assert_int_equal(m->vertex_count, 6);
        assert_int_equal(m->triangle_count, 8);
        assert_int_equal(m->walls, 5); /* two triangles and three rectangles */
        has_vertex(m, 0, 1, 2 + 0.1 * i, 3);
        double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
        for (size_t k = 0; k < 3 * m->vertex_count; k++) {
            low[k % 3] = fmin(low[k % 3], m->vertex[k]);
            high[k % 3] = fmax(high[k % 3], m->vertex[k]);
        }
        const double want[] = {1, 2 + 0.1 * i, 3, 1.04, 2.06 + 0.1 * i, 3.02};
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(low[k] - want[k]) < 1e-7);
            assert_true(fabs(high[k] - want[3 + k]) < 1e-7);
        }
        assert_string_equal(part_of(s, m->wall), i == 1 ? "two" : "one");
        snprintf(name, sizeof name, "wedge-%d/0", i + 1);
        assert_string_equal(clast_world_wall(s->world, m->wall).name, name);
    }
    scene_free(s);
}

/* The same vertices and triangles as straight from meshes/, moved by z. */
static void same_shape(const scene_mesh *m, mesh_status status, mesh_surface *want, double z) {
    assert_int_equal(status, MESH_OK);
    assert_int_equal(m->vertex_count, want->vertex_count);
    assert_int_equal(m->triangle_count, want->triangle_count);
    for (size_t i = 0; i < 3 * m->vertex_count; i++)
        near(m->vertex[i], want->vertex[i] + (i % 3 == 2 ? z : 0));
    assert_memory_equal(m->triangle, want->triangle, 3 * m->triangle_count * sizeof *m->triangle);
    mesh_free(want);
}

static void shapes_have_the_measures_of_the_scene(void **state) {
    (void)state;
    scene *s = load(NULL, 0);
    mesh_surface want;
    mesh_bar bar = {0.18, 0.028, 0.05, 0.006, 10 * DEGREE, 0.002, 5};
    same_shape(find(s, "bar"), mesh_make_bar(&bar, &want), &want, -1);
    assert_string_equal(part_of(s, find(s, "bar")->wall), "two");
    mesh_tube tube = {{0, 0, 0}, {0, 0, 0.3}, 0.05, 0.06, 0.001, 7, MESH_FIT_OUTSIDE};
    same_shape(find(s, "tube"), mesh_make_tube(&tube, &want), &want, 0);
    tube = (mesh_tube){{1, 0, 0}, {1, 0, 0.3}, 0.05, 0.05, 0, 48, MESH_FIT_AREA};
    same_shape(find(s, "pipe"), mesh_make_tube(&tube, &want), &want, 0);
    mesh_bend bend = {{-1, 0, 0}, {-1.3, 0, 0},   {0, 1, 0}, 90 * DEGREE, 0.04, 0.002, 8,
                      3,          MESH_FIT_INSIDE};
    same_shape(find(s, "bend"), mesh_make_bend(&bend, &want), &want, 0);
    assert_string_equal(part_of(s, find(s, "bend")->wall), "still");
    scene_free(s);
}

/* In the place of the measures; the unit is that beside the file. */
static void a_bar_is_read_from_a_file(void **state) {
    (void)state;
    scene *s = load(NULL, 0);
    const scene_mesh *own = find(s, "own"), *wedge = find(s, "wedge-1");
    assert_int_equal(own->vertex_count, wedge->vertex_count);
    for (size_t i = 0; i < own->vertex_count; i++) { /* that one: doubled, turned, moved */
        const double *p = wedge->vertex + 3 * i;
        has_vertex(own, i, (p[1] - 2) / 2, (1 - p[0]) / 2, 1 + (p[2] - 3) / 2);
    }
    assert_non_null(strstr(s->mesh_reports, "own, "));
    scene_free(s);
}

static void belts_and_copies_reach_every_piece(void **state) {
    (void)state;
    scene *s = load(NULL, 0);
    const scene_mesh *belt = find(s, "belt");
    assert_int_equal(belt->walls, 6);
    for (int i = 0; i < belt->walls; i++)
        near(clast_world_wall(s->world, belt->wall + i).belt_velocity.z, 0.1);
    int ribs = 0;
    for (int i = 0; i < clast_world_wall_count(s->world); i++) {
        clast_wall_def def = clast_world_wall(s->world, i);
        if (strncmp(def.name, "rib-", 4) != 0) continue;
        near(def.point.x, 0.01 * ribs++);
        assert_int_equal(def.name[4], '0' + ribs);
    }
    assert_int_equal(ribs, 2);
    assert_non_null(strstr(s->mesh_reports, "wedge.obj: 8 triangles, "));
    assert_non_null(strstr(s->mesh_reports, "bend, bend: "));
    scene_free(s);
}

/* Flat pieces of a mesh that are part of a smooth surface. */
static int smooth_pieces(const scene *s, const char *name) {
    const scene_mesh *m = find(s, name);
    int count = 0;
    for (int i = 0; i < m->walls; i++) count += s->world->walls[m->wall + i].smooth >= 0;
    return count;
}

/* The nose of the bar turns by 100 degrees: seams of 20 degrees, of 10 at its ends. */
static void the_smooth_angle_joins_flat_pieces(void **state) {
    (void)state;
    scene *s = load(NULL, 0);
    assert_int_equal(smooth_pieces(s, "bar"), 7); /* top, five of the nose, front */
    assert_int_equal(smooth_pieces(s, "pipe"), 0);
    assert_int_equal(smooth_pieces(s, "wedge-1"), 0);
    scene_free(s);
    s = load_file(ELBOW, NULL, 0);
    assert_int_equal(smooth_pieces(s, "tube"), 48);
    assert_int_equal(smooth_pieces(s, "bend"), 48 * 24);
    scene_free(s);
}

/* One line replaces the file of a scene. */
static void another_file_is_one_setting(void **state) {
    (void)state;
    mesh_surface box;
    assert_int_equal(mesh_make_box((double[3]){10, 20, 30}, &box), MESH_OK);
    assert_int_equal(mesh_write_stl(&box, CLAST_SCENE_SCRATCH "/box.stl"), MESH_OK);
    mesh_free(&box);
    scene *s = load((const char *[]){"wedge=" CLAST_SCENE_SCRATCH "/box.stl"}, 1);
    assert_int_equal(find(s, "wedge-3")->triangle_count, 12);
    scene_free(s);
}

/* How far a place is from the axis of the pipe, and the inner radius there; outside of its ends,
 * anywhere is right. */
static double beyond_pipe(double x, double y, double z) {
    if (z > 0.4 || x > 0.1) return -1; /* above the funnel, past the bend */
    if (z > 0.3) return hypot(x, y) - (0.03 + 0.05 * (z - 0.3) / 0.1);
    if (z > 0.2) return hypot(x, y) - 0.03;
    return hypot(hypot(x - 0.1, z - 0.2) - 0.1, y) - 0.03;
}

/* Nothing leaks at the seams or where the pieces meet, and nearly all come out at the end. Radius 5
 * mm, a tenth of which may overlap: no centre comes within 4 mm of the round wall. */
static void balls_go_through_a_pipe(void **state) {
    (void)state;
    scene *s = load_file(ELBOW, NULL, 0);
    while (clast_world_time(s->world) < s->ending.latest) {
        if (clast_world_run(s->world, clast_world_time(s->world) + 2e-3))
            fail_msg("%s", clast_world_error(s->world));
        clast_bodies b = clast_world_bodies(s->world);
        for (size_t i = 0; i < b.count; i++)
            if (beyond_pipe(b.x[i], b.y[i], b.z[i]) > -0.004)
                fail_msg("t = %g s: body %u at %g %g %g m", clast_world_time(s->world), b.id[i],
                         b.x[i], b.y[i], b.z[i]);
    }
    clast_bodies b = clast_world_bodies(s->world);
    size_t out = 0;
    for (size_t i = 0; i < b.count; i++) out += b.x[i] > 0.1;
    assert_int_equal(b.count, 60);
    assert_true(out > 50);
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_file_is_put_in_its_place),
                                       cmocka_unit_test(shapes_have_the_measures_of_the_scene),
                                       cmocka_unit_test(a_bar_is_read_from_a_file),
                                       cmocka_unit_test(belts_and_copies_reach_every_piece),
                                       cmocka_unit_test(another_file_is_one_setting),
                                       cmocka_unit_test(the_smooth_angle_joins_flat_pieces),
                                       cmocka_unit_test(balls_go_through_a_pipe)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
