/* scene_channel.c - P: the spheres of G on a plane instead of bars, for a peer without meshes. A
 * channel as long and as wide as the grate, tilted like it by 13 degrees (gravity is); the spheres
 * pile up at its lower end, and the floor drags them uphill at the speed of the bars. */
#include "tests/bench/recipe.h"

#include <math.h>

static const double RADIUS = 0.0075, HALF_LENGTH = 0.455, HALF_WIDTH = 0.016; /* m */

static const double TILT = 13 * 3.14159265358979 / 180, BELT = 3.5e-3; /* rad, m/s */

static void channel_half_size(const bench_scene *scene, double half[2]) {
    (void)scene;
    half[0] = HALF_LENGTH, half[1] = HALF_WIDTH;
}

static bench_law channel_law(void) {
    return bench_grate.law();
}

static clast_world *channel_world(const bench_scene *scene, const bench_wish *wish,
                                  bench_stage stage) {
    clast_world_def d = bench_def(scene, wish);
    d.gravity = (clast_vec3){9.81 * sin(TILT), 0, -9.81 * cos(TILT)};
    d.domain_min = (clast_vec3){-0.5, -0.05, -0.02};
    d.domain_max = (clast_vec3){0.5, 0.05, 0.3};
    d.max_overlap = 0.3;
    d.global_damping = bench_damping(stage);
    clast_world *w = bench_world(&d);
    bench_law law = channel_law();
    bench_materials(w, &law);
    clast_shape_add_sphere(w, "sphere", RADIUS, BENCH_GRAIN);
    int part = clast_part_add(w, &(clast_part_def){.name = "channel"});
    bench_box_walls(w, part, HALF_LENGTH, HALF_WIDTH, stage == BENCH_RUNNING ? -BELT : 0);
    return w;
}

static void channel_fill(clast_world *w, const bench_scene *scene, const char *states) {
    (void)states;
    const double pitch = 2.2 * RADIUS, play = 0.0005;
    int along = (int)(2 * (HALF_LENGTH - pitch) / pitch);
    for (size_t i = 0; i < scene->bodies; i++) {
        int y = (int)i % 2, x = (int)i / 2 % along, layer = (int)i / 2 / along;
        clast_vec3 p = {pitch * (x + 1) - HALF_LENGTH + bench_uniform(5, 2 * i, -play, play),
                        (y ? 7.75e-3 : -7.75e-3) + bench_uniform(5, 2 * i + 1, -1e-4, 1e-4),
                        1.1 * RADIUS + pitch * layer};
        bench_body(w, p, 0, (clast_vec3){0, 0, 0});
    }
}

static double channel_fall(const bench_scene *scene) {
    (void)scene;
    return 0.5;
}

const bench_recipe bench_channel = {"channel",    channel_world,     channel_fill,
                                    channel_law,  channel_half_size, .fall = channel_fall,
                                    .threads = 1, .limit = 3};
