/* bed.c - the hopper, its filling, and the worlds they make. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"

static const double PI = 3.14159265358979323846;

#define PITCH          0.013  /* m, of the lattice */
#define LATTICE_HEIGHT 0.4    /* m, of its lowest row above the orifice, or as much as it needs */
#define JITTER         0.4e-3 /* m, random shift to either side: 1 mm is free between the largest */
#define AT_REST        1e-4   /* m/s */
#define REST_LATEST    20.0   /* s */

/* Streams of random numbers. */
enum { DRAW_SIZE, DRAW_X, DRAW_Z, DRAW_TRACER };

/* ---- spheres --------------------------------------------------------------------------------- */

double sphere_radius(int size) {
    CLAST_ASSERT(size >= 0 && size < SIZES);
    return 0.5 * (DIAMETER_LEAST + (size + 0.5) / SIZES * (DIAMETER_MOST - DIAMETER_LEAST));
}

static double mass_of(double radius) {
    return STEEL_DENSITY * 4.0 / 3 * PI * radius * radius * radius;
}

double sphere_mass(int size) {
    return mass_of(sphere_radius(size));
}

double shortest_contact(void) {
    return PI * sqrt(0.5 * mass_of(0.5 * DIAMETER_LEAST) / STIFFNESS);
}

/* ---- the hopper ------------------------------------------------------------------------------ */

/* README.md, "Assumptions": from the sample case that the source names. */
hopper hopper_usual(int rows) {
    return (hopper){.orifice = 0.095, .slope = 0.5, .funnel = 0.5, .rows = rows};
}

double hopper_latest(const hopper *h) {
    return h->flat ? FLAT_LATEST : RESIDENCE_LATEST;
}

void hopper_walls(const hopper *h, hopper_wall walls[HOPPER_WALLS]) {
    double lip = 0.5 * h->orifice, side = lip + h->slope * h->funnel, tall = 4;
    double steep = sqrt(1 + h->slope * h->slope), slant = h->funnel * steep;
    if (h->flat) {
        walls[0] = (hopper_wall){"floor_left", 0, 1, -side, 0, side - lip};
        walls[1] = (hopper_wall){"floor_right", 0, 1, lip, 0, side - lip};
        walls[2] = (hopper_wall){"left", 1, 0, -side, 0, tall};
        walls[3] = (hopper_wall){"right", -1, 0, side, 0, tall};
        return;
    }
    walls[0] = (hopper_wall){"funnel_left", 1 / steep, h->slope / steep, -lip, 0, slant};
    walls[1] = (hopper_wall){"funnel_right", -1 / steep, h->slope / steep, lip, 0, slant};
    walls[2] = (hopper_wall){"left", 1, 0, -side, h->funnel, tall};
    walls[3] = (hopper_wall){"right", -1, 0, side, h->funnel, tall};
}

static void stop(const char *what) {
    fprintf(stderr, "hopper-discharge: %s\n", what);
    exit(4);
}

/* A plate goes up from its lower end; its second side is across the layer. */
static clast_wall_def wall_of(const hopper_wall *l, bool plate, int steel) {
    double ux = l->nz, uz = -l->nx; /* along the wall, the end that points upwards */
    if (uz < 0) ux = -ux, uz = -uz;
    clast_wall_def def = {.name = l->name,
                          .kind = plate ? CLAST_WALL_PLATE : CLAST_WALL_PLANE,
                          .material = steel,
                          .point = {l->px, 0, l->pz},
                          .normal = {l->nx, 0, l->nz}};
    if (!plate) return def;
    def.point.x += 0.5 * l->length * ux, def.point.z += 0.5 * l->length * uz;
    def.side = (clast_vec3){ux, 0, uz};
    def.half_side[0] = 0.5 * l->length, def.half_side[1] = 1;
    return def;
}

static void add_walls(clast_world *w, const hopper *h, int steel) {
    hopper_wall walls[HOPPER_WALLS];
    hopper_walls(h, walls);
    int part = clast_part_add(w, &(clast_part_def){.name = "hopper"});
    int first = h->flat && h->solid ? 2 : 0; /* a flat bottom that is closed is the gate alone */
    for (int i = first; i < HOPPER_WALLS; i++) {
        clast_wall_def def = wall_of(&walls[i], !h->solid, steel);
        if (clast_wall_add(w, part, &def) < 0) stop(clast_world_error(w));
    }
}

static void add_floor(clast_world *w, int steel) {
    int part = clast_part_add(w, &(clast_part_def){.name = "gate"});
    clast_wall_def def = {
        .name = "gate", .kind = CLAST_WALL_PLANE, .material = steel, .normal = {0, 0, 1}};
    if (clast_wall_add(w, part, &def) < 0) stop(clast_world_error(w));
}

static void add_spheres(clast_world *w, const bed *b, int steel) {
    char name[24];
    int shape[SIZES];
    for (int i = 0; i < SIZES; i++) {
        snprintf(name, sizeof name, "size %d", i);
        shape[i] = clast_shape_add_sphere(w, name, sphere_radius(i), steel);
        if (shape[i] < 0) stop(clast_world_error(w));
    }
    for (int i = 0; i < b->count; i++)
        if (clast_body_add(w, &(clast_body_def){.shape = shape[b->size[i]],
                                                .position = {b->x[i], 0, b->z[i]}}) < 0)
            stop(clast_world_error(w));
}

/* ---- worlds ---------------------------------------------------------------------------------- */

static clast_world_def common_def(void) {
    const double any = 1e9;
    clast_world_def d = clast_world_def_default();
    d.gravity = (clast_vec3){0, 0, -GRAVITY};
    d.law = CLAST_LAW_LINEAR;
    d.motion = CLAST_MOTION_IN_PLANE;
    d.plane_axis = 1;
    d.impact_speed = 5;                        /* the linear law does not ask */
    d.max_displacement = d.max_residual = any; /* flow.c watches the energy */
    d.threads = 1;
    return d;
}

static clast_world *build(const clast_world_def *d, const hopper *h, const bed *b,
                          double restitution, bool closed) {
    clast_world *w = clast_world_new(d);
    if (!w) stop(clast_world_new_error());
    int steel = clast_material_add(w, &(clast_material_def){"steel", STEEL_DENSITY, 200e9, 0.3});
    clast_pair_def pair = {.restitution = restitution, .stiffness = STIFFNESS};
    if (clast_pair_set(w, steel, steel, &pair)) stop(clast_world_error(w));
    add_walls(w, h, steel);
    if (closed) add_floor(w, steel);
    add_spheres(w, b, steel);
    if (clast_world_prepare(w)) stop(clast_world_error(w));
    return w;
}

clast_world *world_open(const hopper *h, const bed *b, const world_plan *plan) {
    CLAST_ASSERT(h && b && b->count > 0 && plan && plan->step > 0);
    clast_world_def d = common_def();
    d.scheme = plan->scheme;
    d.time_step = plan->step;
    if (plan->tolerance > 0) d.newton_tolerance = plan->tolerance;
    if (plan->relaxes) d.linear_solver = CLAST_SOLVER_GAUSS_SEIDEL;
    d.max_overlap = OVERLAP_LIMIT;
    d.outside = CLAST_OUTSIDE_REMOVE;
    d.domain_min = (clast_vec3){-3, -1, h->solid ? 0 : -0.15};
    d.domain_max = (clast_vec3){3, 1, 5};
    return build(&d, h, b, 1, false);
}

/* ---- filling --------------------------------------------------------------------------------- */

static int size_of(size_law law, double u) {
    const double least = DIAMETER_LEAST, most = DIAMETER_MOST;
    double d = least + u * (most - least);
    if (law == SIZES_INVERSE) d = least * most / (most - u * (most - least));
    int size = (int)((d - least) / (most - least) * SIZES);
    return size < SIZES ? size : SIZES - 1;
}

static double shift(uint64_t seed, int stream, int i) {
    return JITTER * (2 * clast_random(seed, (uint64_t)stream, (uint64_t)i) - 1);
}

static void place(bed *b, uint64_t seed, int i, double x, double z) {
    b->x[i] = x + shift(seed, DRAW_X, i);
    b->z[i] = z + shift(seed, DRAW_Z, i);
}

/* COLUMNS side by side, high enough to stand clear of the funnel. */
static void place_above(const hopper *h, uint64_t seed, bed *b) {
    double half = 0.5 * (COLUMNS - 1) * PITCH;
    double needs = h->flat ? 0 : (half + PITCH - 0.5 * h->orifice) / h->slope;
    double lowest = fmax(LATTICE_HEIGHT, needs);
    for (int i = 0; i < b->count; i++)
        place(b, seed, i, (i % COLUMNS) * PITCH - half, lowest + (i / COLUMNS) * PITCH);
}

/* As many in each row as the hopper is wide there. */
static void place_within(const hopper *h, uint64_t seed, bed *b) {
    CLAST_ASSERT(!h->flat);
    double clear = 0.5 * PITCH * sqrt(1 + h->slope * h->slope);
    double widest = 0.5 * h->orifice + h->slope * h->funnel, z = 0.5 * PITCH;
    for (int i = 0; i < b->count; z += PITCH) {
        double half = fmin(0.5 * h->orifice + h->slope * z, widest) - clear;
        int across = 1 + (int)(2 * half / PITCH);
        for (int k = 0; k < across && i < b->count; k++, i++)
            place(b, seed, i, (k - 0.5 * (across - 1)) * PITCH, z);
    }
}

static double fastest(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    double most = 0;
    for (size_t i = 0; i < b.count; i++) most = fmax(most, b.vx[i] * b.vx[i] + b.vz[i] * b.vz[i]);
    return sqrt(most);
}

/* With dashpots and a drag on every motion; where it comes to rest is a matter of the springs
 * alone. Between solid walls: spheres fall in faster than a plate could hold. */
static void settle(const hopper *open, bed *b) {
    hopper h = *open;
    h.solid = true;
    clast_world_def d = common_def();
    const double any = 1e9;
    d.max_overlap = any;
    d.global_damping = 3;
    d.domain_min = (clast_vec3){-3, -1, -1};
    d.domain_max = (clast_vec3){3, 1, 5};
    clast_world *w = build(&d, &h, b, 0.3, true);
    double speed = INFINITY, time = 0;
    while (speed > AT_REST && time < REST_LATEST) {
        time += 0.1;
        if (clast_world_run(w, time)) stop(clast_world_error(w));
        speed = fastest(w);
    }
    if (!(speed <= AT_REST)) stop("a bed does not come to rest");
    clast_bodies at = clast_world_bodies(w);
    for (size_t i = 0; i < at.count; i++) b->x[at.id[i]] = at.x[i], b->z[at.id[i]] = at.z[i];
    b->fastest = speed, b->settled = time;
    clast_world_free(w);
}

static const bed *sorted_bed;

static int by_height(const void *a, const void *b) {
    int i = *(const int *)a, j = *(const int *)b;
    double zi = sorted_bed->z[i], zj = sorted_bed->z[j];
    return zi < zj ? -1 : zi > zj ? 1 : i - j;
}

/* One of every ten spheres that follow one another in height. */
static void choose_tracers(bed *b, uint64_t seed) {
    int order[SPHERES];
    for (int i = 0; i < b->count; i++) order[i] = i, b->tracer[i] = false;
    sorted_bed = b;
    qsort(order, (size_t)b->count, sizeof *order, by_height);
    for (int first = 0; first + TRACER_EVERY <= b->count; first += TRACER_EVERY) {
        double u = clast_random(seed, DRAW_TRACER, (uint64_t)first);
        b->tracer[order[first + (int)(u * TRACER_EVERY)]] = true;
    }
}

void bed_make(const hopper *h, uint64_t seed, bed *b) {
    CLAST_ASSERT(h && b && h->rows > 0 && h->rows <= ROWS);
    memset(b, 0, sizeof *b);
    b->count = COLUMNS * h->rows;
    for (int i = 0; i < b->count; i++)
        b->size[i] = size_of(h->sizes, clast_random(seed, DRAW_SIZE, (uint64_t)i));
    if (h->filling == FILL_LOOSE)
        place_within(h, seed, b);
    else
        place_above(h, seed, b), settle(h, b);
    choose_tracers(b, seed);
}

double bed_mass(const bed *b) {
    double mass = 0;
    for (int i = 0; i < b->count; i++) mass += sphere_mass(b->size[i]);
    return mass;
}
