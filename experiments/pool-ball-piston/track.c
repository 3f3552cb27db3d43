/* track.c - where the particles of a run went, as the experimenter's video shows it: middle and
 * orientation in the plane of the sheets. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <gsl/gsl_statistics_double.h>

#include "experiments/pool-ball-piston/piston.h"
#include "experiments/run/results.h"

double angle_of(const double q[4], double near) {
    static const double PI = 3.14159265358979323846;
    double up = 2 * (q[1] * q[3] - q[0] * q[2]), along = 1 - 2 * (q[2] * q[2] + q[3] * q[3]);
    double angle = atan2(up, along);
    return angle - PI * round((angle - near) / PI);
}

static void read_point(const frame *f, const double near[PARTICLES], double at[PARTICLES][ITEMS]) {
    for (int p = 0; p < PARTICLES; p++) {
        at[p][ITEM_X] = f->position[3 * p];
        at[p][ITEM_Z] = f->position[3 * p + 2];
        at[p][ITEM_ANGLE] = angle_of(&f->orientation[4 * p], near[p]);
    }
}

/* A particle that turns by less than a quarter in TRACK_S is followed through whole turns. */
static bool read_points(results *r, const double near[PARTICLES], track *out) {
    double last[PARTICLES];
    memcpy(last, near, sizeof last);
    for (int k = 0; k < TRACK_POINTS; k++) {
        double time = k * TRACK_S;
        frame *f = results_frame(r, results_frame_at(r, time));
        bool good = f && f->bodies == PARTICLES && fabs(f->time - time) < 0.1 * TRACK_S;
        if (good) read_point(f, last, out->at[k]);
        frame_free(f);
        if (!good) return false;
        for (int p = 0; p < PARTICLES; p++) last[p] = out->at[k][p][ITEM_ANGLE];
    }
    return true;
}

bool track_read(const char *folder, const double near[PARTICLES], track *out) {
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(folder, why);
    bool good = r && results_frames(r) > 0 && read_points(r, near, out);
    if (!good) fprintf(stderr, "%s: no track of %d particles\n", folder, PARTICLES);
    results_free(r);
    return good;
}

/* ---- tracks of a group ----------------------------------------------------------------------- */

void track_mean(const track *const *tracks, int n, track *out) {
    for (int k = 0; k < TRACK_POINTS; k++)
        for (int p = 0; p < PARTICLES; p++)
            for (int i = 0; i < ITEMS; i++) {
                double sum = 0;
                for (int t = 0; t < n; t++) sum += tracks[t]->at[k][p][i];
                out->at[k][p][i] = sum / n;
            }
}

double track_distance(const track *a, const track *b) {
    double sum = 0;
    for (int f = 1; f <= VIDEO_FRAMES; f++)
        for (int p = 0; p < PARTICLES; p++) {
            const double *u = a->at[f * TRACK_PER_FRAME][p], *v = b->at[f * TRACK_PER_FRAME][p];
            double dx = u[ITEM_X] - v[ITEM_X], dz = u[ITEM_Z] - v[ITEM_Z];
            sum += dx * dx + dz * dz;
        }
    return sqrt(sum / (VIDEO_FRAMES * PARTICLES));
}

double track_spread(const track *const *tracks, int n, int point) {
    double sum = 0;
    for (int p = 0; p < PARTICLES; p++)
        for (int i = ITEM_X; i <= ITEM_Z; i++) {
            double x[REPLICATES_MAX];
            for (int t = 0; t < n; t++) x[t] = tracks[t]->at[point][p][i];
            sum += gsl_stats_variance(x, 1, (size_t)n);
        }
    return sqrt(sum / PARTICLES);
}
