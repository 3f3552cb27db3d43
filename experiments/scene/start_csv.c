/* start_csv.c - bodies from a table: a heading line, then one body a line, SI throughout. */
#include "experiments/scene/build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FAULTS_MAX = 20, COLUMNS = 14, LINE_BYTES = 4096 };

static const char *const NAMES[COLUMNS] = {"shape", "x",  "y",  "z",  "qw", "qx", "qy",
                                           "qz",    "vx", "vy", "vz", "wx", "wy", "wz"};
enum {
    SHAPE,
    X,
    QW = 4,
    VX = 8,
    WX = 11,
    NEEDED = 4
}; /* places in NAMES; the first 4 are needed */

typedef struct table {
    scene_reader *r;
    const scene_draft *draft;
    const char *path;
    int line, line_of_heading, faults;
    int column[COLUMNS]; /* of the file: which of NAMES stands there */
    int columns;
    double value[COLUMNS];
    int shape;
} table;

#define FAULT(t, key, ...)                                                                         \
    do {                                                                                           \
        if ((t)->faults++ < FAULTS_MAX)                                                            \
            scene_report_in((t)->r->faults, (t)->path, (t)->line, (key), __VA_ARGS__);             \
    } while (0)

/* Cuts the next cell off the line, without spaces around it. */
static char *next_cell(char **line) {
    char *cell = *line;
    if (!cell) return NULL;
    char *comma = strchr(cell, ',');
    if (comma) *comma = '\0';
    *line = comma ? comma + 1 : NULL;
    cell += strspn(cell, " \t");
    size_t length = strlen(cell);
    while (length > 0 && strchr(" \t\r\n", cell[length - 1])) cell[--length] = '\0';
    return cell;
}

static int name_of(const char *cell) {
    for (int i = 0; i < COLUMNS; i++)
        if (!strcmp(cell, NAMES[i])) return i;
    return -1;
}

static void read_heading(table *t, char *line) {
    bool seen[COLUMNS] = {false};
    for (char *cell = next_cell(&line); cell; cell = next_cell(&line)) {
        int name = name_of(cell);
        if (name < 0 || seen[name] || t->columns == COLUMNS) {
            FAULT(t, cell,
                  "found %s, expected shape, x, y, z and perhaps qw, qx, qy, qz, vx, "
                  "vy, vz, wx, wy, wz",
                  name < 0 ? "an unknown column" : "a column twice");
            continue;
        }
        seen[name] = true;
        t->column[t->columns++] = name;
    }
    for (int i = 0; i < COLUMNS; i++) {
        bool needed =
            i < NEEDED || (i >= QW && i < VX && (seen[QW] || seen[5] || seen[6] || seen[7]));
        if (needed && !seen[i]) FAULT(t, NAMES[i], "missing, expected a column of this name");
    }
}

static void read_shape(table *t, const char *cell) {
    const tree_node *shapes = tree_get(t->r->root, "shapes"), *found = tree_get(shapes, cell);
    t->shape = found ? found->index : -1;
    if (!found)
        FAULT(t, "shape", "found '%s', expected a name from shapes", cell);
    else if (tree_get(found, "size"))
        FAULT(t, "shape", "found '%s', a shape of many sizes, expected one of a single size", cell);
}

static void read_cell(table *t, int name, const char *cell) {
    if (name == SHAPE) {
        read_shape(t, cell);
        return;
    }
    char *end;
    double value = strtod(cell, &end);
    if (end == cell || *end || !isfinite(value))
        FAULT(t, NAMES[name], "found '%s', expected a number in SI units", cell);
    t->value[name] = value;
}

static clast_quat orientation(table *t) {
    const double *q = &t->value[QW];
    double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (fabs(norm - 1) > 1e-6) {
        FAULT(t, "qw", "found a quaternion of length %g, expected 1", norm);
        return (clast_quat){1, 0, 0, 0};
    }
    return (clast_quat){q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
}

static void read_body(table *t, crowd *c, char *line, int source) {
    memset(t->value, 0, sizeof t->value);
    t->value[QW] = 1;
    int errors = t->faults, cells = 0;
    for (char *cell = next_cell(&line); cell; cell = next_cell(&line), cells++)
        if (cells < t->columns) read_cell(t, t->column[cells], cell);
    if (cells != t->columns) FAULT(t, "", "found %d values, expected %d", cells, t->columns);
    const double *v = t->value;
    clast_body_def body = {.shape = t->shape,
                           .position = {v[X], v[X + 1], v[X + 2]},
                           .orientation = orientation(t),
                           .velocity = {v[VX], v[VX + 1], v[VX + 2]},
                           .spin = {v[WX], v[WX + 1], v[WX + 2]}};
    if (t->faults == errors) crowd_add(c, &body, source);
}

static bool is_blank(const char *line) {
    return line[strspn(line, " \t\r\n")] == '\0' || line[0] == '#';
}

static void read_lines(table *t, crowd *c, FILE *file, int source) {
    char line[LINE_BYTES];
    int before = c->count;
    while (fgets(line, sizeof line, file)) {
        t->line++;
        if (strlen(line) == sizeof line - 1) {
            FAULT(t, "", "found a line of more than %d bytes", LINE_BYTES - 2);
            return;
        }
        if (is_blank(line)) continue;
        if (t->line_of_heading > 0) {
            read_body(t, c, line, source);
            continue;
        }
        t->line_of_heading = t->line;
        read_heading(t, line);
        if (t->faults) return; /* of the lines below nothing can be said */
    }
    if (c->count == before && t->faults == 0) FAULT(t, "", "found no bodies");
}

void scene_place_csv(scene_reader *r, crowd *c, const scene_draft *draft, const char *path,
                     const tree_node *node, int source) {
    SCENE_ASSERT(r && c && path && node);
    table t = {.r = r, .draft = draft, .path = path};
    FILE *file = fopen(path, "r");
    if (!file) {
        scene_fault_at(r->arena, r->faults, node, "csv", "found '%s', which cannot be read", path);
        return;
    }
    read_lines(&t, c, file, source);
    if (ferror(file)) FAULT(&t, "", "cannot be read to its end");
    if (t.faults > FAULTS_MAX)
        scene_report_in(r->faults, path, t.line, "", "%d faults in all", t.faults);
    fclose(file);
}
