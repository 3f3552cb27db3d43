#include "experiments/run/archive.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/check.h"
#include "experiments/run/folder.h"
#include "experiments/run/results.h"
#include "experiments/run/stage.h"

#if defined(__clang__)
#define COMPILER "clang " __clang_version__
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "unknown"
#endif

static void write_facts(h5_file *f, const archive_facts *facts) {
    const scene *s = facts->scene;
    char hash[24];
    snprintf(hash, sizeof hash, "0x%016llx", (unsigned long long)facts->hash);
    h5_attribute_text(f, "/", "format", "clast run");
    h5_attribute_u64(f, "/", "version", 1);
    h5_attribute_text(f, "/", "title", s->title ? s->title : "");
    h5_attribute_text(f, "/", "clast", CLAST_VERSION);
    h5_attribute_text(f, "/", "hdf5", h5_library_version());
    h5_attribute_text(f, "/", "compiler", COMPILER);
    h5_attribute_text(f, "/", "end", facts->end);
    h5_attribute_text(f, "/", "hash", hash);
    h5_attribute_u64(f, "/", "seed", clast_world_definition(s->world)->seed);
    h5_attribute_u64(f, "/", "steps", facts->steps);
    h5_attribute_double(f, "/", "time", facts->time);
    h5_write_text(f, "/scene", s->text ? s->text : "");
    stage_write(f, s);
}

static void copy_frames(h5_file *f, const char *folder, h5_file *old, const frame_list *frames) {
    h5_group(f, "/frames");
    for (size_t i = 0; i < frames->count; i++) {
        const frame_place *p = &frames->items[i];
        char *group = frame_group(p->number), *path = folder_part(folder, p->number);
        h5_file *part = p->is_part ? h5_open(path) : NULL;
        if (part)
            h5_copy(part, "/", f, group);
        else
            h5_copy(old, group, f, group);
        h5_free(part);
        free(group);
        free(path);
    }
}

static void write_table(h5_file *f, const char *folder, const char *file, const char *group) {
    char error[RESULTS_ERROR_MAX];
    char *path = path_in(folder, file);
    csv *t = csv_read(path, error);
    for (size_t k = 0; t && k < t->columns; k++) {
        char *name = text_format("%s/%s", group, t->names[k]);
        h5_write_column(f, name, H5_F64, t->rows, csv_column(t, t->names[k]));
        free(name);
    }
    csv_free(t);
    free(path);
}

/* Bodies that came or went, column by column; names in rows of equal length. */
static void write_transits(h5_file *f, const char *folder, const char *file, const char *group) {
    char error[RESULTS_ERROR_MAX];
    char *path = path_in(folder, file);
    transits *t = path_exists(path) ? transits_read(path, error) : NULL;
    const struct {
        const char *name;
        h5_type type;
        const void *column;
    } columns[] = {{"id", H5_U32, t ? t->id : NULL},
                   {"time_s", H5_F64, t ? t->time : NULL},
                   {"step", H5_U64, t ? t->step : NULL},
                   {"mass_kg", H5_F64, t ? t->mass : NULL},
                   {"diameter_m", H5_F64, t ? t->diameter : NULL}};
    for (size_t k = 0; t && k < sizeof columns / sizeof *columns; k++) {
        char *name = text_format("%s/%s", group, columns[k].name);
        h5_write_column(f, name, columns[k].type, t->count, columns[k].column);
        free(name);
    }
    for (int k = 0; t && k < 2; k++) {
        char *name = text_format("%s/%s", group, k ? "shape" : "gate");
        h5_write(f, name, H5_U8, 2, (size_t[]){t->count, TRANSIT_NAME_MAX}, k ? t->shape : t->gate);
        free(name);
    }
    transits_free(t);
    free(path);
}

static void write_tables(h5_file *f, const char *folder, const scene *s) {
    write_table(f, folder, FILE_SERIES, "/series");
    write_transits(f, folder, FILE_FEEDS, "/feeds");
    write_transits(f, folder, FILE_OUTLETS, "/outlets");
    for (int i = 0; i < s->measure_count; i++) {
        char *file = text_format("%s.samples.csv", s->measures[i].name);
        char *group = text_format("/samples/%s", s->measures[i].name);
        write_table(f, folder, file, group);
        free(file);
        free(group);
    }
}

static void drop_unwanted(frame_list *frames, const archive_facts *facts) {
    size_t kept = 0;
    for (size_t i = 0; i < frames->count; i++)
        if (!facts->keep_frame || facts->keep_frame(&frames->items[i], facts->context))
            frames->items[kept++] = frames->items[i];
    frames->count = kept;
}

static bool always(const char *part, void *context) {
    (void)part, (void)context;
    return true;
}

static void remove_parts(const char *folder) {
    char *frames = path_in(folder, FOLDER_FRAMES);
    folder_drop_parts(folder, always, NULL);
    rmdir(frames);
    free(frames);
}

static h5_file *open_old(const char *path) {
    h5_file *old = path_exists(path) ? h5_open(path) : NULL;
    if (!old || h5_status(old) == CLAST_OK) return old;
    h5_free(old); /* damaged: the parts are all there is */
    return NULL;
}

clast_status archive_assemble(const char *folder, const archive_facts *facts,
                              char error[H5_ERROR_MAX]) {
    CLAST_ASSERT(folder && facts && facts->scene && error);
    char *path = path_in(folder, FILE_RUN), *xdmf_path = path_in(folder, FILE_XDMF);
    h5_file *old = open_old(path);
    frame_list frames = frames_find(folder, old);
    drop_unwanted(&frames, facts);
    h5_file *f = h5_create(path);
    write_facts(f, facts);
    copy_frames(f, folder, old, &frames);
    write_tables(f, folder, facts->scene);
    char *xdmf = xdmf_text(f, &frames, facts->scene->title ? facts->scene->title : "");
    clast_status status = h5_publish(f);
    snprintf(error, H5_ERROR_MAX, "%s", h5_error(f));
    h5_free(f);
    h5_free(old);
    int failure = status == CLAST_OK ? file_write_text(xdmf_path, xdmf) : 0;
    if (failure) {
        snprintf(error, H5_ERROR_MAX, "%s: cannot be written: %s", xdmf_path, strerror(failure));
        status = CLAST_ERR_WRITE;
    }
    if (status == CLAST_OK) remove_parts(folder);
    free(frames.items);
    free(xdmf);
    free(path);
    free(xdmf_path);
    return status;
}
