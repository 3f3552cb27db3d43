#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/results.h"

static void *grown(void *old, size_t size) {
    void *p = realloc(old, size > 0 ? size : 1);
    CLAST_ASSERT(p);
    return p;
}

/* Takes the names out of "a,b,c"; the line is cut up. */
static void read_header(csv *t, char *line) {
    for (char *name = line, *next; name; name = next) {
        next = strchr(name, ',');
        if (next) *next++ = '\0';
        t->names = grown(t->names, (t->columns + 1) * sizeof *t->names);
        t->names[t->columns] = grown(NULL, strlen(name) + 1);
        strcpy(t->names[t->columns++], name);
    }
    t->values = calloc(t->columns, sizeof *t->values);
    CLAST_ASSERT(t->values);
}

/* False when the line does not hold a number for each column. */
static bool read_row(csv *t, const char *line, size_t room) {
    for (size_t k = 0; k < t->columns; k++) {
        char *end;
        if (t->rows == room) t->values[k] = grown(t->values[k], (2 * room + 64) * sizeof(double));
        t->values[k][t->rows] = strtod(line, &end);
        if (end == line || *end != (k + 1 < t->columns ? ',' : '\0')) return false;
        line = end + 1;
    }
    t->rows++;
    return true;
}

csv *csv_read(const char *path, char error[RESULTS_ERROR_MAX]) {
    CLAST_ASSERT(path && error);
    FILE *f = fopen(path, "r");
    if (!f) {
        snprintf(error, RESULTS_ERROR_MAX, "%s: cannot be opened: %s", path, strerror(errno));
        return NULL;
    }
    csv *t = calloc(1, sizeof *t);
    CLAST_ASSERT(t);
    char *line = NULL;
    size_t line_room = 0, room = 0;
    for (ssize_t length;
         (length = getline(&line, &line_room, f)) > 0 && line[length - 1] == '\n';) {
        line[length - 1] = '\0';
        bool first = t->columns == 0;
        if (first)
            read_header(t, line);
        else if (!read_row(t, line, room))
            break;
        if (t->rows > room) room = 2 * room + 64;
    }
    free(line);
    fclose(f);
    if (t->columns > 0) return t;
    snprintf(error, RESULTS_ERROR_MAX, "%s: holds no whole header line", path);
    csv_free(t);
    return NULL;
}

const double *csv_column(const csv *t, const char *name) {
    CLAST_ASSERT(t && name);
    static const double NOTHING[1];
    for (size_t k = 0; k < t->columns; k++)
        if (strcmp(t->names[k], name) == 0) return t->values[k] ? t->values[k] : NOTHING;
    return NULL;
}

void csv_free(csv *t) {
    if (!t) return;
    for (size_t k = 0; k < t->columns; k++) {
        free(t->names[k]);
        if (t->values) free(t->values[k]);
    }
    free(t->names);
    free(t->values);
    free(t);
}
