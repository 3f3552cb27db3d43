/* scene_silo.c - D: the spheres of A in a cylindrical silo with a flat bottom, read from an STL
 * file of 2000 triangles (meshes/). */
#include "tests/bench/recipe.h"

#include "meshes/mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double DIAMETER = 0.01, RADIUS = 0.1, HEIGHT = 1.2; /* m */

static void silo_half_size(const bench_scene *scene, double half[2]) {
    (void)scene;
    half[0] = half[1] = RADIUS;
}

static void add_silo(clast_world *w) {
    mesh_options options = mesh_options_default();
    mesh_surface silo;
    if (mesh_load(CLAST_BENCH_SILO, &options, &silo, NULL) != MESH_OK) {
        fprintf(stderr, "bench: %s\n", mesh_error_text());
        exit(1);
    }
    clast_vec3 *vertex = calloc(silo.vertex_count, sizeof *vertex);
    if (!vertex) abort();
    for (size_t i = 0; i < silo.vertex_count; i++)
        vertex[i] =
            (clast_vec3){silo.vertex[3 * i], silo.vertex[3 * i + 1], silo.vertex[3 * i + 2]};
    int part = clast_part_add(w, &(clast_part_def){.name = "silo"});
    clast_mesh_def mesh = {.name = "silo",
                           .material = BENCH_WALL,
                           .vertex = vertex,
                           .vertices = (int)silo.vertex_count,
                           .triangle = silo.triangle,
                           .triangles = (int)silo.triangle_count};
    if (clast_mesh_add(w, part, &mesh) < 0) bench_fail(w, "silo");
    free(vertex);
    mesh_free(&silo);
}

static clast_world *silo_world(const bench_scene *scene, const bench_wish *wish,
                               bench_stage stage) {
    clast_world_def d = bench_def(scene, wish);
    double room = RADIUS + DIAMETER;
    d.domain_min = (clast_vec3){-room, -room, -DIAMETER};
    d.domain_max = (clast_vec3){room, room, 2 * HEIGHT};
    d.max_overlap = stage == BENCH_RUNNING ? 0.2 : 0.4;
    d.global_damping = bench_damping(stage);
    clast_world *w = bench_world(&d);
    bench_law law = bench_box.law();
    bench_materials(w, &law);
    clast_shape_add_sphere(w, "sphere", 0.5 * DIAMETER, BENCH_GRAIN);
    add_silo(w);
    return w;
}

/* The places of a grid whose spheres, with their play, are inside the silo. */
static void silo_fill(clast_world *w, const bench_scene *scene, const char *states) {
    (void)states;
    const double pitch = 1.05 * DIAMETER, play = 0.5 * (pitch - DIAMETER), speed = 0.3;
    int across = (int)floor(2 * RADIUS / pitch);
    double corner = -0.5 * pitch * (across - 1), room = 0.995 * RADIUS - 0.5 * pitch;
    uint64_t placed = 0;
    for (int place = 0; placed < scene->bodies; place++) {
        double x = corner + pitch * (place % across),
               y = corner + pitch * (place / across % across);
        double z = pitch * (place / across / across + 0.6);
        if (sqrt(x * x + y * y) + play > room) continue;
        clast_vec3 p = {x + bench_uniform(4, 6 * placed, -play, play),
                        y + bench_uniform(4, 6 * placed + 1, -play, play),
                        z + bench_uniform(4, 6 * placed + 2, -play, play)};
        clast_vec3 v = {bench_uniform(4, 6 * placed + 3, -speed, speed),
                        bench_uniform(4, 6 * placed + 4, -speed, speed),
                        bench_uniform(4, 6 * placed + 5, -speed, speed)};
        bench_body(w, p, 0, v);
        placed++;
    }
}

static double silo_fall(const bench_scene *scene) {
    (void)scene;
    return 0.25;
}

static bench_law silo_law(void) {
    return bench_box.law();
}

const bench_recipe bench_silo = {"silo",         silo_world,        silo_fill,    silo_law,
                                 silo_half_size, .fall = silo_fall, .threads = 0, .limit = 1};
