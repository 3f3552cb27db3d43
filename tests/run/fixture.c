#include "tests/run/fixture.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/check.h"

#define R 0.006

static void add_walls(clast_world *w, int steel) {
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    int plug = clast_part_add(w, &(clast_part_def){.name = "plug", .removed_at = 0.2});
    int pusher = clast_part_add(
        w, &(clast_part_def){
               .name = "pusher", .velocity = {0.05, 0, 0}, .move_from = 0.02, .move_until = 0.06});
    clast_wall_def left = {.name = "left",
                           .kind = CLAST_WALL_PLANE,
                           .material = steel,
                           .point = {-0.002, 0, 0},
                           .normal = {1, 0, 0}};
    clast_wall_def right = {.name = "right",
                            .kind = CLAST_WALL_PLANE,
                            .material = steel,
                            .point = {0.1, 0, 0},
                            .normal = {-1, 0, 0}};
    clast_wall_def floors[2];
    for (int i = 0; i < 2; i++)
        floors[i] = (clast_wall_def){.name = i ? "floor right" : "floor left",
                                     .kind = CLAST_WALL_PLATE,
                                     .material = steel,
                                     .point = {i ? 0.095 : 0.005, 0, 0},
                                     .normal = {0, 0, 1},
                                     .side = {1, 0, 0},
                                     .half_side = {0.02, 0.02}};
    clast_wall_def stop = floors[0];
    stop.name = "plug";
    stop.point.x = 0.05;
    stop.half_side[0] = 0.026;
    CLAST_ASSERT(clast_wall_add(w, pusher, &left) == 0);
    CLAST_ASSERT(clast_wall_add(w, box, &right) == 1);
    CLAST_ASSERT(clast_wall_add(w, box, &floors[0]) == 2);
    CLAST_ASSERT(clast_wall_add(w, box, &floors[1]) == 3);
    CLAST_ASSERT(clast_wall_add(w, plug, &stop) == 4);
}

static void add_bodies(clast_world *w, int ball, int bell) {
    for (int i = 0; i < 24; i++) {
        double jitter = 1e-3 * clast_random(7, 1, (uint64_t)i);
        clast_body_def b = {
            .shape = i % 3 == 0 ? ball : bell,
            .position = {0.014 + 0.024 * (i % 4) + jitter, 0, 0.014 + 0.022 * (i / 4)},
            .orientation =
                clast_quat_axis_angle((clast_vec3){0, 1, 0}, 6 * clast_random(7, 2, (uint64_t)i)),
            .velocity = {0.3 * (clast_random(7, 3, (uint64_t)i) - 0.5), 0, -0.2}};
        CLAST_ASSERT(clast_body_add(w, &b) >= 0);
    }
}

/* Balls and dumb-bells that rain into the box, and an outlet below the plug. */
static void add_flow(clast_world *w, int ball, int bell) {
    const int kinds[2] = {ball, bell};
    clast_feed_def feed = {.name = "rain",
                           .region_min = {0.02, 0, 0.13},
                           .region_max = {0.08, 0, 0.16},
                           .shapes = 2,
                           .shape = kinds,
                           .number_rate = 150,
                           .from = 0.11,
                           .velocity = {0, 0, -0.3},
                           .turned = true};
    clast_outlet_def below = {.name = "below",
                              .kind = CLAST_OUTLET_BOX,
                              .min = {0.02, -0.05, -0.1},
                              .max = {0.06, 0.05, -0.06}};
    CLAST_ASSERT(clast_feed_add(w, &feed) == 0 && clast_outlet_add(w, &below) == 0);
}

clast_world *bed_world(const bed_options *o) {
    clast_world_def def = clast_world_def_default();
    def.law = CLAST_LAW_HERTZ_A00;
    def.motion = CLAST_MOTION_IN_PLANE;
    def.plane_axis = 1;
    def.domain_min = (clast_vec3){-0.05, -0.05, -0.1};
    def.domain_max = (clast_vec3){0.15, 0.05, 0.3};
    def.outside = CLAST_OUTSIDE_REMOVE;
    def.global_damping = 0.5;
    def.threads = o->threads > 0 ? o->threads : 1, def.spheres_per_thread = 1;
    if (o->max_overlap > 0) def.max_overlap = o->max_overlap;
    clast_world *w = clast_world_new(&def);
    CLAST_ASSERT(w);
    int button = clast_material_add(w, &(clast_material_def){"button", 1200, 2e7, 0.3});
    int steel = clast_material_add(w, &(clast_material_def){"steel", 7800, 2e8, 0.3});
    double friction = o->friction > 0 ? o->friction : 0.4;
    clast_pair_def pair = {.restitution = 0.5, .friction = friction};
    CLAST_ASSERT(clast_pair_set(w, button, button, &pair) == CLAST_OK);
    CLAST_ASSERT(clast_pair_set(w, button, steel, &pair) == CLAST_OK);
    int ball = clast_shape_add_sphere(w, "ball", R, button);
    clast_vec3 centre[2] = {{-0.7 * R, 0, 0}, {0.7 * R, 0, 0}};
    double radius[2] = {0.8 * R, 0.8 * R};
    int bell = clast_shape_add(w, &(clast_shape_def){.name = "dumb-bell",
                                                     .material = button,
                                                     .spheres = 2,
                                                     .centre = centre,
                                                     .radius = radius,
                                                     .mass = 1.1e-3,
                                                     .inertia = {1e-8, 2.5e-8, 2.5e-8}});
    CLAST_ASSERT(ball == 0 && bell == 1);
    add_walls(w, steel);
    if (o->empty) return w;
    add_bodies(w, ball, bell);
    add_flow(w, ball, bell);
    return w;
}

static const measure MEASURES[] = {
    {.name = "below", .kind = MEASURE_DISCHARGED, .level = 0},
    {.name = "left", .kind = MEASURE_REMAINING, .level = 0},
    {.name = "bed",
     .kind = MEASURE_SOLID_FRACTION,
     .level = 0,
     .x_min = 0,
     .x_max = 0.1,
     .sections = 10,
     .body_area = 1.1e-4},
    {.name = "band",
     .kind = MEASURE_BAND_VELOCITY,
     .level = 0,
     .x_min = 0,
     .x_max = 0.1,
     .height = 0.02,
     .thickness = 0.02},
    {.name = "partners", .kind = MEASURE_COORDINATION},
    {.name = "push", .kind = MEASURE_PART_LOAD, .part = 2},
    {.name = "press", .kind = MEASURE_LOAD_PROFILE, .part = 0, .height = 0.1, .sections = 3},
};

scene *bed_scene(const bed_options *o) {
    scene *s = calloc(1, sizeof *s);
    CLAST_ASSERT(s);
    s->path = "bed.yaml";
    s->title = "a \"small\" bed & its <plug>";
    s->text = "title: a small bed\n";
    static clast_material_def materials[2] = {{"button", 1200, 2e7, 0.3},
                                              {"steel", 7800, 2e8, 0.3}};
    s->materials = materials, s->material_count = 2;
    s->world = bed_world(o);
    CLAST_ASSERT(clast_world_prepare(s->world) == CLAST_OK);
    s->measures = malloc(sizeof MEASURES);
    CLAST_ASSERT(s->measures);
    memcpy(s->measures, MEASURES, sizeof MEASURES);
    s->measure_count = sizeof MEASURES / sizeof *MEASURES;
    s->ending = (ending){.latest = o->latest > 0 ? o->latest : 0.3};
    s->output = (output_plan){
        .frame_every = 0.01, .series_every = 0.002, .checkpoint_every = 0.015, .contacts = true};
    return s;
}

void bed_free(scene *s) {
    clast_world_free(s->world);
    free(s->measures);
    free(s);
}

char *test_folder(const char *name) {
    size_t room = strlen(name) + 64;
    char *path = malloc(room);
    CLAST_ASSERT(path);
    snprintf(path, room, "tmp-%s-%ld", name, (long)getpid());
    remove_folder(path);
    CLAST_ASSERT(mkdir(path, 0777) == 0);
    return path;
}

void remove_folder(const char *path) {
    DIR *d = opendir(path);
    if (!d) return;
    for (struct dirent *e; (e = readdir(d));) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) continue;
        size_t room = strlen(path) + strlen(e->d_name) + 2;
        char *inner = malloc(room);
        CLAST_ASSERT(inner);
        snprintf(inner, room, "%s/%s", path, e->d_name);
        remove_folder(inner);
        remove(inner);
        free(inner);
    }
    closedir(d);
    remove(path);
}

char *slurp(const char *path, size_t *length) {
    FILE *f = fopen(path, "rb");
    if (!f) return NULL;
    fseek(f, 0, SEEK_END);
    *length = (size_t)ftell(f);
    rewind(f);
    char *text = malloc(*length + 1);
    CLAST_ASSERT(text && fread(text, 1, *length, f) == *length);
    text[*length] = '\0';
    fclose(f);
    return text;
}
