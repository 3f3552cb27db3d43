/* bed.c - A00 3.10: particles of aspect ratio 2 fall into a box and come to rest; what a step costs
 * on the way, per sphere and per particle. */
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "experiments/particle-checks/checks.h"
#include "experiments/study/side.h"

static const double R = 0.01;     /* m, A00 3.10 */
static const double STEP = 1e-5;  /* s, A00 3.10: the critical one */
static const double WIDTH = 0.21; /* m, of the box; assumed */

const bed_case BED_CASE[BED_CASES] = {{200, 2}, {200, 3},  {200, 5}, {400, 1},
                                      {600, 1}, {1000, 1}, {200, 9}, {200, 17}};

static capsule particle_of(int spheres) {
    double sphere = matter_density() * capsule_volume(R, 0);
    /* the same mass whatever the number of spheres: that of two which touch */
    return spheres == 1 ? capsule_of(1, R, 0, sphere) : capsule_of(spheres, R, 2 * R, 2 * sphere);
}

static void add_box(clast_world *w) {
    static const clast_vec3 SIDE[4] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    int part = clast_part_add(w, &(clast_part_def){.name = "box"});
    for (int i = 0; i < 4; i++) {
        clast_wall_def side = {.name = "side",
                               .material = 1,
                               .normal = SIDE[i],
                               .point = {-0.5 * WIDTH * SIDE[i].x, -0.5 * WIDTH * SIDE[i].y, 0}};
        clast_wall_add(w, part, &side);
    }
}

/* Uniform over all orientations. */
static clast_quat any_turn(uint64_t body) {
    double u = clast_random(1, body, 0);
    double a = 2 * CHECKS_PI * clast_random(1, body, 1);
    double b = 2 * CHECKS_PI * clast_random(1, body, 2);
    return (clast_quat){sqrt(1 - u) * sin(a), sqrt(1 - u) * cos(a), sqrt(u) * sin(b),
                        sqrt(u) * cos(b)};
}

/* m, of 4 % of a radius to either side: a grid of spheres would fall into columns that stand. */
static double aside(uint64_t body, uint64_t axis) {
    return 0.08 * R * (clast_random(2, body, axis) - 0.5);
}

/* On a grid that leaves room for any orientation, as A00 2.5.2. */
static void add_bodies(clast_world *w, const bed_case *c) {
    double pitch = c->spheres > 1 ? 4.2 * R : 2.1 * R;
    int row = (int)lround(WIDTH / pitch);
    for (int i = 0; i < c->particles; i++) {
        clast_vec3 at = {(i % row + 0.5) * pitch - 0.5 * WIDTH + aside((uint64_t)i, 0),
                         (i / row % row + 0.5) * pitch - 0.5 * WIDTH + aside((uint64_t)i, 1),
                         (i / (row * row) + 0.5) * pitch};
        body_put(
            w, &(clast_body_def){.shape = 0, .position = at, .orientation = any_turn((uint64_t)i)});
    }
}

static double mean_height(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    double sum = 0;
    for (size_t i = 0; i < b.count; i++) sum += b.z[i];
    return sum / (double)b.count;
}

/* Where every sphere that touches has its dashpot, 17 of them do not bear the critical step. */
static double step_of(const bed_case *c) {
    return c->spheres > 5 ? STEP * 4 / c->spheres : STEP;
}

bed bed_run(const bed_case *c, int steps) {
    capsule p = particle_of(c->spheres);
    setting s = {.law = CLAST_LAW_HERTZ_A00,
                 .young = matter_young(R, STEP),
                 .step = step_of(c),
                 .damping = 0.5, /* DAMP and FRIC of A00 Appendix D */
                 .slip_damping = 0.5,
                 .friction = 0.5};
    clast_world *w = matter_new(&s, &p);
    floor_add(w, &s);
    add_box(w);
    add_bodies(w, c);
    double before = (double)clock();
    for (int n = 0; n < steps; n++) world_step(w);
    bed found = {.seconds = ((double)clock() - before) / CLOCKS_PER_SEC / steps};
    clast_counters k = clast_world_counters(w);
    found.contacts = (double)clast_world_contacts(w, NULL, 0);
    found.candidates = (double)k.candidates;
    found.overlap = k.overlap_max;
    found.sunk = mean_height(w);
    found.hash = clast_world_hash(w);
    world_end(w);
    return found;
}

static void run_one(const void *context, int index, void *result) {
    *(bed *)result = bed_run(&BED_CASE[BED_CASES - 1 - index], *(const int *)context);
}

void bed_run_all(int steps, bed *beds) {
    bed turned[BED_CASES]; /* the longest first */
    side_by_side(&(side_task){.work = run_one, .context = &steps, .size = sizeof *turned},
                 BED_CASES, turned);
    for (int i = 0; i < BED_CASES; i++) {
        beds[i] = turned[BED_CASES - 1 - i];
        checks_hash_add(beds[i].hash);
    }
}
