/* points.c - the points of the chart, their fronts, and what to pick. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/speed-accuracy/chart.h"
#include "experiments/speed-accuracy/front.h"

const char *const PART_COLLISION = "collision", *const PART_SANDWICH = "sandwich",
                  *const PART_DISCHARGE = "hopper-discharge", *const PART_BUTTONS = "button-hopper";

const double TOLERANCE[TOLERANCES] = {0.1, 0.01, 0.001};

chart_point *chart_add(chart *c, const chart_point *p) {
    if (c->count == c->room) {
        c->room = 2 * c->room + 64;
        c->points = realloc(c->points, (size_t)c->room * sizeof *c->points);
        CLAST_ASSERT(c->points);
    }
    c->points[c->count] = *p;
    return &c->points[c->count++];
}

void chart_free(chart *c) {
    free(c->points);
    *c = (chart){0};
}

void chart_fold_hash(chart *c, uint64_t hash) {
    c->hash = (c->hash * 31) ^ hash;
}

bool chart_is_distinct(const chart_point *p) {
    return !p->statistical || p->low > 0;
}

bool chart_same_panel(const chart_point *a, const chart_point *b) {
    return !strcmp(a->part, b->part) && !strcmp(a->scene, b->scene) &&
           !strcmp(a->quantity, b->quantity);
}

const chart_point *chart_panel(const chart *c, const char *part, const char *scene,
                               const char *quantity) {
    const chart_point wanted = {.part = part, .scene = scene, .quantity = quantity};
    for (int i = 0; i < c->count; i++)
        if (chart_same_panel(&c->points[i], &wanted)) return &c->points[i];
    return NULL;
}

static double cost_along(const chart_point *p, chart_axis axis) {
    return axis == CHART_COST ? p->cost.median : p->evaluations;
}

/* ---- fronts ---------------------------------------------------------------------------------- */

static bool is_first_of_panel(const chart *c, int i) {
    return chart_panel(c, c->points[i].part, c->points[i].scene, c->points[i].quantity) ==
           &c->points[i];
}

/* Errors that agree in three digits are alike: the cheaper one, or the first, is on the front. */
static double three_digits(double error) {
    char text[40];
    snprintf(text, sizeof text, "%.2e", error);
    return strtod(text, NULL);
}

static void mark(chart *c, int first, chart_axis axis) {
    CLAST_ASSERT(c->count > 0);
    size_t n = (size_t)c->count;
    double *cost = calloc(2 * n, sizeof *cost), *error = cost + n;
    bool *on_front = calloc(n, sizeof *on_front);
    CLAST_ASSERT(cost && on_front);
    for (int i = 0; i < c->count; i++) {
        const chart_point *p = &c->points[i];
        bool counts = chart_same_panel(p, &c->points[first]) && !p->reference && !p->message[0];
        cost[i] = counts ? cost_along(p, axis) : (double)NAN;
        error[i] = three_digits(p->bound);
    }
    pareto_front(cost, error, c->count, on_front);
    for (int i = 0; i < c->count; i++) {
        if (!on_front[i]) continue;
        if (axis == CHART_COST)
            c->points[i].front_cost = true;
        else
            c->points[i].front_evaluations = true;
    }
    free(cost);
    free(on_front);
}

static double bound_of(const chart *c, const chart_point *p) {
    if (p->statistical) return isfinite(p->high) ? p->high : INFINITY;
    double bound = 0;
    for (int i = 0; i < c->count; i++) {
        const chart_point *q = &c->points[i];
        if (q->level < p->level || strcmp(q->family, p->family) != 0 || !chart_same_panel(p, q))
            continue;
        bound = isfinite(q->error) ? fmax(bound, q->error) : INFINITY;
        if (!isfinite(bound)) break;
    }
    return bound;
}

void chart_finish(chart *c) {
    for (int i = 0; i < c->count; i++) c->points[i].bound = bound_of(c, &c->points[i]);
    for (int i = 0; i < c->count; i++) {
        if (!is_first_of_panel(c, i)) continue;
        mark(c, i, CHART_COST);
        mark(c, i, CHART_EVALUATIONS);
    }
}

/* What the cheapest point of the front costs that has the finest step of the panel. Dearer ones are
 * there only because nothing finer was tried. */
static double end_of_range(const chart *c, const chart_point *panel) {
    double finest = 0, end = INFINITY;
    for (int i = 0; i < c->count; i++)
        if (chart_same_panel(&c->points[i], panel)) finest = fmax(finest, c->points[i].level);
    for (int i = 0; i < c->count; i++) {
        const chart_point *p = &c->points[i];
        if (chart_same_panel(p, panel) && p->front_evaluations && p->level == finest)
            end = fmin(end, p->evaluations);
    }
    return end;
}

double chart_front_order(const chart *c, const chart_point *panel, double from, double to) {
    CLAST_ASSERT(c && panel && c->count > 0);
    size_t n = (size_t)c->count;
    double *cost = calloc(2 * n, sizeof *cost), *error = cost + n;
    bool *use = calloc(n, sizeof *use);
    CLAST_ASSERT(cost && use);
    double end = end_of_range(c, panel);
    for (int i = 0; i < c->count; i++) {
        const chart_point *p = &c->points[i];
        cost[i] = p->evaluations, error[i] = p->bound;
        use[i] = chart_same_panel(p, panel) && p->front_evaluations && p->level >= from &&
                 p->level <= to && p->evaluations <= end;
    }
    double order = front_order(cost, error, use, c->count);
    free(cost);
    free(use);
    return order;
}

/* ---- what to pick ---------------------------------------------------------------------------- */

const chart_point *chart_pick(const chart *c, const chart_point *panel, double tolerance,
                              chart_axis axis, chart_filter *filter) {
    CLAST_ASSERT(c && panel && tolerance > 0);
    const chart_point *best = NULL;
    for (int i = 0; i < c->count; i++) {
        const chart_point *p = &c->points[i];
        if (!chart_same_panel(p, panel) || p->message[0] || (filter && !filter(p))) continue;
        if (!(p->bound <= tolerance) || !isfinite(cost_along(p, axis))) continue;
        if (!best || cost_along(p, axis) < cost_along(best, axis)) best = p;
    }
    return best;
}
