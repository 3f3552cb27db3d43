/* scene_grate.c - G: few spheres on 11 slowly moving bars, where the cost of a step counts and not
 * that of a sphere. The forward-acting grate of S12 chapter 4: grate 13 degrees down, bars 7
 * degrees up, so that every bar holds a pocket; two spheres wide; every bar slides along itself at
 * a speed of its own, its neighbours the other way, up to one stroke of 30 mm. */
#include "tests/bench/recipe.h"

#include <math.h>
#include <stdio.h>

enum { BARS = 11 };
static const double LENGTH = 0.190, HEIGHT = 0.030; /* m, of a bar */
static const double RADIUS = 0.0075, HALF_WIDTH = 0.016;
static const double FIRST = 0.0824; /* m, of bar 1 that shows, as of every other */
static const double DEGREE = 3.14159265358979 / 180;

typedef struct grate {
    double sine, cosine;   /* of the bars */
    clast_vec3 nose, next; /* m, top edge of bar 0, and from one nose to the next */
} grate;

/* A bar rests on the next one: their tops are one height apart across the bars, so from nose to
 * nose it is height / sin(7 + 13 degrees). */
static grate grate_new(void) {
    double bar = 7 * DEGREE, down = 13 * DEGREE, pitch = HEIGHT / sin(bar + down);
    grate g = {
        .sine = sin(bar), .cosine = cos(bar), .next = {pitch * cos(down), 0, -pitch * sin(down)}};
    return g;
}

static clast_vec3 nose_of(const grate *g, int bar) {
    return (clast_vec3){bar * g->next.x, 0, bar * g->next.z};
}

/* m, of the nose of a bar and `back` along it, `below` across it. */
static clast_vec3 place_on(const grate *g, int bar, double back, double below) {
    clast_vec3 n = nose_of(g, bar);
    return (clast_vec3){n.x - back * g->cosine + below * g->sine, 0,
                        n.z - back * g->sine - below * g->cosine};
}

/* Corners have x in bit 0, y in bit 1, z in bit 2. */
static const int32_t BOX[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                   {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                   {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

/* The bar as a closed box, as long and high as it is and half as wide again as the channel. */
static void corners_of(const grate *g, int bar, clast_vec3 corner[8]) {
    for (int v = 0; v < 8; v++) {
        corner[v] = place_on(g, bar, v & 1 ? 0 : LENGTH, v & 4 ? 0 : HEIGHT);
        corner[v].y = (v & 2 ? 1.5 : -1.5) * HALF_WIDTH;
    }
}

static clast_vec3 velocity_of(const grate *g, int bar) {
    double speed = (bar % 2 ? 1 : -1) * (2.5e-3 + 1e-4 * bar);
    return (clast_vec3){speed * g->cosine, 0, speed * g->sine};
}

static void add_bar(clast_world *w, const grate *g, int bar, bench_stage stage) {
    char name[16];
    snprintf(name, sizeof name, "bar %d", bar + 1);
    clast_vec3 corner[8], rest = {0, 0, 0};
    corners_of(g, bar, corner);
    clast_vec3 along = stage == BENCH_RUNNING ? velocity_of(g, bar) : rest;
    int part = clast_part_add(w, &(clast_part_def){.name = name, .velocity = along});
    clast_mesh_def box = {.name = name,
                          .material = BENCH_WALL,
                          .vertices = 8,
                          .triangles = 12,
                          .vertex = corner,
                          .triangle = &BOX[0][0]};
    if (clast_mesh_add(w, part, &box) < 0) bench_fail(w, name);
}

/* ---- for LIGGGHTS ------------------------------------------------------------------------------
 */

static void write_stl(const char *path, const clast_vec3 corner[8]) {
    FILE *f = fopen(path, "w");
    if (!f) bench_fail(NULL, path);
    fprintf(f, "solid bar\n");
    for (int t = 0; t < 12; t++) {
        fprintf(f, "facet normal 0 0 0\n outer loop\n");
        for (int k = 0; k < 3; k++) {
            clast_vec3 p = corner[BOX[t][k]];
            fprintf(f, "  vertex %.9g %.9g %.9g\n", p.x, p.y, p.z);
        }
        fprintf(f, " endloop\nendfacet\n");
    }
    fprintf(f, "endsolid bar\n");
    fclose(f);
}

/* A mesh and its motion for every bar, and the walls of the channel. */
static void grate_peer_walls(FILE *f, const char *stem) {
    const char *wall = "all wall/gran model hertz tangential history";
    grate g = grate_new();
    for (int i = 0; i < BARS; i++) {
        char path[4096];
        clast_vec3 corner[8], v = velocity_of(&g, i);
        snprintf(path, sizeof path, "%s-bar-%d.stl", stem, i + 1);
        corners_of(&g, i, corner);
        write_stl(path, corner);
        fprintf(f, "fix bar%d all mesh/surface file %s type 2\n", i + 1, path);
        fprintf(f, "fix move%d all move/mesh mesh bar%d linear %.12g %.12g %.12g\n", i + 1, i + 1,
                v.x, v.y, v.z);
    }
    fprintf(f, "fix w1 %s mesh n_meshes %d meshes", wall, BARS);
    for (int i = 0; i < BARS; i++) fprintf(f, " bar%d", i + 1);
    fprintf(f, " limitForce on\n");
    const double at[4] = {-HALF_WIDTH, HALF_WIDTH, place_on(&g, 0, FIRST, 0).x,
                          place_on(&g, BARS - 1, HEIGHT, 0).x};
    for (int k = 0; k < 4; k++)
        fprintf(f, "fix w%d %s primitive type 2 %cplane %.12g limitForce on\n", k + 2, wall,
                k < 2 ? 'y' : 'x', at[k]);
}

/* Side walls, a wall behind the first pocket and one through the last bar, which keeps its top on
 * both sides of it when it moves back. */
static void add_box(clast_world *w, const grate *g) {
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    bench_plane(w, box, "side 1", BENCH_WALL, (clast_vec3){0, -HALF_WIDTH, 0},
                (clast_vec3){0, 1, 0});
    bench_plane(w, box, "side 2", BENCH_WALL, (clast_vec3){0, HALF_WIDTH, 0},
                (clast_vec3){0, -1, 0});
    bench_plane(w, box, "inlet", BENCH_WALL, place_on(g, 0, FIRST, 0), (clast_vec3){1, 0, 0});
    bench_plane(w, box, "outlet", BENCH_WALL, place_on(g, BARS - 1, HEIGHT, 0),
                (clast_vec3){-1, 0, 0});
}

static void grate_half_size(const bench_scene *scene, double half[2]) {
    (void)scene;
    half[0] = 0, half[1] = HALF_WIDTH;
}

/* Swelling clay on acrylic, S12 table 4.3. */
static bench_law grate_law(void) {
    return (bench_law){.density = 700,
                       .young = 1e5,
                       .poisson = 0.4,
                       .wall_young = 3.2e9,
                       .wall_poisson = 0.4,
                       .restitution = 0.7,
                       .wall_restitution = 0.55,
                       .friction = 0.5,
                       .wall_friction = 0.8};
}

static clast_world *grate_world(const bench_scene *scene, const bench_wish *wish,
                                bench_stage stage) {
    grate g = grate_new();
    clast_world_def d = bench_def(scene, wish);
    d.domain_min = (clast_vec3){-0.25, -0.1, -0.4};
    d.domain_max = (clast_vec3){1.1, 0.1, 0.4};
    d.max_overlap = 0.3; /* E of swelling clay, S12 table 4.3 */
    d.global_damping = bench_damping(stage);
    clast_world *w = bench_world(&d);
    bench_law law = grate_law();
    bench_materials(w, &law);
    clast_shape_add_sphere(w, "sphere", RADIUS, BENCH_GRAIN);
    for (int i = 0; i < BARS; i++) add_bar(w, &g, i, stage);
    add_box(w, &g);
    return w;
}

/* Rows of two above the line of the noses. */
static void grate_fill(clast_world *w, const bench_scene *scene, const char *states) {
    (void)states;
    grate g = grate_new();
    const double pitch = 2.2 * RADIUS, play = 0.0005;
    double from = -FIRST + pitch, to = (BARS - 1) * g.next.x - HEIGHT - pitch;
    int along = (int)floor((to - from) / pitch);
    for (size_t i = 0; i < scene->bodies; i++) {
        int y = (int)i % 2, x = (int)i / 2 % along, layer = (int)i / 2 / along;
        double at = from + pitch * x;
        clast_vec3 p = {at + bench_uniform(3, 2 * i, -play, play),
                        (y ? 7.75e-3 : -7.75e-3) + bench_uniform(3, 2 * i + 1, -1e-4, 1e-4),
                        at / g.next.x * g.next.z + 1.5 * RADIUS + pitch * layer};
        bench_body(w, p, 0, (clast_vec3){0, 0, 0});
    }
}

static double grate_fall(const bench_scene *scene) {
    (void)scene;
    return 0.5;
}

const bench_recipe bench_grate = {"grate",      grate_world,     grate_fill,
                                  grate_law,    grate_half_size, .fall = grate_fall,
                                  .threads = 1, .limit = 3,      .peer_walls = grate_peer_walls};
