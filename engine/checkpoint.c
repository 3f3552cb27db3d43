/* checkpoint.c - saving a world and going on from there.
 *
 * At a step boundary a world is: positions at n, velocities at n - 1/2, contact histories with the
 * forces at n, ledger, clock. Everything else (pair list, cells, skin, positions of walls) is
 * derived or unobservable. The file also holds the scene as plain lines, so that a checkpoint of
 * another scene is refused with the first line that differs, and the hash of the state, so that
 * going on from a damaged file is refused too. (Inheriting bodies into another scene checks the
 * form of the file alone: the hash belongs to the scene that was saved.) */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/flow_saved.h"
#include "engine/ranks.h"

enum { FORMAT_VERSION = 6 };
#define FORMAT_NAME "clast checkpoint"

enum { LEDGER_NUMBERS = sizeof(ledger) / sizeof(double) };
_Static_assert(sizeof(ledger) % sizeof(double) == 0, "the ledger is saved as a row of doubles");

#define TYPE_OF(type) _Generic((type){0}, uint32_t : H5_U32, int32_t : H5_I32, double : H5_F64)

/* What a file holds, before it is checked against a world. */
typedef struct saved {
    uint64_t step, hash, removed;
    uint32_t next_id;
    double dt, contact_dt, overlap_max, overlap_now;
    body_store bodies; /* in the order of ids */
    double **scheme;   /* what a scheme remembers, as integrator_kept() counts; or NULL */
    double *now[6];    /* velocity and spin at the time of the positions; to inherit */
    contact_record *records;
    size_t record_count;
    ledger ledger;
    double *part_work; /* J, of each part */
    size_t part_count;
    saved_flow flow;
    char *scene, *wall_names;
} saved;

static const char *const IMAGE[] = {"/bodies/image_x", "/bodies/image_y", "/bodies/image_z"};
static const char *const NOW[] = {"/now/vx", "/now/vy", "/now/vz", "/now/wx", "/now/wy", "/now/wz"};

/* ---- the scene in lines ---------------------------------------------------------------------- */

/* A text that grows; *all is malloc'ed and whole once it is closed. */
static FILE *text_open(char **all) {
    static size_t length; /* open_memstream wants a place for it; strlen() serves us */
    FILE *t = open_memstream(all, &length);
    CLAST_ASSERT(t);
    return t;
}

static void text_close(FILE *t) {
    CLAST_ASSERT(fclose(t) == 0);
}

static void describe_world(FILE *t, const clast_world *w) {
    const clast_world_def *d = &w->def;
    fprintf(t, "bodies added %u\n", w->scene_ids);
    fprintf(t, "gravity %.17g %.17g %.17g\n", d->gravity.x, d->gravity.y, d->gravity.z);
    fprintf(t, "law %d, tangent %d, friction limit %d, unloading %d\n", (int)d->law,
            (int)d->tangent, (int)d->limit, (int)d->unloading);
    if (w->special.shared) fprintf(t, "shared dashpots\n");
    if (w->user_law.force) fprintf(t, "library %016llx\n", (unsigned long long)w->user_law.hash);
    if (d->law == CLAST_LAW_MAW) fprintf(t, "impact speed %.17g\n", w->plan.impact_speed);
    fprintf(t, "motion %d, plane axis %d\n", (int)d->motion, d->plane_axis);
    fprintf(t, "global damping %.17g, precision %d%s\n", d->global_damping, (int)d->precision,
            d->turn_spheres ? ", spheres turn" : "");
    fprintf(t, "time step %.17g\n", w->dt);
    const clast_scheme_info *scheme = clast_scheme_info_of(d->scheme);
    if (w->integrator) fprintf(t, "scheme %s\n", scheme->name);
    if (scheme->implicit)
        fprintf(t, "newton tolerance %.17g, iterations %d, solver %d\n", d->newton_tolerance,
                d->newton_iterations, (int)d->linear_solver);
    fprintf(t, "domain %.17g %.17g %.17g to %.17g %.17g %.17g, outside %d\n", d->domain_min.x,
            d->domain_min.y, d->domain_min.z, d->domain_max.x, d->domain_max.y, d->domain_max.z,
            (int)d->outside);
    for (int k = 0; k < 3; k++)
        if (d->periodic[k]) fprintf(t, "periodic along %c\n", "xyz"[k]);
    fprintf(t, "seed %llu\n", (unsigned long long)d->seed);
}

static void describe_materials(FILE *t, const clast_world *w) {
    for (int i = 0; i < w->material_count; i++)
        fprintf(t, "material %s density %.17g young %.17g poisson %.17g\n", w->materials[i].name,
                w->materials[i].density, w->materials[i].young, w->materials[i].poisson);
    for (int i = 0; i < w->material_count; i++)
        for (int j = i; j < w->material_count; j++) {
            const pair_coef *c = &w->coefs[i * w->material_count + j];
            if (!c->set) continue;
            fprintf(t, "pair %s %s restitution %.17g friction %.17g cohesion %.17g",
                    w->materials[i].name, w->materials[j].name, c->restitution, c->friction,
                    c->cohesion);
            fprintf(t, " stiffness %.17g tangential ratio %.17g restitution %.17g", c->stiffness,
                    c->ratio, c->tangential_restitution);
            fprintf(t, " rolling %.17g dissipation %.17g", c->rolling, c->dissipation);
            for (int k = 0; w->user_law.force && k < CLAST_LAW_PARAMETERS; k++)
                fprintf(t, " %.17g", c->parameter[k]);
            fprintf(t, "\n");
        }
}

static void describe_shape(FILE *t, const clast_world *w, int index) {
    const shape *s = &w->shapes[index];
    fprintf(t, "shape %s material %s mass %.17g inertia %.17g %.17g %.17g spheres", s->name,
            w->materials[s->material].name, s->mass, s->inertia.x, s->inertia.y, s->inertia.z);
    for (int k = 0; k < s->spheres; k++)
        fprintf(t, " (%.17g %.17g %.17g r %.17g)", s->centre[k].x, s->centre[k].y, s->centre[k].z,
                s->radius[k]);
    fprintf(t, "\n");
}

static void describe_patch(FILE *t, const patch *p) {
    for (int k = 0; k < 6 * p->triangles; k++)
        fprintf(t, "%s%.17g", k % 6 == 0 ? " corners " : " ", p->corner[k]);
    fprintf(t, "\n");
}

static void describe_vec(FILE *t, const char *what, vec3 a) {
    fprintf(t, " %s %.17g %.17g %.17g", what, a.x, a.y, a.z);
}

/* Motions that there are none of are left out: older files stay readable. */
static void describe_part(FILE *t, const part *p) {
    const clast_part_def *d = &p->def;
    fprintf(t, "part %s velocity %.17g %.17g %.17g from %.17g until %.17g removed %.17g", p->name,
            d->velocity.x, d->velocity.y, d->velocity.z, d->move_from, d->move_until,
            d->removed_at);
    if (v3_norm(d->stroke.travel) > 0) {
        describe_vec(t, "stroke", d->stroke.travel);
        fprintf(t, " at %.17g pause %.17g phase %.17g", d->stroke.speed, d->stroke.pause,
                d->stroke.phase);
    }
    if (v3_norm(d->oscillation.amplitude) > 0) {
        describe_vec(t, "oscillation", d->oscillation.amplitude);
        fprintf(t, " at %.17g phase %.17g", d->oscillation.frequency, d->oscillation.phase);
    }
    if (p->turns) {
        describe_vec(t, "turns about", d->rotation.point);
        describe_vec(t, "along", p->axis);
        fprintf(t, " at %.17g swing %.17g at %.17g phase %.17g", d->rotation.speed,
                d->rotation.swing, d->rotation.frequency, d->rotation.phase);
    }
    for (int i = 0; i < d->table.rows; i++) {
        describe_vec(t, "row", d->table.offset[i]);
        fprintf(t, " %.17g %.17g", d->table.angle ? d->table.angle[i] : 0, d->table.time[i]);
    }
    fprintf(t, "\n");
}

static void describe_walls(FILE *t, const clast_world *w) {
    for (int i = 0; i < w->part_count; i++) describe_part(t, &w->parts[i]);
    for (int i = 0; i < w->wall_count; i++) {
        const clast_wall_def *d = &w->walls[i].def;
        fprintf(t, "wall %s kind %d part %s material %s point %.17g %.17g %.17g", w->walls[i].name,
                (int)d->kind, w->parts[w->walls[i].part].name, w->materials[d->material].name,
                d->point.x, d->point.y, d->point.z);
        fprintf(t, " normal %.17g %.17g %.17g side %.17g %.17g %.17g half %.17g %.17g", d->normal.x,
                d->normal.y, d->normal.z, d->side.x, d->side.y, d->side.z, d->half_side[0],
                d->half_side[1]);
        fprintf(t, " belt %.17g %.17g %.17g", d->belt_velocity.x, d->belt_velocity.y,
                d->belt_velocity.z);
        if (w->walls[i].smooth >= 0)
            fprintf(t, " smooth %d %.17g", w->walls[i].smooth, w->walls[i].smooth_cosine);
        describe_patch(t, &w->walls[i].patch);
    }
}

/* What decides about motion and nothing else: neither guards nor threads nor output. */
static char *describe_scene(const clast_world *w) {
    char *all;
    FILE *t = text_open(&all);
    describe_world(t, w);
    describe_materials(t, w);
    for (int i = 0; i < w->shape_count; i++) describe_shape(t, w, i);
    describe_walls(t, w);
    flow_describe(t, w);
    text_close(t);
    return all;
}

static char *names_of_walls(const clast_world *w) {
    char *all;
    FILE *t = text_open(&all);
    for (int i = 0; i < w->wall_count; i++) fprintf(t, "%s\n", w->walls[i].name);
    text_close(t);
    return all;
}

/* ---- saving ---------------------------------------------------------------------------------- */

/* A column of the own bodies; `order` and `count` are those of all. */
static void save_column(h5_file *f, const clast_world *w, const char *name, h5_type type,
                        size_t size, const void *column, const uint32_t *order, size_t count) {
    size_t all = w->bodies.count;
    char *gathered = w->ranks ? ranks_gather(w, column, all, size, &all) : NULL;
    const char *from = gathered ? gathered : column;
    char *sorted = malloc(count * size + 1);
    CLAST_ASSERT(sorted && all == count);
    for (size_t i = 0; i < count; i++) memcpy(sorted + i * size, from + order[i] * size, size);
    h5_write_column(f, name, type, count, sorted);
    free(sorted), free(gathered);
}

/* Name of the k-th column that a scheme remembers. */
typedef struct column_name {
    char name[32];
} column_name;

static column_name scheme_column(int k) {
    column_name c;
    snprintf(c.name, sizeof c.name, "/scheme/%d", k);
    return c;
}

static int scheme_columns(const clast_world *w) {
    int count = 0;
    while (integrator_kept(w, count)) count++;
    return count;
}

static void save_bodies(h5_file *f, clast_world *w) {
    const body_store *b = &w->bodies;
    clast_bodies all = clast_world_bodies(w);
    uint32_t *order = bodies_by_id(w, &all);
    size_t count = all.count;
#define X(type, name)                                                                              \
    save_column(f, w, "/bodies/" #name, TYPE_OF(type), sizeof(type), b->name, order, count);
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++)
        if (b->image[k]) save_column(f, w, IMAGE[k], H5_I32, 4, b->image[k], order, count);
    const double *now[] = {w->view.vx, w->view.vy, w->view.vz, w->view.wx, w->view.wy, w->view.wz};
    for (int i = 0; i < 6; i++) save_column(f, w, NOW[i], H5_F64, 8, now[i], order, count);
    const double *kept;
    for (int k = 0; (kept = integrator_kept(w, k)) != NULL; k++)
        save_column(f, w, scheme_column(k).name, H5_F64, 8, kept, order, count);
    free(order);
}

/* One column of the records by its place in the struct. */
static void save_field(h5_file *f, const char *name, h5_type type, size_t width, size_t offset,
                       const record_list *r) {
    size_t size = (type == H5_F64 ? 8 : 4) * width;
    char *column = malloc(r->count * size + 1);
    CLAST_ASSERT(column);
    for (size_t i = 0; i < r->count; i++)
        memcpy(column + i * size, (const char *)&r->items[i] + offset, size);
    h5_write(f, name, type, width == 1 ? 1 : 2, (size_t[]){r->count, width}, column);
    free(column);
}

#define RECORD_FIELDS(X)                                                                           \
    X(a, H5_U32, 1)                                                                                \
    X(b, H5_U32, 1)                                                                                \
    X(sphere_a, H5_I32, 1)                                                                         \
    X(sphere_b, H5_I32, 1)                                                                         \
    X(history.overlap, H5_F64, 1)                                                                  \
    X(history.normal, H5_F64, 1)                                                                   \
    X(history.spring, H5_F64, 3)
#define PLASTIC "/contacts/history.plastic" /* where a law yields or is the user's own */

static void save_contacts(h5_file *f, clast_world *w) {
    records_collect(w);
    records_sort(w);
#define X(field, type, width)                                                                      \
    save_field(f, "/contacts/" #field, type, width, offsetof(contact_record, field), &w->records);
    RECORD_FIELDS(X)
#undef X
    if (w->history_columns > HISTORY_PLASTIC)
        save_field(f, PLASTIC, H5_F64, 1, offsetof(contact_record, history.plastic), &w->records);
}

static void save_parts(h5_file *f, const clast_world *w) {
    double *work = malloc(((size_t)w->part_count + 1) * sizeof *work);
    CLAST_ASSERT(work);
    for (int i = 0; i < w->part_count; i++) work[i] = w->parts[i].work_total;
    h5_write_column(f, "/parts/work", H5_F64, (size_t)w->part_count, work);
    free(work);
}

static void save_clock(h5_file *f, clast_world *w) {
    h5_attribute_text(f, "/", "format", FORMAT_NAME);
    h5_attribute_u64(f, "/", "version", FORMAT_VERSION);
    h5_attribute_text(f, "/", "clast", CLAST_VERSION);
    h5_attribute_u64(f, "/", "step", w->step);
    h5_attribute_double(f, "/", "time", clast_world_time(w));
    h5_attribute_double(f, "/", "time_step", w->dt);
    h5_attribute_double(f, "/", "contact_time_step", w->contact_dt);
    h5_attribute_u64(f, "/", "next_id", w->next_id);
    h5_attribute_u64(f, "/", "removed", w->counters.removed);
    h5_attribute_double(f, "/", "overlap_max", w->counters.overlap_max);
    h5_attribute_double(f, "/", "overlap_now", w->overlap_now);
    h5_attribute_u64(f, "/", "hash", clast_world_hash(w));
}

static void save_scene(h5_file *f, const clast_world *w, const char *note) {
    char *scene = describe_scene(w), *walls = names_of_walls(w);
    h5_write_text(f, "/scene", scene);
    h5_write_text(f, "/walls", walls);
    h5_write_text(f, "/note", note ? note : "");
    free(scene);
    free(walls);
}

clast_status clast_checkpoint_save(clast_world *w, const char *path, const char *note) {
    CLAST_ASSERT(w && path && w->prepared);
    double numbers[LEDGER_NUMBERS];
    memcpy(numbers, &w->ledger, sizeof numbers);
    h5_file *f = ranks_speaks(w) ? h5_create(path) : h5_create_mute(path);
    save_clock(f, w);
    save_scene(f, w, note);
    save_bodies(f, w);
    save_contacts(f, w);
    save_parts(f, w);
    flow_save(f, w);
    h5_write_column(f, "/ledger", H5_F64, LEDGER_NUMBERS, numbers);
    clast_status status = h5_publish(f);
    if (status != CLAST_OK) world_fail(w, status, "checkpoint %s", h5_error(f));
    h5_free(f);
    return ranks_agree_status(w, status);
}

/* ---- reading --------------------------------------------------------------------------------- */

static void check_format(h5_file *f, const char *path) {
    char *format = h5_text_attribute(f, "/", "format");
    if (h5_status(f) == CLAST_OK && strcmp(format, FORMAT_NAME) != 0)
        h5_fail(f, CLAST_ERR_FORMAT, "%s: holds a '%s', expected a '%s'", path, format,
                FORMAT_NAME);
    free(format);
    uint64_t version = h5_u64_attribute(f, "/", "version");
    if (h5_status(f) == CLAST_OK && version != FORMAT_VERSION)
        h5_fail(f, CLAST_ERR_VERSION, "%s: format version %llu, this program reads version %d",
                path, (unsigned long long)version, FORMAT_VERSION);
}

static void read_bodies(h5_file *f, saved *s, bool to_inherit) {
    size_t n = s->bodies.count = h5_count(f, "/bodies/id");
#define X(type, name)                                                                              \
    s->bodies.name = calloc(n + 1, sizeof(type));                                                  \
    CLAST_ASSERT(s->bodies.name);                                                                  \
    h5_read(f, "/bodies/" #name, TYPE_OF(type), n, s->bodies.name);
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++) {
        if (!h5_has(f, IMAGE[k])) continue;
        s->bodies.image[k] = calloc(n + 1, sizeof *s->bodies.image[k]);
        CLAST_ASSERT(s->bodies.image[k]);
        h5_read(f, IMAGE[k], H5_I32, n, s->bodies.image[k]);
    }
    for (int i = 0; i < 6 && to_inherit; i++) {
        s->now[i] = calloc(n + 1, sizeof(double));
        CLAST_ASSERT(s->now[i]);
        h5_read(f, NOW[i], H5_F64, n, s->now[i]);
    }
}

static void read_field(h5_file *f, saved *s, const char *name, h5_type type, size_t width,
                       size_t offset) {
    size_t size = (type == H5_F64 ? 8 : 4) * width;
    char *column = malloc(s->record_count * size + 1);
    CLAST_ASSERT(column);
    h5_read(f, name, type, s->record_count * width, column);
    for (size_t i = 0; i < s->record_count; i++)
        memcpy((char *)&s->records[i] + offset, column + i * size, size);
    free(column);
}

static void read_contacts(h5_file *f, saved *s) {
    s->record_count = h5_count(f, "/contacts/a");
    s->records = calloc(s->record_count + 1, sizeof *s->records);
    CLAST_ASSERT(s->records);
#define X(field, type, width)                                                                      \
    read_field(f, s, "/contacts/" #field, type, width, offsetof(contact_record, field));
    RECORD_FIELDS(X)
#undef X
    if (h5_has(f, PLASTIC))
        read_field(f, s, PLASTIC, H5_F64, 1, offsetof(contact_record, history.plastic));
}

/* A file of another scheme is refused for its scene. */
static void read_scheme(h5_file *f, const clast_world *w, saved *s) {
    int count = scheme_columns(w);
    s->scheme = calloc((size_t)count + 1, sizeof *s->scheme);
    CLAST_ASSERT(s->scheme);
    for (int k = 0; k < count; k++) {
        s->scheme[k] = calloc(s->bodies.count + 1, sizeof(double));
        CLAST_ASSERT(s->scheme[k]);
        column_name c = scheme_column(k);
        if (h5_has(f, c.name)) h5_read(f, c.name, H5_F64, s->bodies.count, s->scheme[k]);
    }
}

static void read_saved(h5_file *f, const char *path, saved *s, bool to_inherit) {
    check_format(f, path);
    s->step = h5_u64_attribute(f, "/", "step");
    s->hash = h5_u64_attribute(f, "/", "hash");
    s->removed = h5_u64_attribute(f, "/", "removed");
    s->next_id = (uint32_t)h5_u64_attribute(f, "/", "next_id");
    s->dt = h5_double_attribute(f, "/", "time_step");
    s->contact_dt = h5_double_attribute(f, "/", "contact_time_step");
    s->overlap_max = h5_double_attribute(f, "/", "overlap_max");
    s->overlap_now = h5_double_attribute(f, "/", "overlap_now");
    s->scene = h5_read_text(f, "/scene");
    s->wall_names = h5_read_text(f, "/walls");
    read_bodies(f, s, to_inherit);
    read_contacts(f, s);
    size_t numbers;
    s->part_work = h5_read_all(f, "/parts/work", H5_F64, &numbers);
    s->part_count = numbers;
    flow_read(f, &s->flow);
    double values[LEDGER_NUMBERS];
    h5_read(f, "/ledger", H5_F64, LEDGER_NUMBERS, values);
    memcpy(&s->ledger, values, sizeof values);
}

static void saved_free(saved *s) {
    for (int k = 0; s->scheme && s->scheme[k]; k++) free(s->scheme[k]);
    free(s->scheme);
#define X(type, name) free(s->bodies.name);
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++) free(s->bodies.image[k]);
    for (int i = 0; i < 6; i++) free(s->now[i]);
    free(s->records);
    free(s->part_work);
    flow_read_free(&s->flow);
    free(s->scene);
    free(s->wall_names);
}

/* ---- checking -------------------------------------------------------------------------------- */

static size_t line_length(const char *line) {
    return strcspn(line, "\n");
}

/* Compares scene texts line by line; on a difference names both lines. */
static clast_status compare_scenes(clast_world *w, const char *path, const char *theirs) {
    char *ours = describe_scene(w);
    const char *a = theirs, *b = ours;
    while (*a && *b && line_length(a) == line_length(b) && strncmp(a, b, line_length(a)) == 0) {
        a += line_length(a) + (a[line_length(a)] == '\n');
        b += line_length(b) + (b[line_length(b)] == '\n');
    }
    clast_status status = *a || *b ? CLAST_ERR_MISMATCH : CLAST_OK;
    if (status != CLAST_OK)
        world_fail(w, status,
                   "checkpoint %s belongs to another scene:\n  it has     %.*s\n  this scene %.*s",
                   path, *a ? (int)line_length(a) : 7, *a ? a : "nothing",
                   *b ? (int)line_length(b) : 7, *b ? b : "nothing");
    free(ours);
    return status;
}

/* Place of an id in the sorted column, or -1. */
static ptrdiff_t place_of_id(const saved *s, uint32_t id) {
    size_t from = 0, to = s->bodies.count;
    while (from < to) {
        size_t middle = from + (to - from) / 2;
        if (s->bodies.id[middle] < id)
            from = middle + 1;
        else
            to = middle;
    }
    return from < s->bodies.count && s->bodies.id[from] == id ? (ptrdiff_t)from : -1;
}

/* shape_of: from a shape of the file to one of the world, -1 for none; NULL when they are the
 * same. */
static bool is_sphere_of(const clast_world *w, const saved *s, const int *shape_of, uint32_t id,
                         int32_t sphere) {
    int of_file = s->bodies.shape[place_of_id(s, id)];
    int of_world = shape_of ? shape_of[of_file] : of_file;
    return of_world < 0 || (sphere >= 0 && sphere < w->shapes[of_world].spheres);
}

/* Numbers that are used as indices must be in range before anything is touched; the values
 * themselves are proved by the hash. */
static const char *fault_of_indices(const clast_world *w, const saved *s, const int *shape_of,
                                    int shape_count, uint32_t wall_count) {
    for (size_t i = 0; i < s->bodies.count; i++) {
        if (s->bodies.id[i] >= s->next_id) return "a body's id is out of range";
        if (i > 0 && s->bodies.id[i] <= s->bodies.id[i - 1]) return "ids are not in order";
        if (s->bodies.shape[i] < 0 || s->bodies.shape[i] >= shape_count)
            return "a body has a shape that does not exist";
    }
    for (size_t i = 0; i < s->record_count; i++) {
        const contact_record *r = &s->records[i];
        if (place_of_id(s, r->a) < 0) return "a contact names a body that is not there";
        bool with_wall = r->b >= CLAST_WALL_ID;
        if (with_wall ? r->b - CLAST_WALL_ID >= wall_count : place_of_id(s, r->b) < 0)
            return "a contact names a partner that is not there";
        if (!is_sphere_of(w, s, shape_of, r->a, r->sphere_a))
            return "a contact names a sphere that is not there";
        if (with_wall ? r->sphere_b != 0 : !is_sphere_of(w, s, shape_of, r->b, r->sphere_b))
            return "a contact names a sphere that is not there";
    }
    return NULL;
}

/* ---- loading --------------------------------------------------------------------------------- */

/* A file without them is damaged, as its hash will show. */
static void install_image(clast_world *w, saved *s, int axis) {
    int32_t **to = &w->bodies.image[axis], **from = &s->bodies.image[axis];
    size_t room = s->bodies.count + 1;
    memory_return(w, w->bodies.capacity * sizeof **to), memory_release(*to);
    if (*from) memory_adopt(w, room * sizeof **to);
    *to = *from ? *from : memory_grow(w, NULL, 0, room, sizeof **to);
    *from = NULL;
}

/* The world takes the columns over: both at once would be the most memory that it ever needs. */
static void install_bodies(clast_world *w, saved *s) {
    body_store *b = &w->bodies;
    size_t n = s->bodies.count;
#define X(type, name)                                                                              \
    memory_return(w, b->capacity * sizeof(type)), memory_release(b->name);                         \
    memory_adopt(w, (n + 1) * sizeof(type));                                                       \
    b->name = s->bodies.name, s->bodies.name = NULL;
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++)
        if (w->def.periodic[k]) install_image(w, s, k);
    b->count = n, b->capacity = n + 1;
    ids_reserve(w, s->next_id);
    w->next_id = s->next_id;
    for (uint32_t id = 0; id < w->next_id; id++) w->slot_of_id[id] = -1;
    for (size_t i = 0; i < n; i++) w->slot_of_id[b->id[i]] = (int32_t)i;
}

static void install_scheme(clast_world *w, const saved *s) {
    double *kept;
    for (int k = 0; (kept = integrator_kept(w, k)) != NULL; k++)
        memcpy(kept, s->scheme[k], s->bodies.count * sizeof *kept);
}

/* The world takes them over. */
static void install_records(clast_world *w, saved *s) {
    records_forget(w);
    w->records = (record_list){s->record_count, s->record_count + 1, s->records};
    memory_adopt(w, w->records.capacity * sizeof *s->records);
    s->records = NULL;
}

static void install(clast_world *w, saved *s) {
    w->step = s->step;
    w->contact_dt = s->contact_dt;
    w->ledger = s->ledger;
    w->counters.removed = s->removed;
    w->counters.overlap_max = s->overlap_max;
    w->counters.contacts = s->record_count;
    w->overlap_now = s->overlap_now;
    for (int i = 0; i < w->part_count; i++) w->parts[i].work_total = s->part_work[i];
    w->found = (body_tally){.way = 0};
    ranks_forget_ghosts(w);
    install_scheme(w, s);
    install_bodies(w, s);
    flow_install(w, &s->flow);
    install_records(w, s);
    ranks_scatter(w); /* every process has read all */
    walls_move(w);
    carry_records(w);
    lists_rebuild(w);
    contacts_restore(w);
    w->failed = false;
}

static clast_status check_and_install(clast_world *w, const char *path, saved *s) {
    clast_status status = compare_scenes(w, path, s->scene);
    if (status != CLAST_OK) return status;
    const char *fault = fault_of_indices(w, s, NULL, w->shape_count, (uint32_t)w->wall_count);
    if (!fault && s->part_count != (size_t)w->part_count) fault = "parts are missing";
    if (!fault) fault = flow_fault(w, &s->flow, s->next_id);
    if (fault) return world_fail(w, CLAST_ERR_FORMAT, "checkpoint %s is damaged: %s", path, fault);
    /* the contacts of the start have felt velocities that nobody saves, those at the time of the
     * positions: they are as the scene makes them */
    if (s->step == 0 && s->hash == clast_world_hash(w)) return CLAST_OK;
    install(w, s);
    uint64_t hash = clast_world_hash(w);
    if (hash != s->hash)
        return world_fail(
            w, CLAST_ERR_FORMAT,
            "checkpoint %s is damaged: the state has hash 0x%016llx, saved was 0x%016llx", path,
            (unsigned long long)hash, (unsigned long long)s->hash);
    return CLAST_OK;
}

/* Opens and reads; on failure the world holds the message. */
static clast_status read_file(clast_world *w, const char *path, saved *s, char **note,
                              bool to_inherit) {
    h5_file *f = h5_open(path);
    read_saved(f, path, s, to_inherit);
    read_scheme(f, w, s);
    char *text = h5_read_text(f, "/note");
    clast_status status = h5_status(f);
    if (status != CLAST_OK) world_fail(w, status, "checkpoint %s", h5_error(f));
    h5_free(f);
    if (note && status == CLAST_OK)
        *note = text;
    else
        free(text);
    return status;
}

clast_status clast_checkpoint_load(clast_world *w, const char *path, char **note) {
    CLAST_ASSERT(w && path && w->step == 0);
    if (note) *note = NULL;
    clast_status status = w->prepared ? CLAST_OK : clast_world_prepare(w);
    if (status != CLAST_OK) return status;
    saved s = {0};
    char *text = NULL;
    status = ranks_agree_status(w, read_file(w, path, &s, &text, false));
    if (status == CLAST_OK) status = check_and_install(w, path, &s);
    saved_free(&s);
    if (note && status == CLAST_OK)
        *note = text;
    else
        free(text);
    return status;
}

/* ---- inheriting ------------------------------------------------------------------------------ */

/* The start of the line of `text` that begins with `head`, or NULL. */
static const char *line_of(const char *all, const char *head) {
    for (const char *line = all; *line;
         line += line_length(line) + (line[line_length(line)] == '\n'))
        if (strncmp(line, head, strlen(head)) == 0) return line;
    return NULL;
}

/* Shapes of the file in its order, by their index in this world; -1 where there is none alike. */
static int *match_shapes(clast_world *w, const saved *s, int *count) {
    *count = 0;
    for (const char *line = s->scene; (line = line_of(line, "shape ")); line += line_length(line))
        ++*count;
    int *match = malloc(((size_t)*count + 1) * sizeof *match);
    CLAST_ASSERT(match);
    const char *line = s->scene;
    for (int k = 0; k < *count; k++, line += line_length(line)) {
        line = line_of(line, "shape ");
        match[k] = -1;
        for (int i = 0; i < w->shape_count; i++) {
            char *ours;
            FILE *t = text_open(&ours);
            describe_shape(t, w, i);
            text_close(t);
            if (line_length(ours) == line_length(line) && !strncmp(ours, line, line_length(line)))
                match[k] = i;
            free(ours);
        }
    }
    return match;
}

/* Index in this world of the file's index-th wall, by name; -1 where there is none. */
static int match_wall(const clast_world *w, const saved *s, uint32_t index) {
    const char *line = s->wall_names;
    for (; index > 0 && *line; index--)
        line += line_length(line) + (line[line_length(line)] == '\n');
    size_t length = line_length(line);
    for (int i = 0; i < w->wall_count; i++)
        if (strlen(w->walls[i].name) == length && strncmp(w->walls[i].name, line, length) == 0)
            return i;
    return -1;
}

static uint32_t count_lines(const char *all) {
    uint32_t n = 0;
    for (; *all; all++) n += *all == '\n';
    return n;
}

static clast_status inherit_bodies(clast_world *w, const char *path, const saved *s,
                                   const int *shape_of) {
    const body_store *b = &s->bodies;
    body_reserve(w, b->count);
    for (size_t i = 0; i < b->count; i++) {
        int shape_index = shape_of[b->shape[i]];
        if (shape_index < 0)
            return world_fail(
                w, CLAST_ERR_MISMATCH,
                "checkpoint %s: body %u has a shape that this scene does not have, or has "
                "with other spheres, mass or material",
                path, b->id[i]);
        clast_body_def def = {.shape = shape_index,
                              .position = {b->x[i], b->y[i], b->z[i]},
                              .orientation = {b->qw[i], b->qx[i], b->qy[i], b->qz[i]},
                              .velocity = {s->now[0][i], s->now[1][i], s->now[2][i]},
                              .spin = {s->now[3][i], s->now[4][i], s->now[5][i]}};
        if (clast_body_add(w, &def) < 0) return CLAST_ERR_FORMAT;
    }
    return CLAST_OK;
}

/* Contacts keep their springs: ids become 0, 1, 2, ... and walls are found by name. A contact with
 * a wall that is not here ends. */
static void inherit_contacts(clast_world *w, saved *s) {
    size_t count = 0;
    for (size_t i = 0; i < s->record_count; i++) {
        contact_record r = s->records[i];
        bool with_wall = r.b >= CLAST_WALL_ID;
        int wall_index = with_wall ? match_wall(w, s, r.b - CLAST_WALL_ID) : -1;
        if (with_wall && wall_index < 0) continue;
        r.a = (uint32_t)place_of_id(s, r.a);
        r.b = with_wall ? CLAST_WALL_ID + (uint32_t)wall_index : (uint32_t)place_of_id(s, r.b);
        s->records[count++] = r;
    }
    install_records(w, s);
    w->records.count = count;
}

clast_status clast_checkpoint_inherit(clast_world *w, const char *path) {
    CLAST_ASSERT(w && path && !w->prepared && w->bodies.count == 0);
    saved s = {0};
    clast_status status = read_file(w, path, &s, NULL, true);
    if (status == CLAST_OK) {
        int shapes;
        int *shape_of = match_shapes(w, &s, &shapes);
        const char *fault = fault_of_indices(w, &s, shape_of, shapes, count_lines(s.wall_names));
        if (fault)
            status = world_fail(w, CLAST_ERR_FORMAT, "checkpoint %s is damaged: %s", path, fault);
        else
            status = inherit_bodies(w, path, &s, shape_of);
        if (status == CLAST_OK) inherit_contacts(w, &s);
        free(shape_of);
    }
    saved_free(&s);
    return status;
}
