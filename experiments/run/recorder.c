#include "experiments/run/recorder.h"

#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/folder.h"

void recorder_start(recorder *r, const scene *s) {
    CLAST_ASSERT(r && s);
    *r = (recorder){.scene = s, .series = {.descriptor = -1}};
    r->memories = calloc((size_t)s->measure_count + 1, sizeof *r->memories);
    CLAST_ASSERT(r->memories);
    moment_take(&r->now, s->world, false);
    size_t n = r->now.bodies.count;
    uint32_t ids = n > 0 ? r->now.bodies.id[r->now.order[n - 1]] + 1 : 0;
    for (int i = 0; i < s->measure_count; i++) {
        measure_start(&r->memories[i], &r->now, ids);
        r->needs_contacts |= measure_class_of(s->measures[i].kind)->needs_contacts;
    }
}

static char *series_header(const scene *s) {
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    CLAST_ASSERT(to);
    fputs("time_s,step,kinetic_J,rotational_J,gravity_J,elastic_J,damping_J,friction_J,global_J,"
          "wall_work_J,removed_J,input_J,residual_J,bodies,overlap_max,contacts",
          to);
    for (int i = 0; i < s->measure_count; i++)
        measure_class_of(s->measures[i].kind)->header(&s->measures[i], to);
    CLAST_ASSERT(fclose(to) == 0);
    return text;
}

typedef struct keeping {
    bool (*keep)(uint64_t step, const void *context); /* NULL: a new file */
    const void *context;
} keeping;

static int open_table(table *t, const char *folder, const char *file, const char *header,
                      const keeping *k) {
    char *path = path_in(folder, file);
    if (k)
        table_continue(t, path, header, k->keep, k->context);
    else
        table_create(t, path, header);
    free(path);
    return t->failure;
}

static int open_tables(recorder *r, const char *folder, const keeping *k) {
    const scene *s = r->scene;
    char *header = series_header(s);
    int failure = open_table(&r->series, folder, FILE_SERIES, header, k);
    free(header);
    for (int i = 0; i < s->measure_count && !failure; i++) {
        const measure_class *c = measure_class_of(s->measures[i].kind);
        if (!c->writes_samples) continue;
        char *file = text_format("%s.samples.csv", s->measures[i].name);
        r->memories[i].sampling = true;
        failure = open_table(&r->memories[i].samples, folder, file, c->samples_header, k);
        free(file);
    }
    return failure;
}

int recorder_create(recorder *r, const char *folder) {
    return open_tables(r, folder, NULL);
}

int recorder_continue(recorder *r, const char *folder,
                      bool keep(uint64_t step, const void *context), const void *context) {
    return open_tables(r, folder, &(keeping){keep, context});
}

/* ---- rows ------------------------------------------------------------------------------------ */

static void write_energy(table *t, clast_world *w) {
    clast_energy e = clast_world_energy(w);
    const double terms[] = {e.kinetic, e.rotational, e.gravity, e.elastic, e.damping, e.friction,
                            e.global,  e.wall_work,  e.removed, e.input,   e.residual};
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++) table_number(t, terms[i]);
}

int recorder_row(recorder *r) {
    const scene *s = r->scene;
    double values[MEASURE_COLUMNS_MAX];
    moment_take(&r->now, s->world, r->needs_contacts);
    clast_counters c = clast_world_counters(s->world);
    table_begin(&r->series, r->now.time, r->now.step);
    write_energy(&r->series, s->world);
    table_number(&r->series, (double)c.bodies);
    table_number(&r->series, c.overlap_max);
    table_number(&r->series, (double)c.contacts);
    int failure = 0;
    for (int i = 0; i < s->measure_count; i++) {
        const measure_class *k = measure_class_of(s->measures[i].kind);
        int n = k->values(&s->measures[i], &r->memories[i], &r->now, values);
        CLAST_ASSERT(n <= MEASURE_COLUMNS_MAX);
        for (int j = 0; j < n; j++) table_number(&r->series, values[j]);
        if (r->memories[i].sampling && !failure) failure = r->memories[i].samples.failure;
    }
    table_end(&r->series);
    return failure ? failure : r->series.failure;
}

int recorder_sync(recorder *r) {
    table_sync(&r->series);
    int failure = r->series.failure;
    for (int i = 0; i < r->scene->measure_count; i++) {
        if (!r->memories[i].sampling) continue;
        table_sync(&r->memories[i].samples);
        if (!failure) failure = r->memories[i].samples.failure;
    }
    return failure;
}

void recorder_stop(recorder *r) {
    for (int i = 0; r->scene && i < r->scene->measure_count; i++) measure_stop(&r->memories[i]);
    free(r->memories);
    table_close(&r->series);
    moment_free(&r->now);
    *r = (recorder){.series = {.descriptor = -1}};
}

/* ---- memory: "below <measure> <one digit per body>" ------------------------------------------ */

void recorder_write_memory(const recorder *r, FILE *to) {
    for (int i = 0; i < r->scene->measure_count; i++) {
        const measure_memory *m = &r->memories[i];
        if (r->scene->measures[i].kind != MEASURE_DISCHARGED) continue;
        fprintf(to, "below %s ", r->scene->measures[i].name);
        for (uint32_t id = 0; id < m->ids; id++) fputc('0' + m->below[id], to);
        fputc('\n', to);
    }
}

static void read_below(measure_memory *m, const char *digits) {
    for (uint32_t id = 0; id < m->ids && digits[id] >= '0' && digits[id] <= '2'; id++)
        m->below[id] = (unsigned char)(digits[id] - '0');
}

void recorder_read_memory(recorder *r, const char *note) {
    for (int i = 0; i < r->scene->measure_count; i++) {
        if (r->scene->measures[i].kind != MEASURE_DISCHARGED) continue;
        char *head = text_format("\nbelow %s ", r->scene->measures[i].name);
        const char *line = strstr(note, head);
        if (line) read_below(&r->memories[i], line + strlen(head));
        free(head);
    }
}
