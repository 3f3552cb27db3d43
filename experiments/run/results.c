#include "experiments/run/results.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/folder.h"
#include "experiments/run/frames.h"

struct results {
    char *folder;
    csv *series;
    h5_file *archive;
    frame_list frames;
    stage *stage;
    char error[RESULTS_ERROR_MAX];
};

/* ---- opening --------------------------------------------------------------------------------- */

static h5_file *open_archive(const char *folder, char error[RESULTS_ERROR_MAX]) {
    char *path = path_in(folder, FILE_RUN);
    h5_file *f = path_exists(path) ? h5_open(path) : NULL;
    free(path);
    if (f && h5_status(f) == CLAST_OK) return f;
    snprintf(error, RESULTS_ERROR_MAX, "%s", f ? h5_error(f) : "");
    if (!f) snprintf(error, RESULTS_ERROR_MAX, "%s: holds no run (no " FILE_RUN ")", folder);
    h5_free(f);
    return NULL;
}

results *results_open(const char *folder, char error[RESULTS_ERROR_MAX]) {
    CLAST_ASSERT(folder && error);
    error[0] = '\0';
    results *r = calloc(1, sizeof *r);
    CLAST_ASSERT(r);
    r->folder = text_format("%s", folder);
    r->archive = open_archive(folder, error);
    char *series = path_in(folder, FILE_SERIES);
    if (!error[0]) r->series = csv_read(series, error);
    if (!error[0]) r->stage = stage_read(r->archive);
    if (!error[0] && h5_status(r->archive) != CLAST_OK)
        snprintf(error, RESULTS_ERROR_MAX, "%s", h5_error(r->archive));
    free(series);
    if (r->series && !error[0]) {
        r->frames = frames_find(folder, r->archive);
        return r;
    }
    results_free(r);
    return NULL;
}

void results_free(results *r) {
    if (!r) return;
    csv_free(r->series);
    h5_free(r->archive);
    stage_free(r->stage);
    free(r->frames.items);
    free(r->folder);
    free(r);
}

const stage *results_stage(const results *r) {
    return r->stage;
}
size_t results_rows(const results *r) {
    return r->series->rows;
}
const char *results_error(const results *r) {
    return r->error;
}
size_t results_frames(const results *r) {
    return r->frames.count;
}

const double *results_series(const results *r, const char *column) {
    return csv_column(r->series, column);
}

/* ---- frames ---------------------------------------------------------------------------------- */

size_t results_frame_at(const results *r, double time) {
    CLAST_ASSERT(r && r->frames.count > 0);
    size_t best = 0;
    for (size_t i = 1; i < r->frames.count; i++)
        if (fabs(r->frames.items[i].time - time) < fabs(r->frames.items[best].time - time))
            best = i;
    return best;
}

/* Reads an array that must have `width` numbers for each of `count` rows. */
static void *read_rows(h5_file *f, const char *group, const char *name, h5_type type, size_t count,
                       size_t width) {
    char *path = text_format("%s%s", group, name);
    size_t there;
    void *data = h5_read_all(f, path, type, &there);
    if (h5_status(f) == CLAST_OK && there != count * width)
        h5_fail(f, CLAST_ERR_FORMAT, "'%s' holds %zu numbers, expected %zu", path, there,
                count * width);
    free(path);
    return data;
}

static size_t count_rows(h5_file *f, const char *group, const char *name) {
    char *path = text_format("%s%s", group, name);
    size_t count = h5_count(f, path);
    free(path);
    return count;
}

static bool has_contacts(h5_file *f, const char *group) {
    char *path = text_format("%s/contact", group);
    bool there = h5_has(f, path);
    free(path);
    return there;
}

static void read_bodies(frame *f, h5_file *h, const char *group) {
    size_t n = f->bodies = count_rows(h, group, "/body/id");
    f->id = read_rows(h, group, "/body/id", H5_U32, n, 1);
    f->shape = read_rows(h, group, "/body/shape", H5_I32, n, 1);
    f->position = read_rows(h, group, "/body/position", H5_F64, n, 3);
    f->orientation = read_rows(h, group, "/body/orientation", H5_F64, n, 4);
    f->velocity = read_rows(h, group, "/body/velocity", H5_F64, n, 3);
    f->spin = read_rows(h, group, "/body/spin", H5_F64, n, 3);
}

static void read_ranks(frame *f, h5_file *h, const char *group) {
    char *path = text_format("%s/body/rank", group);
    if (h5_has(h, path)) f->rank = read_rows(h, group, "/body/rank", H5_I32, f->bodies, 1);
    free(path);
}

static void read_spheres(frame *f, h5_file *h, const char *group) {
    size_t n = f->spheres = count_rows(h, group, "/sphere/radius");
    f->centre = read_rows(h, group, "/sphere/centre", H5_F64, n, 3);
    f->radius = read_rows(h, group, "/sphere/radius", H5_F64, n, 1);
    f->speed = read_rows(h, group, "/sphere/speed", H5_F64, n, 1);
    f->sphere_body = read_rows(h, group, "/sphere/body", H5_U32, n, 1);
}

static bool has_parts(h5_file *f, const char *group) {
    char *path = text_format("%s/part", group);
    bool there = h5_has(f, path);
    free(path);
    return there;
}

static void read_parts(frame *f, h5_file *h, const char *group) {
    size_t n = f->parts = count_rows(h, group, "/part/present");
    f->turn = read_rows(h, group, "/part/turn", H5_F64, n, 4);
    f->shift = read_rows(h, group, "/part/shift", H5_F64, n, 3);
    f->present = read_rows(h, group, "/part/present", H5_I32, n, 1);
}

static void read_contacts(frame *f, h5_file *h, const char *group) {
    size_t n = f->contacts = count_rows(h, group, "/contact/a");
    f->contact_a = read_rows(h, group, "/contact/a", H5_U32, n, 1);
    f->contact_b = read_rows(h, group, "/contact/b", H5_U32, n, 1);
    f->contact_point = read_rows(h, group, "/contact/point", H5_F64, n, 3);
    f->contact_force = read_rows(h, group, "/contact/force", H5_F64, n, 3);
    f->contact_normal = read_rows(h, group, "/contact/normal_force", H5_F64, n, 1);
    f->contact_overlap = read_rows(h, group, "/contact/overlap", H5_F64, n, 1);
}

frame *results_frame(results *r, size_t i) {
    CLAST_ASSERT(r && i < r->frames.count);
    const frame_place *p = &r->frames.items[i];
    char *path = folder_part(r->folder, p->number), *group = frame_group(p->number);
    h5_file *h = p->is_part ? h5_open(path) : r->archive;
    const char *inside = p->is_part ? "" : group;
    frame *f = calloc(1, sizeof *f);
    CLAST_ASSERT(f);
    f->time = p->time;
    f->step = p->step;
    read_bodies(f, h, inside);
    read_ranks(f, h, inside);
    read_spheres(f, h, inside);
    if (has_parts(h, inside)) read_parts(f, h, inside);
    if (has_contacts(h, inside)) read_contacts(f, h, inside);
    bool good = h5_status(h) == CLAST_OK;
    if (!good) snprintf(r->error, sizeof r->error, "frame %ld: %s", p->number, h5_error(h));
    if (p->is_part) h5_free(h);
    free(path);
    free(group);
    if (good) return f;
    frame_free(f);
    return NULL;
}

void frame_free(frame *f) {
    if (!f) return;
    free(f->id), free(f->shape), free(f->rank);
    free(f->position), free(f->orientation), free(f->velocity), free(f->spin);
    free(f->centre), free(f->radius), free(f->speed), free(f->sphere_body);
    free(f->turn), free(f->shift), free(f->present);
    free(f->contact_a), free(f->contact_b), free(f->contact_point), free(f->contact_force);
    free(f->contact_normal), free(f->contact_overlap);
    free(f);
}
