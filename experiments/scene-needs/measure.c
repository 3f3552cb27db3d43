/* measure.c - what is read from a run: its series of measures. */
#include <math.h>
#include <stdio.h>

#include "experiments/run/measure.h"
#include "experiments/scene-needs/study.h"
#include "experiments/tune/observable.h"

#define DEGREE  (180 / 3.14159265358979323846)
#define HIGHEST 0.85 /* of the highest section: the top of a heap is round */
#define LOWEST  0.15 /* likewise; its foot runs out over the floor */

double needs_flow_rate(const csv *series) {
    return observable_reduce(&(observable){.column = "out_kg", .how = REDUCE_RATE}, series);
}

double needs_solid_fraction(const csv *series) {
    return observable_reduce(&(observable){.column = "bed_fraction", .how = REDUCE_FINAL}, series);
}

/* ---- the heap -------------------------------------------------------------------------------- */

static int highest(const double *height, int sections) {
    int top = 0;
    for (int i = 1; i < sections; i++)
        if (height[i] > height[top]) top = i;
    return top;
}

/* Slope of the flank from section `top` on in direction +1 or -1; positive downwards. */
static double flank_slope(const double *height, int sections, double width, int top, int way) {
    double x[MEASURE_SECTIONS_MAX], z[MEASURE_SECTIONS_MAX];
    int n = 0;
    for (int i = top; i >= 0 && i < sections && height[i] >= LOWEST * height[top]; i += way) {
        if (height[i] > HIGHEST * height[top]) continue;
        x[n] = width * way * (i - top);
        z[n++] = height[i];
    }
    return n < 3 ? (double)NAN : -line_fit(x, z, n).slope;
}

double heap_angle(const double *height, int sections, double width) {
    int top = highest(height, sections);
    double left = flank_slope(height, sections, width, top, -1);
    double right = flank_slope(height, sections, width, top, 1);
    return 0.5 * (atan(left) + atan(right)) * DEGREE;
}

enum { HEAP_SECTIONS = 60 }; /* of heap.yaml */
static const double HEAP_SECTION_WIDTH = 0.02;

double needs_heap_slope(const csv *series) {
    double height[HEAP_SECTIONS];
    for (int i = 0; i < HEAP_SECTIONS; i++) {
        char name[40];
        snprintf(name, sizeof name, "bed_height_%d_m", i + 1);
        const double *column = csv_column(series, name);
        if (!column || series->rows == 0) return NAN;
        height[i] = column[series->rows - 1];
    }
    return heap_angle(height, HEAP_SECTIONS, HEAP_SECTION_WIDTH);
}
