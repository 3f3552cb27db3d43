/* scene_tiles.c - large beds like A for the scaling figure: copies of the settled A20k side by
 * side, without the walls between them. Spheres of two copies that leaned on a wall from both sides
 * hardly touch each other, so the bed is at rest again soon. */
#include "tests/bench/recipe.h"

static const double DIAMETER = 0.01;
static const size_t TILE = 20000;

typedef struct tiling {
    int x, y;     /* copies */
    double width; /* m, of one */
} tiling;

/* As square as the number of copies allows. */
static tiling tiling_of(const bench_scene *scene) {
    int copies = (int)(scene->bodies / TILE), y = 1;
    for (int k = 1; k * k <= copies; k++)
        if (copies % k == 0) y = k;
    double half[2];
    bench_box.half_size(bench_scene_find("A20k"), half);
    return (tiling){copies / y, y, 2 * half[0]};
}

static void tiles_half_size(const bench_scene *scene, double half[2]) {
    tiling t = tiling_of(scene);
    half[0] = 0.5 * t.x * t.width, half[1] = 0.5 * t.y * t.width;
}

static bench_law tiles_law(void) {
    return bench_box.law();
}

static clast_world *tiles_world(const bench_scene *scene, const bench_wish *wish,
                                bench_stage stage) {
    clast_world_def d = bench_def(scene, wish);
    double half[2];
    tiles_half_size(scene, half);
    d.domain_min = (clast_vec3){-half[0] - DIAMETER, -half[1] - DIAMETER, -DIAMETER};
    d.domain_max = (clast_vec3){half[0] + DIAMETER, half[1] + DIAMETER, 0.6};
    d.max_overlap = stage == BENCH_RUNNING ? 0.2 : 0.4;
    d.global_damping = bench_damping(stage);
    clast_world *w = bench_world(&d);
    bench_law law = tiles_law();
    bench_materials(w, &law);
    clast_shape_add_sphere(w, "sphere", 0.5 * DIAMETER, BENCH_GRAIN);
    int part = clast_part_add(w, &(clast_part_def){.name = "box"});
    bench_box_walls(w, part, half[0], half[1], 0);
    return w;
}

static void tiles_fill(clast_world *w, const bench_scene *scene, const char *states) {
    tiling t = tiling_of(scene);
    bench_wish wish = {.threads = 1};
    clast_world *one = bench_scene_open(bench_scene_find("A20k"), &wish, states);
    clast_bodies b = clast_world_bodies(one);
    for (int k = 0; k < t.x * t.y; k++) {
        double x = t.width * (k % t.x - 0.5 * (t.x - 1)), y = t.width * (k / t.x - 0.5 * (t.y - 1));
        for (size_t i = 0; i < b.count; i++)
            bench_body(w, (clast_vec3){b.x[i] + x, b.y[i] + y, b.z[i]}, 0, (clast_vec3){0, 0, 0});
    }
    clast_world_free(one);
}

static double tiles_fall(const bench_scene *scene) {
    return 10 * scene->dt;
}

const bench_recipe bench_tiles = {"box",           tiles_world,        tiles_fill,   tiles_law,
                                  tiles_half_size, .fall = tiles_fall, .threads = 0, .limit = 1};
