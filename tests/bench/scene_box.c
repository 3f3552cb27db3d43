/* scene_box.c - A: equal spheres at rest in an open box of five planes, settled with friction. */
#include "tests/bench/recipe.h"

#include <math.h>

static const double DIAMETER = 0.01; /* m */

/* The bed is about as high as wide: at a solid fraction of 0.6, n = 0.6 / (pi/6) w^3. */
static double width_of(const bench_scene *scene) {
    return DIAMETER * floor(cbrt((double)scene->bodies));
}

static void box_half_size(const bench_scene *scene, double half[2]) {
    half[0] = half[1] = 0.5 * width_of(scene);
}

static bench_law box_law(void) {
    return (bench_law){.density = 2500,
                       .young = 5e6,
                       .poisson = 0.3,
                       .wall_young = 5e6,
                       .wall_poisson = 0.3,
                       .restitution = 0.5,
                       .wall_restitution = 0.5,
                       .friction = 0.5,
                       .wall_friction = 0.5};
}

static clast_world *box_world(const bench_scene *scene, const bench_wish *wish, bench_stage stage) {
    clast_world_def d = bench_def(scene, wish);
    double half = 0.5 * width_of(scene), room = half + DIAMETER;
    bool settling = stage != BENCH_RUNNING;
    d.domain_min = (clast_vec3){-room, -room, -DIAMETER};
    d.domain_max = (clast_vec3){room, room, 8 * room};
    d.max_overlap = settling ? 0.4 : 0.2; /* E is soft: the bottom of the bed carries 40 cm */
    d.global_damping = bench_damping(stage);
    clast_world *w = bench_world(&d);
    bench_law law = box_law();
    bench_materials(w, &law);
    clast_shape_add_sphere(w, "sphere", 0.5 * DIAMETER, BENCH_GRAIN);
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    bench_box_walls(w, box, half, half, 0);
    return w;
}

/* A grid with play; the spheres start with small velocities of any direction, so that the bed
 * forgets the grid. */
static void box_fill(clast_world *w, const bench_scene *scene, const char *states) {
    (void)states;
    const double pitch = 1.08 * DIAMETER, play = 0.5 * (pitch - DIAMETER), speed = 0.3;
    int across = (int)floor(width_of(scene) / pitch);
    double corner = -0.5 * pitch * (across - 1);
    for (size_t i = 0; i < scene->bodies; i++) {
        int place = (int)i, x = place % across, y = place / across % across;
        int z = place / across / across;
        clast_vec3 p = {corner + pitch * x + bench_uniform(1, 6 * i, -play, play),
                        corner + pitch * y + bench_uniform(1, 6 * i + 1, -play, play),
                        pitch * (z + 0.6) + bench_uniform(1, 6 * i + 2, -play, play)};
        clast_vec3 v = {bench_uniform(1, 6 * i + 3, -speed, speed),
                        bench_uniform(1, 6 * i + 4, -speed, speed),
                        bench_uniform(1, 6 * i + 5, -speed, speed)};
        bench_body(w, p, 0, v);
    }
}

/* s: the top of the grid, 1.08 d apart, sinks by a third. */
static double box_fall(const bench_scene *scene) {
    double width = width_of(scene), cell = 1.08 * DIAMETER;
    double height = (double)scene->bodies * cell * cell * cell / (width * width);
    return 1.1 * sqrt(2 * 0.35 * height / 9.81);
}

const bench_recipe bench_box = {"box",         box_world,        box_fill,     box_law,
                                box_half_size, .fall = box_fall, .threads = 0, .limit = 1};
