#include "tests/ranks/traffic.h"

#include <math.h>

/* Bodies of other boxes within reach of one of them stand in slabs at its inner faces, quarter
 * cylinders at its inner edges and eighths of a ball at its inner corners. A box that goes round
 * along a periodic axis has no face there; more of them have two each. */
typedef struct bed {
    double side[3]; /* m */
    double density; /* 1/m3 */
    bool round[3];
    double spread[3]; /* m in a step: by how much the fastest outrun the slowest, in even shear */
} bed;

/* m: twice as high as its centre, so that a grain that flies does not count for a layer. */
static double side_of(const double *x, size_t count, double radius) {
    double low = INFINITY, sum = 0;
    for (size_t i = 0; i < count; i++) low = fmin(low, x[i]), sum += x[i];
    return 2 * (sum / (double)count - low) + 2 * radius;
}

static double spread_of(const double *v, size_t count, double step) {
    double sum = 0, squares = 0, n = (double)count;
    for (size_t i = 0; i < count; i++) sum += v[i], squares += v[i] * v[i];
    return step * sqrt(12 * fmax(squares / n - sum / n * (sum / n), 0));
}

static bed bed_of(clast_world *w, double radius) {
    clast_bodies b = clast_world_bodies(w);
    const clast_world_def *d = clast_world_definition(w);
    const double *x[3] = {b.x, b.y, b.z}, *v[3] = {b.vx, b.vy, b.vz};
    const double length[3] = {d->domain_max.x - d->domain_min.x, d->domain_max.y - d->domain_min.y,
                              d->domain_max.z - d->domain_min.z};
    bed all = {.density = (double)b.count};
    for (int k = 0; k < 3; k++) {
        all.round[k] = d->periodic[k];
        all.side[k] = all.round[k] ? length[k] : side_of(x[k], b.count, radius);
        all.density /= all.side[k];
        all.spread[k] = spread_of(v[k], b.count, clast_world_time_step(w));
    }
    return all;
}

static int inner_faces(const bed *b, int axis, int cuts, int at) {
    if (b->round[axis]) return cuts > 1 ? 2 : 0;
    return (at > 0) + (at < cuts - 1);
}

/* Of the box at that place among `cuts`. */
static double ghosts_of_box(const bed *b, const int cuts[3], const int at[3], double reach) {
    double length[3], volume = 0;
    int inner[3];
    for (int k = 0; k < 3; k++) {
        length[k] = b->side[k] / cuts[k];
        inner[k] = inner_faces(b, k, cuts[k], at[k]);
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        volume += inner[k] * length[i] * length[j] * reach;
        volume += inner[i] * inner[j] * length[k] * 0.25 * 3.14159265358979 * reach * reach;
    }
    volume += inner[0] * inner[1] * inner[2] * 3.14159265358979 / 6 * reach * reach * reach;
    return b->density * volume;
}

/* Bodies stay with their process while they drift, so boxes grow into each other: ghosts that come
 * in a step, a face of a box taking half of the spread. */
static double growth_of_box(const bed *b, const int cuts[3], const int at[3]) {
    double growth = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        double face = b->side[i] / cuts[i] * b->side[j] / cuts[j];
        growth += 0.5 * inner_faces(b, k, cuts[k], at[k]) * face * b->spread[k];
    }
    return b->density * growth;
}

/* A division is made when ghosts beyond those of a new one have added up to fifty times the work of
 * a step: growing evenly, after 10 sqrt(work / growth) steps, and half of what is there then is the
 * mean (engine/ranks_divide.c). Where so many steps have not been made, half of what they brought.
 */
static double drifted(double work, double growth, double steps) {
    return fmin(5 * sqrt(work * growth), 0.5 * growth * steps);
}

static void cut(const bed *b, int processes, int cuts[3]) {
    for (int parts = 1; parts < processes; parts *= 2) {
        int longest = 0;
        for (int k = 1; k < 3; k++)
            if (b->side[k] / cuts[k] > b->side[longest] / cuts[longest]) longest = k;
        cuts[longest] *= 2;
    }
}

double traffic_ghosts(clast_world *w, double work, double steps) {
    double radius = clast_world_shape(w, 0).radius[0], ghosts = 0, growth = 0;
    double reach = 2 * radius + clast_world_plan(w).skin;
    bed b = bed_of(w, radius);
    int cuts[3] = {1, 1, 1};
    cut(&b, clast_ranks_count(), cuts);
    for (int i = 0; i < cuts[0]; i++)
        for (int j = 0; j < cuts[1]; j++)
            for (int k = 0; k < cuts[2]; k++) {
                const int at[3] = {i, j, k};
                ghosts += ghosts_of_box(&b, cuts, at, reach);
                growth += growth_of_box(&b, cuts, at);
            }
    return ghosts + drifted(work, growth, steps);
}
