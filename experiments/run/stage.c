#include "experiments/run/stage.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"

enum { WALL_NUMBERS = 17 };

/* ---- the view: every number by name ---------------------------------------------------------- */

typedef struct field {
    const char *name;
    enum { FIELD_DOUBLE, FIELD_INT, FIELD_BOOL, FIELD_VECTOR } kind;
    size_t offset;
} field;

static const field FIELDS[] = {
    {"width", FIELD_INT, offsetof(view, width)},
    {"height", FIELD_INT, offsetof(view, height)},
    {"speed_max", FIELD_DOUBLE, offsetof(view, speed_max)},
    {"look_from", FIELD_VECTOR, offsetof(view, look_from)},
    {"up", FIELD_VECTOR, offsetof(view, up)},
    {"box_min", FIELD_VECTOR, offsetof(view, box_min)},
    {"box_max", FIELD_VECTOR, offsetof(view, box_max)},
    {"perspective", FIELD_BOOL, offsetof(view, perspective)},
    {"walls", FIELD_BOOL, offsetof(view, walls)},
    {"planes", FIELD_BOOL, offsetof(view, planes)},
    {"frames_per_second", FIELD_DOUBLE, offsetof(view, frames_per_second)},
};
enum { FIELD_COUNT = sizeof FIELDS / sizeof *FIELDS };

static int field_numbers(const field *d, const view *v, double out[3]) {
    const char *at = (const char *)v + d->offset;
    switch (d->kind) {
    case FIELD_DOUBLE:
        memcpy(out, at, sizeof(double));
        return 1;
    case FIELD_INT:
        out[0] = *(const int *)at;
        return 1;
    case FIELD_BOOL:
        out[0] = *(const bool *)at;
        return 1;
    case FIELD_VECTOR:
        memcpy(out, at, 3 * sizeof(double));
        return 3;
    }
    return 0;
}

static void field_store(const field *d, view *v, const double in[3]) {
    char *at = (char *)v + d->offset;
    switch (d->kind) {
    case FIELD_DOUBLE:
        memcpy(at, in, sizeof(double));
        break;
    case FIELD_INT:
        *(int *)at = (int)in[0];
        break;
    case FIELD_BOOL:
        *(bool *)at = in[0] != 0;
        break;
    case FIELD_VECTOR:
        memcpy(at, in, 3 * sizeof(double));
        break;
    }
}

static void path_of(char path[64], const char *name) {
    snprintf(path, 64, "/view/%s", name);
}

static void write_view(h5_file *f, const view *v) {
    char path[64];
    h5_group(f, "/view");
    h5_attribute_text(f, "/view", "preset", v->preset ? v->preset : "");
    h5_attribute_text(f, "/view", "map", v->map ? v->map : "");
    h5_attribute_u64(f, "/view", "colour", (uint64_t)v->colour);
    for (int i = 0; i < FIELD_COUNT; i++) {
        double numbers[3];
        path_of(path, FIELDS[i].name);
        h5_write_column(f, path, H5_F64, (size_t)field_numbers(&FIELDS[i], v, numbers), numbers);
    }
}

static void read_view(h5_file *f, stage *s) {
    char path[64];
    s->preset = h5_text_attribute(f, "/view", "preset");
    s->map = h5_text_attribute(f, "/view", "map");
    s->view.preset = s->preset;
    s->view.map = s->map;
    s->view.planes = true; /* what runs of earlier versions do not say */
    s->view.colour = (colour_by)h5_u64_attribute(f, "/view", "colour");
    for (int i = 0; i < FIELD_COUNT; i++) {
        double numbers[3] = {0};
        path_of(path, FIELDS[i].name);
        if (FIELDS[i].offset == offsetof(view, planes) && !h5_has(f, path)) continue;
        h5_read(f, path, H5_F64, FIELDS[i].kind == FIELD_VECTOR ? 3 : 1, numbers);
        field_store(&FIELDS[i], &s->view, numbers);
    }
}

/* ---- walls: a row of numbers each ------------------------------------------------------------ */

static void wall_row(const clast_world *w, int index, double row[WALL_NUMBERS]) {
    clast_wall_def d = clast_world_wall(w, index);
    clast_part_def p = clast_world_part(w, clast_world_wall_part(w, index));
    const double numbers[WALL_NUMBERS] = {
        d.point.x,    d.point.y,    d.point.z,   d.normal.x,     d.normal.y,     d.normal.z,
        d.side.x,     d.side.y,     d.side.z,    d.half_side[0], d.half_side[1], p.velocity.x,
        p.velocity.y, p.velocity.z, p.move_from, p.move_until,   p.removed_at};
    memcpy(row, numbers, sizeof numbers);
}

static void write_walls(h5_file *f, const clast_world *w) {
    size_t n = (size_t)clast_world_wall_count(w);
    double *rows = calloc(n * WALL_NUMBERS + 1, sizeof *rows);
    int32_t *kind = calloc(n + 1, sizeof *kind);
    int32_t *part = calloc(n + 1, sizeof *part);
    char *names = calloc(n + 1, STAGE_NAME_MAX);
    CLAST_ASSERT(rows && kind && part && names);
    for (size_t i = 0; i < n; i++) {
        clast_wall_def d = clast_world_wall(w, (int)i);
        kind[i] = (int32_t)d.kind;
        part[i] = clast_world_wall_part(w, (int)i);
        snprintf(names + i * STAGE_NAME_MAX, STAGE_NAME_MAX, "%s", d.name ? d.name : "");
        wall_row(w, (int)i, rows + i * WALL_NUMBERS);
    }
    h5_write_column(f, "/walls/kind", H5_I32, n, kind);
    h5_write_column(f, "/walls/part", H5_I32, n, part);
    h5_write(f, "/walls/numbers", H5_F64, 2, (size_t[]){n, WALL_NUMBERS}, rows);
    h5_write(f, "/walls/names", H5_U8, 2, (size_t[]){n, STAGE_NAME_MAX}, names);
    h5_attribute_text(f, "/walls", "columns",
                      "point xyz, normal xyz, side xyz, half sides (2), velocity of the part xyz, "
                      "move_from, move_until, removed_at");
    free(rows), free(kind), free(part), free(names);
}

static void store_row(stage_wall *w, const double *r) {
    w->point = (clast_vec3){r[0], r[1], r[2]};
    w->normal = (clast_vec3){r[3], r[4], r[5]};
    w->side = (clast_vec3){r[6], r[7], r[8]};
    w->half_side[0] = r[9];
    w->half_side[1] = r[10];
    w->part = (clast_part_def){.velocity = {r[11], r[12], r[13]},
                               .move_from = r[14],
                               .move_until = r[15],
                               .removed_at = r[16]};
}

static void read_walls(h5_file *f, stage *s) {
    size_t n = h5_count(f, "/walls/kind");
    double *rows = calloc(n * WALL_NUMBERS + 1, sizeof *rows);
    int32_t *kind = calloc(n + 1, sizeof *kind), *part = calloc(n + 1, sizeof *part);
    char *names = calloc(n + 1, STAGE_NAME_MAX);
    s->walls = calloc(n + 1, sizeof *s->walls);
    CLAST_ASSERT(rows && kind && part && names && s->walls);
    bool knows_parts = h5_has(f, "/walls/part");
    h5_read(f, "/walls/kind", H5_I32, n, kind);
    if (knows_parts) h5_read(f, "/walls/part", H5_I32, n, part);
    h5_read(f, "/walls/numbers", H5_F64, n * WALL_NUMBERS, rows);
    h5_read(f, "/walls/names", H5_U8, n * STAGE_NAME_MAX, names);
    for (size_t i = 0; i < n; i++) {
        s->walls[i].kind = (clast_wall_kind)kind[i];
        s->walls[i].part_index = knows_parts ? part[i] : -1;
        memcpy(s->walls[i].name, names + i * STAGE_NAME_MAX, STAGE_NAME_MAX - 1);
        store_row(&s->walls[i], rows + i * WALL_NUMBERS);
    }
    s->wall_count = h5_status(f) == CLAST_OK ? n : 0;
    free(rows), free(kind), free(part), free(names);
}

/* ---- the whole ------------------------------------------------------------------------------- */

void stage_write(h5_file *f, const scene *s) {
    CLAST_ASSERT(f && s && s->world);
    const clast_world_def *d = clast_world_definition(s->world);
    double domain[6] = {d->domain_min.x, d->domain_min.y, d->domain_min.z,
                        d->domain_max.x, d->domain_max.y, d->domain_max.z};
    h5_write_column(f, "/domain", H5_F64, 6, domain);
    write_walls(f, s->world);
    stage_meshes_write(f, s);
    write_view(f, &s->view);
}

stage *stage_read(h5_file *f) {
    CLAST_ASSERT(f);
    stage *s = calloc(1, sizeof *s);
    CLAST_ASSERT(s);
    double domain[6];
    s->title = h5_text_attribute(f, "/", "title");
    h5_read(f, "/domain", H5_F64, 6, domain);
    s->domain_min = (clast_vec3){domain[0], domain[1], domain[2]};
    s->domain_max = (clast_vec3){domain[3], domain[4], domain[5]};
    read_walls(f, s);
    s->meshes = stage_meshes_read(f, s->wall_count, &s->mesh_count);
    read_view(f, s);
    return s;
}

void stage_free(stage *s) {
    if (!s) return;
    stage_meshes_free(s->meshes, s->mesh_count);
    free(s->title), free(s->preset), free(s->map), free(s->walls);
    free(s);
}

bool stage_wall_offset(const stage_wall *w, double time, clast_vec3 *offset) {
    CLAST_ASSERT(w && offset);
    const clast_part_def *p = &w->part;
    double until = p->move_until > 0 && p->move_until < time ? p->move_until : time;
    double moving = until > p->move_from ? until - p->move_from : 0;
    *offset = (clast_vec3){moving * p->velocity.x, moving * p->velocity.y, moving * p->velocity.z};
    return !(p->removed_at > 0 && time >= p->removed_at);
}
