#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/passage.h"
#include "experiments/run/results.h"

static void *grown(void *old, size_t count, size_t size) {
    void *p = realloc(old, count * size);
    CLAST_ASSERT(p);
    return p;
}

static void make_room(transits *t, size_t room) {
    t->id = grown(t->id, room, sizeof *t->id);
    t->step = grown(t->step, room, sizeof *t->step);
    t->time = grown(t->time, room, sizeof *t->time);
    t->mass = grown(t->mass, room, sizeof *t->mass);
    t->diameter = grown(t->diameter, room, sizeof *t->diameter);
    t->gate = grown(t->gate, room, sizeof *t->gate);
    t->shape = grown(t->shape, room, sizeof *t->shape);
}

static bool read_line(transits *t, const char *line) {
    size_t i = t->count;
    unsigned long long step;
    int end = -1;
    memset(t->gate[i], 0, TRANSIT_NAME_MAX), memset(t->shape[i], 0, TRANSIT_NAME_MAX);
    int read = sscanf(line, "%lf,%llu,%u,%63[^,],%63[^,],%lf,%lf%n", &t->time[i], &step, &t->id[i],
                      t->gate[i], t->shape[i], &t->mass[i], &t->diameter[i], &end);
    if (read != 7 || end < 0 || line[end] != '\n') return false;
    t->step[i] = step;
    t->count++;
    return true;
}

static bool is_heading(const char *line) {
    return !strcmp(line, FEEDS_HEADER "\n") || !strcmp(line, OUTLETS_HEADER "\n");
}

transits *transits_read(const char *path, char error[RESULTS_ERROR_MAX]) {
    CLAST_ASSERT(path && error);
    error[0] = '\0';
    FILE *f = fopen(path, "r");
    if (!f) {
        snprintf(error, RESULTS_ERROR_MAX, "%s: cannot be opened: %s", path, strerror(errno));
        return NULL;
    }
    transits *t = calloc(1, sizeof *t);
    CLAST_ASSERT(t);
    make_room(t, 1);
    char *line = NULL;
    size_t line_room = 0, room = 1, number = 0;
    for (ssize_t n; !error[0] && (n = getline(&line, &line_room, f)) > 0 && line[n - 1] == '\n';) {
        if (t->count == room) make_room(t, room = 2 * room + 64);
        if (++number == 1 ? !is_heading(line) : !read_line(t, line))
            snprintf(error, RESULTS_ERROR_MAX, "%s:%zu: found '%.*s', expected %s", path, number,
                     (int)strcspn(line, "\n"), line,
                     number == 1 ? FEEDS_HEADER " or " OUTLETS_HEADER : "such a row");
    }
    free(line);
    fclose(f);
    if (!error[0]) return t;
    transits_free(t);
    return NULL;
}

void transits_free(transits *t) {
    if (!t) return;
    free(t->id), free(t->step), free(t->time), free(t->mass), free(t->diameter);
    free(t->gate), free(t->shape);
    free(t);
}
