#include "experiments/scene/clump.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "meshes/mesh.h"

enum { LINE_BYTES = 4096, FAULTS_MAX = 20 };

/* ---- profiles
 * ------------------------------------------------------------------------------------ */

typedef struct outline {
    scene_faults *faults;
    const char *path;
    double unit;
    int line, fault_count;
    bool radius_first, heading; /* heading: has been read */
    int count;
    double (*at)[2];
    int *line_of; /* of each point */
} outline;

#define FAULT(o, ...)                                                                              \
    do {                                                                                           \
        if ((o)->fault_count++ < FAULTS_MAX)                                                       \
            scene_report_in((o)->faults, (o)->path, (o)->line, "", __VA_ARGS__);                   \
    } while (0)

static bool is_blank(const char *line) {
    return line[strspn(line, " \t\r\n")] == '\0' || line[strspn(line, " \t")] == '#';
}

static void trim(char *text) {
    size_t skip = strspn(text, " \t"), length = strlen(text + skip);
    memmove(text, text + skip, length + 1);
    while (length > 0 && strchr(" \t\r\n", text[length - 1])) text[--length] = '\0';
}

/* Cuts a line at its only comma. */
static bool cut(outline *o, char *line, char **second) {
    char *comma = strchr(line, ',');
    if (!comma || strchr(comma + 1, ',')) {
        trim(line);
        FAULT(o, "found '%.60s', expected two values: x,radius", line);
        return false;
    }
    *comma = '\0';
    *second = comma + 1;
    trim(line), trim(*second);
    return true;
}

static void read_heading(outline *o, char *line) {
    char *second;
    o->heading = true;
    if (!cut(o, line, &second)) return;
    o->radius_first = !strcmp(line, "radius") && !strcmp(second, "x");
    if (!o->radius_first && (strcmp(line, "x") || strcmp(second, "radius")))
        FAULT(o, "found the heading '%.30s,%.30s', expected x,radius", line, second);
}

static bool read_number(outline *o, const char *text, const char *what, double *value) {
    char *end;
    *value = strtod(text, &end) * o->unit;
    if (end != text && !*end && isfinite(*value)) return true;
    FAULT(o, "found '%.60s' for %s, expected a number", text, what);
    return false;
}

static void read_point(outline *o, char *line) {
    char *second;
    double a, b;
    if (!cut(o, line, &second)) return;
    bool good = read_number(o, line, o->radius_first ? "radius" : "x", &a);
    if (!read_number(o, second, o->radius_first ? "x" : "radius", &b) || !good) return;
    if (o->count == SHAPE_PROFILE_MAX) {
        FAULT(o, "found more than %d points", SHAPE_PROFILE_MAX);
        return;
    }
    o->line_of[o->count] = o->line;
    o->at[o->count][0] = o->radius_first ? b : a;
    o->at[o->count++][1] = o->radius_first ? a : b;
}

static void read_lines(outline *o, FILE *file) {
    char line[LINE_BYTES];
    while (fgets(line, sizeof line, file)) {
        o->line++;
        if (strlen(line) == sizeof line - 1) {
            FAULT(o, "found a line of more than %d bytes", LINE_BYTES - 2);
            return;
        }
        if (is_blank(line)) continue;
        if (!o->heading)
            read_heading(o, line);
        else
            read_point(o, line);
    }
    if (ferror(file)) FAULT(o, "cannot be read to its end");
}

static shape_target *outline_target(outline *o) {
    if (o->fault_count > 0) return NULL;
    int which;
    const char *fault = shape_profile_fault(o->at, o->count, &which);
    if (!fault) return shape_target_of_profile(o->at, o->count);
    o->line = which < o->count ? o->line_of[which] : o->line;
    FAULT(o,
          "found %s, expected the outline from left to right, x rising, radius above 0 but at "
          "its ends",
          fault);
    return NULL;
}

shape_target *scene_profile_target(scene_faults *faults, const char *path, double unit) {
    SCENE_ASSERT(faults && path && unit > 0);
    outline o = {.faults = faults, .path = path, .unit = unit};
    FILE *file = fopen(path, "r");
    if (!file) {
        scene_report_in(faults, path, 0, "", "cannot be opened: %s", strerror(errno));
        return NULL;
    }
    o.at = calloc(SHAPE_PROFILE_MAX, sizeof *o.at);
    o.line_of = calloc(SHAPE_PROFILE_MAX, sizeof *o.line_of);
    SCENE_ASSERT(o.at && o.line_of);
    read_lines(&o, file);
    fclose(file);
    shape_target *target = outline_target(&o);
    free(o.at), free(o.line_of);
    return target;
}

/* ---- meshes
 * -------------------------------------------------------------------------------------- */

/* Holes are no fault: the winding number says what is inside; the volume lacks what they lack. */
static void warn_open(scene_faults *faults, const char *path, const mesh_report *report) {
    if (report->closed) return;
    size_t count = report->open_edges.count + report->branching_edges.count;
    size_t first =
        report->open_edges.count ? report->open_edges.first : report->branching_edges.first;
    scene_warn(faults, 0, path,
               "not closed (%zu edges, the first at triangle %zu): its volume lacks what it lacks",
               count, first);
}

shape_target *scene_mesh_target(scene_faults *faults, const char *path, double unit) {
    SCENE_ASSERT(faults && path && unit > 0);
    mesh_options options = mesh_options_default();
    options.unit = unit;
    mesh_surface surface;
    mesh_report report;
    if (mesh_load(path, &options, &surface, &report) != MESH_OK) {
        const char *text = mesh_error_text();
        size_t named = strlen(path); /* it begins with the path, as our line will */
        bool begins = !strncmp(text, path, named) && !strncmp(text + named, ": ", 2);
        scene_report_in(faults, path, 0, "", "%s", begins ? text + named + 2 : text);
        return NULL;
    }
    shape_mesh mesh = shape_mesh_copy(surface.vertex, surface.vertex_count, surface.triangle,
                                      surface.triangle_count);
    mesh_free(&surface);
    const char *fault;
    shape_target *target = shape_target_of_mesh(&mesh, &fault);
    if (!target)
        scene_report_in(faults, path, 0, "", "found %s, expected a closed body", fault);
    else
        warn_open(faults, path, &report);
    return target;
}
