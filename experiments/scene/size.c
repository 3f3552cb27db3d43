/* size.c - bodies of many sizes. A shape with `size` becomes a family of templates, one for each
 * class of equally many bodies, scaled by the median of its class.
 *
 * The engine knows bodies by templates; a size of its own for every body would be a template for
 * every body, in every checkpoint. With N classes the share of bodies below any size is kept to
 * 1/(2N). Quantiles are found by halving, with nothing but + - * / and the engine's own logarithm,
 * so sizes have the same bits on every machine.
 */
#include "experiments/scene/build.h"

#include "engine/numbers.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAULT(node, key, ...) scene_fault_at(r->arena, r->faults, (node), (key), __VA_ARGS__)

enum { ROWS_MAX = 1000, LINE_BYTES = 400 };
static const double DEVIATIONS = 6; /* of a normal distribution: 1e-9 of it lies beyond */
static const double LEAST_SHARE = 1e-3;

typedef enum size_kind { SIZE_UNIFORM, SIZE_NORMAL, SIZE_LOG_NORMAL, SIZE_TABLE } size_kind;

/* Between two rows of a table: from..to hold `share` of all bodies or of all mass. */
typedef struct grade {
    double from, to, share;
} grade;

typedef struct distribution {
    size_kind kind;
    const size_rule *rule;
    double low, high;   /* no size is outside */
    double below, held; /* shares of the distribution before it is cut: below low, in between */
    grade *grades;
    int count;
    bool by_mass;
} distribution;

/* ---- how many are smaller -------------------------------------------------------------------- */

/* The integral of the bell curve up to z by its series; 1e-8 at 6 deviations, 1e-15 at 1. */
static double normal_below(double z) {
    if (z <= -DEVIATIONS) return 0;
    if (z >= DEVIATIONS) return 1;
    double term = z, sum = z;
    for (int n = 1; n < 200; n++) {
        term *= -z * z / (2 * n);
        sum += term / (2 * n + 1);
    }
    return 0.5 + sum / 2.50662827463100050242; /* sqrt(2 pi) */
}

/* Bodies from g->from to size, up to a factor. Mass is even between two rows, as grading curves are
 * read, and a body weighs the cube of its size. */
static double bodies_of(const distribution *d, const grade *g, double size) {
    double end = size < g->to ? size : g->to;
    if (end <= g->from) return 0;
    double part = g->share / (g->to - g->from);
    if (!d->by_mass) return part * (end - g->from);
    return part * 0.5 * (1 / (g->from * g->from) - 1 / (end * end));
}

static double uncut_below(const distribution *d, double size) {
    const size_rule *rule = d->rule;
    double sum = 0;
    switch (d->kind) {
    case SIZE_UNIFORM:
        return (size - rule->uniform[0]) / (rule->uniform[1] - rule->uniform[0]);
    case SIZE_NORMAL:
        return normal_below((size - rule->normal[0]) / rule->normal[1]);
    case SIZE_LOG_NORMAL:
        return normal_below(number_log(size / rule->log_normal[0]) /
                            number_log(rule->log_normal[1]));
    case SIZE_TABLE:
        for (int i = 0; i < d->count; i++) sum += bodies_of(d, &d->grades[i], size);
        return sum;
    }
    return sum;
}

static double quantile(const distribution *d, double share) {
    double low = d->low, high = d->high, wanted = d->below + share * d->held;
    for (;;) {
        double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) return middle;
        if (uncut_below(d, middle) < wanted)
            low = middle;
        else
            high = middle;
    }
}

/* ---- tables ---------------------------------------------------------------------------------- */

typedef struct table_reader {
    scene_reader *r;
    const char *path;
    int line, rows, faults;
    double size, share; /* of the row before */
} table_reader;

#define TABLE_FAULT(...)                                                                           \
    (t->faults++, scene_report_in(t->r->faults, t->path, t->line, "", __VA_ARGS__))

static bool is_blank(const char *line) {
    return line[strspn(line, " \t\r\n")] == '\0' || line[0] == '#';
}

static void read_heading(table_reader *t, distribution *d, const char *line) {
    char a[16] = "", b[16] = "", rest[2] = "";
    int found = sscanf(line, " %15[a-z] , %15[a-z] %1s", a, b, rest);
    d->by_mass = !strcmp(b, "mass");
    if (found != 2 || strcmp(a, "size") || (!d->by_mass && strcmp(b, "number")))
        TABLE_FAULT("found '%.*s', expected the heading size,number or size,mass",
                    (int)strcspn(line, "\r\n"), line);
}

static void read_row(table_reader *t, distribution *d, const char *line) {
    double size, share;
    char rest[2];
    if (sscanf(line, "%lf , %lf %1s", &size, &share, rest) != 2 || !isfinite(size) ||
        !isfinite(share)) {
        TABLE_FAULT("found '%.*s', expected a scale factor and a share, such as 1.25,0.6",
                    (int)strcspn(line, "\r\n"), line);
        return;
    }
    if (t->rows == 0 && (!(size > 0) || share != 0))
        TABLE_FAULT("found %g,%g, expected a first size above 0 with a share of 0", size, share);
    else if (t->rows > 0 && (size <= t->size || share < t->share || share > 1))
        TABLE_FAULT("found %g,%g behind %g,%g, expected sizes that rise and shares that do, up "
                    "to 1",
                    size, share, t->size, t->share);
    else if (t->rows > ROWS_MAX)
        TABLE_FAULT("found more than %d rows", ROWS_MAX);
    else if (t->rows > 0)
        d->grades[d->count++] = (grade){t->size, size, share - t->share};
    t->rows++;
    t->size = size, t->share = share;
}

static void read_lines(table_reader *t, distribution *d, FILE *file) {
    char line[LINE_BYTES];
    bool headed = false;
    while (t->faults == 0 && fgets(line, sizeof line, file)) {
        t->line++;
        if (is_blank(line)) continue;
        if (headed)
            read_row(t, d, line);
        else
            read_heading(t, d, line);
        headed = true;
    }
    if (t->faults == 0 && (t->rows < 2 || t->share != 1))
        TABLE_FAULT("found %d rows up to a share of %g, expected at least 2, up to 1", t->rows,
                    t->share);
}

static bool read_table(scene_reader *r, distribution *d, const tree_node *node) {
    table_reader t = {.r = r, .path = d->rule->table};
    FILE *file = fopen(t.path, "r");
    if (!file) {
        FAULT(node, "table", "found '%s', which cannot be read: %s", t.path, strerror(errno));
        return false;
    }
    d->grades = scene_alloc(r->arena, (ROWS_MAX + 1) * sizeof *d->grades);
    read_lines(&t, d, file);
    fclose(file);
    if (t.faults) return false;
    d->low = d->grades[0].from, d->high = t.size;
    return true;
}

/* ---- from the scene -------------------------------------------------------------------------- */

static double sixth_power(double x) {
    double cube = x * x * x;
    return cube * cube;
}

static void set_bounds(distribution *d) {
    const size_rule *rule = d->rule;
    if (d->kind == SIZE_UNIFORM) {
        d->low = rule->uniform[0], d->high = rule->uniform[1];
    } else if (rule->between[1] > 0) {
        d->low = rule->between[0], d->high = rule->between[1];
    } else { /* a log-normal distribution without ends */
        double wide = sixth_power(rule->log_normal[1]);
        d->low = rule->log_normal[0] / wide, d->high = rule->log_normal[0] * wide;
    }
}

static size_kind kind_of(const tree_node *node) {
    return tree_get(node, "uniform")  ? SIZE_UNIFORM
           : tree_get(node, "normal") ? SIZE_NORMAL
           : tree_get(node, "table")  ? SIZE_TABLE
                                      : SIZE_LOG_NORMAL;
}

/* False with a fault when there is no such distribution. */
static bool open_distribution(scene_reader *r, const shape_item *shape, const tree_node *node,
                              distribution *d) {
    *d = (distribution){.kind = kind_of(node), .rule = &shape->size};
    if (d->kind != SIZE_TABLE)
        set_bounds(d);
    else if (!read_table(r, d, node))
        return false;
    d->below = uncut_below(d, d->low);
    d->held = uncut_below(d, d->high) - d->below;
    if (d->kind == SIZE_TABLE || d->held >= LEAST_SHARE) return true;
    FAULT(node, "between", "found %g to %g, which holds %.2g of the distribution, expected %g",
          d->low, d->high, d->held, LEAST_SHARE);
    return false;
}

size_set scene_shape_sizes(scene_reader *r, const shape_item *shape) {
    SCENE_ASSERT(r && shape);
    const tree_node *node = tree_get(shape->item.node, "size");
    size_set out = {.count = node ? shape->size.classes : 1};
    out.scale = scene_alloc(r->arena, (size_t)out.count * sizeof *out.scale);
    distribution d;
    if (!node || !open_distribution(r, shape, node, &d)) {
        out.count = 1;
        out.scale[0] = 1;
        return out;
    }
    for (int i = 0; i < out.count; i++) out.scale[i] = quantile(&d, (i + 0.5) / out.count);
    return out;
}

static bool rises(scene_reader *r, const tree_node *node, const char *key, const double x[2]) {
    if (!tree_get(node, key) || x[0] < x[1]) return true;
    FAULT(node, key, "found %g to %g, expected the smaller first", x[0], x[1]);
    return false;
}

void scene_check_size(scene_reader *r, const shape_item *shape, const tree_node *size) {
    SCENE_ASSERT(r && shape && size);
    const size_rule *rule = &shape->size;
    bool cut = tree_get(size, "between"), normal = tree_get(size, "normal");
    bool log_normal = tree_get(size, "log_normal");
    bool good =
        rises(r, size, "uniform", rule->uniform) && rises(r, size, "between", rule->between);
    if (normal && !cut)
        FAULT(size, "between", "missing, expected the smallest and the largest size");
    else if (cut && !normal && !log_normal)
        FAULT(size, "between", "found beside a distribution with ends of its own");
    else if (log_normal && rule->log_normal[1] <= 1)
        FAULT(size, "log_normal",
              "found a geometric standard deviation of %g, expected more than 1",
              rule->log_normal[1]);
    else if (good)
        scene_shape_sizes(r, shape); /* for the faults of its table and its cuts */
}
