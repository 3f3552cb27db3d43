#include "tests/ranks/crowd.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/support/bed.h"

static const double RADIUS = 0.005, STEP = 5e-5;
enum { SEED = 11 };

static void demand(bool fine, const clast_world *w) {
    if (fine) return;
    fprintf(stderr, "crowd: %s\n", w ? clast_world_error(w) : clast_world_new_error());
    exit(2);
}

static double uniform(uint64_t stream, int counter, double low, double high) {
    return low + (high - low) * clast_random(SEED, stream, (uint64_t)counter);
}

static clast_world *new_world(const clast_world_def *def) {
    clast_world *w = clast_world_new(def);
    demand(w != NULL, w);
    demand(clast_material_add(w, &(clast_material_def){"grain", 2500, 5e6, 0.3}) == 0, w);
    demand(clast_pair_set(
               w, 0, 0,
               &(clast_pair_def){.restitution = 0.5, .friction = 0.5, .stiffness = 2000}) == 0,
           w);
    return w;
}

static void add_plane(clast_world *w, int part, clast_vec3 point, clast_vec3 normal) {
    clast_wall_def plane = {"plane", CLAST_WALL_PLANE, 0, .point = point, .normal = normal};
    demand(clast_wall_add(w, part, &plane) >= 0, w);
}

/* Sides at +- half along x, and along y unless it is flat. */
static void add_sides(clast_world *w, double half_x, double half_y) {
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    if (half_x > 0) {
        add_plane(w, box, (clast_vec3){-half_x, 0, 0}, (clast_vec3){1, 0, 0});
        add_plane(w, box, (clast_vec3){half_x, 0, 0}, (clast_vec3){-1, 0, 0});
    }
    if (half_y > 0) {
        add_plane(w, box, (clast_vec3){0, -half_y, 0}, (clast_vec3){0, 1, 0});
        add_plane(w, box, (clast_vec3){0, half_y, 0}, (clast_vec3){0, -1, 0});
    }
}

static void add_floor(clast_world *w) {
    int floor = clast_part_add(w, &(clast_part_def){.name = "floor"});
    add_plane(w, floor, (clast_vec3){0, 0, 0}, (clast_vec3){0, 0, 1});
}

/* A grid with play. */
static void fill(clast_world *w, int count, int columns, int rows, double pitch, bool turned) {
    double play = 0.04 * pitch;
    int shapes = clast_world_shape_count(w);
    for (int i = 0; i < count; i++) {
        int x = i % columns, y = i / columns % rows, z = i / columns / rows;
        clast_body_def b = {
            .shape = i % shapes,
            .position = {pitch * (x - 0.5 * (columns - 1)) + uniform(1, i, -play, play),
                         rows > 1 ? pitch * (y - 0.5 * (rows - 1)) + uniform(2, i, -play, play) : 0,
                         pitch * (z + 0.6) + uniform(3, i, 0, play)},
            .velocity = {uniform(4, i, -0.3, 0.3), rows > 1 ? uniform(5, i, -0.3, 0.3) : 0, 0}};
        b.orientation =
            clast_quat_axis_angle((clast_vec3){0.48, 0.6, 0.64}, turned ? uniform(6, i, -3, 3) : 0);
        demand(clast_body_add(w, &b) >= 0, w);
    }
}

static void add_sphere(clast_world *w) {
    demand(clast_shape_add_sphere(w, "sphere", RADIUS, 0) >= 0, w);
}

static clast_world *make_box(const clast_world_def *base) {
    clast_world *w = new_world(base);
    add_sphere(w);
    add_sides(w, 0.045, 0.045);
    add_floor(w);
    fill(w, 500, 8, 8, 0.0108, false);
    return w;
}

/* In touch from the start, each with a way of its own. */
static clast_world *make_pressed(const clast_world_def *base) {
    clast_world *w = new_world(base);
    add_sphere(w);
    add_sides(w, 0.0405, 0.0405);
    add_floor(w);
    fill(w, 300, 8, 8, 0.0098, false);
    return w;
}

static clast_world *make_sizes(const clast_world_def *base) {
    clast_world *w = new_world(base);
    for (int i = 0; i < 4; i++)
        demand(clast_shape_add_sphere(w, "sphere", RADIUS * (0.55 + 0.15 * i), 0) >= 0, w);
    add_sides(w, 0.045, 0.045);
    add_floor(w);
    fill(w, 500, 8, 8, 0.0108, false);
    return w;
}

static clast_world *make_layer(const clast_world_def *base) {
    clast_world_def d = *base;
    d.motion = CLAST_MOTION_IN_PLANE, d.plane_axis = 1;
    clast_world *w = new_world(&d);
    add_sphere(w);
    add_sides(w, 0.12, 0);
    add_floor(w);
    fill(w, 400, 20, 1, 0.0108, false);
    return w;
}

/* ---- clumps
 * -------------------------------------------------------------------------------------- */

static void add_rod(clast_world *w, double r) {
    double mass = 4.0 / 3.0 * 3.14159265358979 * r * r * r * 2500, about = 0.4 * mass * r * r;
    clast_vec3 centre[2] = {{-0.6 * r, 0, 0}, {0.6 * r, 0, 0}};
    double radius[2] = {r, r};
    clast_shape_def rod = {.name = "rod",
                           .material = 0,
                           .spheres = 2,
                           .centre = centre,
                           .radius = radius,
                           .mass = 1.7 * mass,
                           .inertia = {1.7 * about, 3.2 * about, 3.2 * about}};
    demand(clast_shape_add(w, &rod) >= 0, w);
}

static clast_world *make_rods(const clast_world_def *base) {
    clast_world_def d = *base;
    d.clump_contact = CLAST_CLUMP_SHARED;
    clast_world *w = new_world(&d);
    add_rod(w, RADIUS);
    add_sides(w, 0.055, 0.055);
    add_floor(w);
    fill(w, 220, 6, 6, 0.0172, true);
    return w;
}

/* Rods and balls that turn about no axis of theirs, each contact with a dashpot of its own, mixed
 * precision, rolling friction. */
static clast_world *make_mixture(const clast_world_def *base) {
    clast_world_def d = *base;
    d.precision = CLAST_PRECISION_MIXED;
    clast_world *w = new_world(&d);
    demand(clast_pair_set(w, 0, 0,
                          &(clast_pair_def){
                              .restitution = 0.5, .friction = 0.5, .rolling_friction = 0.05}) == 0,
           w);
    add_rod(w, RADIUS);
    add_sphere(w);
    add_rod(w, 0.7 * RADIUS);
    add_sides(w, 0.055, 0.055);
    add_floor(w);
    fill(w, 250, 6, 6, 0.0172, true);
    return w;
}

/* ---- walls that move, meshes -------------------------------------------------------------------
 */

enum { SIDES = 32, DRUM_POINTS = 2 * SIDES, DRUM_TRIANGLES = 4 * SIDES };

/* A tube along y of that radius about the origin, closed at its ends. */
static void add_tube(clast_world *w, int part, double radius, double half) {
    clast_vec3 vertex[DRUM_POINTS + 2];
    int32_t triangle[3 * DRUM_TRIANGLES], n = 0;
    for (int i = 0; i < SIDES; i++) {
        double sine, cosine;
        clast_sincos(2 * 3.14159265358979 * i / SIDES, &sine, &cosine);
        vertex[2 * i] = (clast_vec3){radius * cosine, -half, radius * sine};
        vertex[2 * i + 1] = (clast_vec3){radius * cosine, half, radius * sine};
        int a = 2 * i, b = 2 * ((i + 1) % SIDES);
        const int32_t corners[4][3] = {
            {a, a + 1, b}, {b, a + 1, b + 1}, {a, b, DRUM_POINTS}, {a + 1, b + 1, DRUM_POINTS + 1}};
        for (int k = 0; k < 12; k++) triangle[n++] = corners[k / 3][k % 3];
    }
    vertex[DRUM_POINTS] = (clast_vec3){0, -half, 0},
    vertex[DRUM_POINTS + 1] = (clast_vec3){0, half, 0};
    clast_mesh_def mesh = {.name = "drum",
                           .material = 0,
                           .vertices = DRUM_POINTS + 2,
                           .triangles = DRUM_TRIANGLES,
                           .vertex = vertex,
                           .triangle = triangle};
    demand(clast_mesh_add(w, part, &mesh) > 0, w);
}

/* Clumps in a drum that turns; the plastic law. */
static clast_world *make_drum(const clast_world_def *base) {
    clast_world_def d = *base;
    d.law = CLAST_LAW_WALTON_BRAUN, d.clump_contact = CLAST_CLUMP_EACH;
    d.domain_min.z = -1, d.time_step = 2e-5;
    clast_world *w = new_world(&d);
    demand(clast_pair_set(
               w, 0, 0,
               &(clast_pair_def){.restitution = 0.6, .friction = 0.5, .stiffness = 2000}) == 0,
           w);
    add_rod(w, RADIUS);
    add_sphere(w);
    clast_part_def turning = {.name = "drum", .rotation = {.axis = {0, 1, 0}, .speed = 12}};
    add_tube(w, clast_part_add(w, &turning), 0.08, 0.04);
    for (int i = 0; i < 150; i++) {
        clast_body_def b = {
            .shape = i % 2,
            .position = {0.017 * (i % 6 - 2.5), 0.017 * (i / 6 % 4 - 1.5), 0.017 * (i / 24 - 2.5)},
            .velocity = {uniform(4, i, -0.3, 0.3), uniform(5, i, -0.3, 0.3), 0}};
        b.orientation = clast_quat_axis_angle((clast_vec3){0.48, 0.6, 0.64}, uniform(6, i, -3, 3));
        demand(clast_body_add(w, &b) >= 0, w);
    }
    return w;
}

/* Flow over a bed that turns up and down, along a periodic axis and across another. */
static clast_world *make_periodic(const clast_world_def *base) {
    clast_world_def d = *base;
    d.periodic[0] = d.periodic[1] = true;
    d.domain_min.x = -0.045, d.domain_max.x = 0.045;
    d.domain_min.y = -0.035, d.domain_max.y = 0.035;
    d.gravity = (clast_vec3){6, 1, -7}, d.global_damping = 0.5;
    clast_world *w = new_world(&d);
    add_sphere(w);
    add_floor(w);
    fill(w, 400, 8, 6, 0.0108, false);
    return w;
}

/* Round along one axis, with walls on either side. */
static clast_world *make_channel(const clast_world_def *base) {
    clast_world_def d = *base;
    d.periodic[0] = true, d.domain_min.x = -0.065, d.domain_max.x = 0.065;
    d.gravity = (clast_vec3){5, 0, -8};
    clast_world *w = new_world(&d);
    add_sphere(w);
    add_sides(w, 0, 0.03);
    add_floor(w);
    fill(w, 300, 12, 5, 0.0108, false);
    return w;
}

/* Round along all three: nothing but bodies, three cells across. */
static clast_world *make_gas(const clast_world_def *base) {
    clast_world_def d = *base;
    d.gravity = (clast_vec3){0, 0, 0};
    d.domain_min = (clast_vec3){-0.0185, -0.0185, 0},
    d.domain_max = (clast_vec3){0.0185, 0.0185, 0.2};
    for (int k = 0; k < 3; k++) d.periodic[k] = true;
    clast_world *w = new_world(&d);
    add_sphere(w);
    fill(w, 108, 3, 3, 0.012, false);
    return w;
}

/* ---- coming and going
 * ---------------------------------------------------------------------------- */

/* Bodies rain on a pusher that goes to and fro, fall off its end, and leave in three ways. */
static clast_world *make_grate(const clast_world_def *base) {
    clast_world_def d = *base;
    d.outside = CLAST_OUTSIDE_REMOVE;
    d.domain_min = (clast_vec3){-0.2, -0.03, -0.1}, d.domain_max = (clast_vec3){0.2, 0.03, 0.3};
    clast_world *w = new_world(&d);
    add_sphere(w);
    add_rod(w, 0.8 * RADIUS);
    add_sides(w, 0, 0.03);
    for (int i = 0; i < 5; i++) {
        clast_part_def bar = {.name = "bar",
                              .stroke = {{i % 2 ? 0.02 : 0, 0, 0}, 0.3, 0.005, 0.2 * i}};
        clast_wall_def plate = {.name = "plate",
                                .kind = CLAST_WALL_PLATE,
                                .point = {-0.08 + 0.035 * i, 0, 0.02 - 0.004 * i},
                                .normal = {0, 0, 1},
                                .side = {1, 0, 0},
                                .half_side = {0.024, 0.03}};
        int part = clast_part_add(w, &bar);
        demand(clast_wall_add(w, part, &plate) >= 0, w);
        plate.name = "nose", plate.point.x += 0.024, plate.point.z -= 0.002;
        plate.normal = (clast_vec3){1, 0, 0}, plate.side = (clast_vec3){0, 1, 0};
        plate.half_side[0] = 0.03, plate.half_side[1] = 0.002;
        demand(clast_wall_add(w, part, &plate) >= 0, w);
    }
    static const int shapes[2] = {0, 1};
    clast_feed_def feed = {.name = "rain",
                           .region_min = {-0.1, -0.02, 0.06},
                           .region_max = {0.02, 0.02, 0.08},
                           .shapes = 2,
                           .shape = shapes,
                           .number_rate = 2500,
                           .velocity = {0.2, 0, -0.8},
                           .turned = true};
    demand(clast_feed_add(w, &feed) >= 0, w);
    clast_outlet_def box = {.name = "bin",
                            .kind = CLAST_OUTLET_BOX,
                            .min = {-0.2, -0.03, -0.05},
                            .max = {0.05, 0.03, -0.01}};
    clast_outlet_def beyond = {
        .name = "end", .kind = CLAST_OUTLET_PLANE, .point = {0.11, 0, 0}, .normal = {1, 0, 0}};
    demand(clast_outlet_add(w, &box) >= 0 && clast_outlet_add(w, &beyond) >= 0, w);
    return w;
}

static clast_world *make_bed(const clast_world_def *base) {
    bed_wish wish = {.threads = base->threads,
                     .alone = base->alone,
                     .law = CLAST_LAW_HERTZ_A00,
                     .clump_contact = CLAST_CLUMP_SHARED,
                     .motion = CLAST_MOTION_IN_PLANE};
    return bed_new(&wish);
}

const crowd CROWDS[] = {
    {"box", 200, false, make_box},           {"sizes", 300, false, make_sizes},
    {"layer", 500, false, make_layer},       {"rods", 400, false, make_rods},
    {"mixture", 400, false, make_mixture},   {"drum", 1000, true, make_drum},
    {"periodic", 400, false, make_periodic}, {"grate", 2500, true, make_grate},
    {"bed", 700, false, make_bed},           {"channel", 300, false, make_channel},
    {"gas", 300, false, make_gas},           {"pressed", 200, false, make_pressed},
};
const int CROWD_COUNT = sizeof CROWDS / sizeof *CROWDS;

clast_world *crowd_new(const crowd *c, bool alone, int threads) {
    clast_world_def d = clast_world_def_default();
    d.time_step = STEP;
    d.alone = alone, d.threads = threads, d.spheres_per_thread = 1;
    d.max_overlap = 0.4;
    d.impact_speed = 0.5;
    d.domain_min = (clast_vec3){-1, -1, -0.01}, d.domain_max = (clast_vec3){1, 1, 3};
    clast_world *w = c->make(&d);
    demand(clast_world_prepare(w) == CLAST_OK, w);
    return w;
}
