/* flow_saved.c - feeds, outlets and records that nobody has read, to a checkpoint and back. All of
 * them are rows of numbers: counts stay below 2^53. */
#include <stdlib.h>

#include "engine/flow_saved.h"

enum { FEED_NUMBERS = 5, OUTLET_NUMBERS = 2, PASSAGE_NUMBERS = 12 };

/* ---- saving ---------------------------------------------------------------------------------- */

static double *rows(size_t count, size_t width) {
    double *p = malloc((count * width + 1) * sizeof *p);
    CLAST_ASSERT(p);
    return p;
}

static void write_rows(h5_file *f, const char *name, size_t count, size_t width, double *numbers) {
    h5_write(f, name, H5_F64, 2, (size_t[]){count, width}, numbers);
    free(numbers);
}

static void save_passages(h5_file *f, const char *name, const passage_list *l) {
    size_t count = l->count - l->read;
    double *all = rows(count, PASSAGE_NUMBERS), *to = all;
    for (size_t i = l->read; i < l->count; i++) {
        const clast_passage *p = &l->items[i];
        const double row[PASSAGE_NUMBERS] = {p->id,           p->shape,      p->gate,
                                             (double)p->step, p->time,       p->mass,
                                             p->position.x,   p->position.y, p->position.z,
                                             p->velocity.x,   p->velocity.y, p->velocity.z};
        for (int k = 0; k < PASSAGE_NUMBERS; k++) *to++ = row[k];
    }
    write_rows(f, name, count, PASSAGE_NUMBERS, all);
}

static void put_outlet(double *to, const outlet_state *s) {
    to[0] = (double)s->bodies, to[1] = s->mass;
}

/* The domain is the last of the outlets. */
void flow_save(h5_file *f, const clast_world *w) {
    const flow *o = w->flow;
    size_t feeds = (size_t)o->feed_count, outlets = (size_t)o->outlet_count;
    double *all = rows(feeds, FEED_NUMBERS);
    for (size_t i = 0; i < feeds; i++) {
        const feed_state *s = &o->feeds[i].state;
        double *to = all + i * FEED_NUMBERS;
        to[0] = (double)s->bodies, to[1] = (double)s->refused, to[2] = (double)s->places;
        to[3] = (double)s->rest_until, to[4] = s->mass;
    }
    write_rows(f, "/flow/feeds", feeds, FEED_NUMBERS, all);
    all = rows(outlets + 1, OUTLET_NUMBERS);
    for (size_t i = 0; i < outlets; i++) put_outlet(all + i * OUTLET_NUMBERS, &o->outlets[i].state);
    put_outlet(all + outlets * OUTLET_NUMBERS, &o->domain);
    write_rows(f, "/flow/outlets", outlets + 1, OUTLET_NUMBERS, all);
    save_passages(f, "/flow/arrivals", &o->arrivals);
    save_passages(f, "/flow/departures", &o->departures);
}

/* ---- reading --------------------------------------------------------------------------------- */

static double *read_rows(h5_file *f, const char *name, size_t width, size_t *count) {
    size_t numbers = 0;
    double *all = h5_read_all(f, name, H5_F64, &numbers);
    *count = numbers / width;
    if (h5_status(f) == CLAST_OK && numbers % width != 0)
        h5_fail(f, CLAST_ERR_FORMAT, "'%s' holds %zu numbers, expected rows of %zu", name, numbers,
                width);
    return all;
}

void flow_read(h5_file *f, saved_flow *s) {
    s->feeds = read_rows(f, "/flow/feeds", FEED_NUMBERS, &s->feed_count);
    s->outlets = read_rows(f, "/flow/outlets", OUTLET_NUMBERS, &s->outlet_count);
    s->arrivals = read_rows(f, "/flow/arrivals", PASSAGE_NUMBERS, &s->arrival_count);
    s->departures = read_rows(f, "/flow/departures", PASSAGE_NUMBERS, &s->departure_count);
}

void flow_read_free(saved_flow *s) {
    free(s->feeds), free(s->outlets), free(s->arrivals), free(s->departures);
}

static bool is_whole(double x, double low, double high) {
    return x >= low && x < high && x == floor(x);
}

static bool are_passages(const clast_world *w, const double *row, size_t count, uint32_t ids,
                         double low, double high) {
    for (size_t i = 0; i < count; i++, row += PASSAGE_NUMBERS)
        if (!is_whole(row[0], 0, ids) || !is_whole(row[1], 0, w->shape_count) ||
            !is_whole(row[2], low, high) || !is_whole(row[3], 0, 0x1p53))
            return false;
    return true;
}

/* NULL when it fits the world, whose bodies have had so many ids. */
const char *flow_fault(const clast_world *w, const saved_flow *s, uint32_t ids) {
    const flow *o = w->flow;
    double came = w->scene_ids;
    if (s->feed_count != (size_t)o->feed_count) return "feeds are missing";
    if (s->outlet_count != (size_t)o->outlet_count + 1) return "outlets are missing";
    for (size_t i = 0; i < s->feed_count; i++) {
        for (int k = 0; k < FEED_NUMBERS - 1; k++)
            if (!is_whole(s->feeds[i * FEED_NUMBERS + (size_t)k], 0, 0x1p53))
                return "a feed has a count that is none";
        came += s->feeds[i * FEED_NUMBERS];
    }
    if (came != ids) return "bodies and feeds differ in number";
    for (size_t i = 0; i < s->outlet_count; i++)
        if (!is_whole(s->outlets[i * OUTLET_NUMBERS], 0, 0x1p53))
            return "an outlet has a count that is none";
    if (!are_passages(w, s->arrivals, s->arrival_count, ids, 0, o->feed_count) ||
        !are_passages(w, s->departures, s->departure_count, ids, CLAST_OUTLET_DOMAIN,
                      o->outlet_count))
        return "a record of a body that came or went is none";
    return NULL;
}

/* ---- into the world -------------------------------------------------------------------------- */

static void install_passages(clast_world *w, passage_list *l, const double *row, size_t count) {
    clast_passage *items = malloc((count + 1) * sizeof *items);
    CLAST_ASSERT(items);
    for (size_t i = 0; i < count; i++, row += PASSAGE_NUMBERS)
        items[i] = (clast_passage){.id = (uint32_t)row[0],
                                   .shape = (int32_t)row[1],
                                   .gate = (int32_t)row[2],
                                   .step = (uint64_t)row[3],
                                   .time = row[4],
                                   .mass = row[5],
                                   .position = {row[6], row[7], row[8]},
                                   .velocity = {row[9], row[10], row[11]}};
    passages_install(w, l, count, items);
}

static outlet_state outlet_in(const double *row) {
    return (outlet_state){(uint64_t)row[0], row[1]};
}

void flow_install(clast_world *w, const saved_flow *s) {
    flow *o = w->flow;
    w->counters.fed = 0;
    for (size_t i = 0; i < s->feed_count; i++) {
        const double *row = s->feeds + i * FEED_NUMBERS;
        o->feeds[i].state = (feed_state){.bodies = (uint64_t)row[0],
                                         .refused = (uint64_t)row[1],
                                         .places = (uint64_t)row[2],
                                         .rest_until = (uint64_t)row[3],
                                         .mass = row[4]};
        w->counters.fed += (size_t)row[0];
    }
    for (int i = 0; i < o->outlet_count; i++)
        o->outlets[i].state = outlet_in(s->outlets + OUTLET_NUMBERS * i);
    o->domain = outlet_in(s->outlets + OUTLET_NUMBERS * o->outlet_count);
    install_passages(w, &o->arrivals, s->arrivals, s->arrival_count);
    install_passages(w, &o->departures, s->departures, s->departure_count);
}

/* ---- the scene in lines ---------------------------------------------------------------------- */

static void describe_vec(FILE *t, const char *what, vec3 a) {
    fprintf(t, " %s %.17g %.17g %.17g", what, a.x, a.y, a.z);
}

static void describe_feed(FILE *t, const clast_world *w, const feed *f) {
    const clast_feed_def *d = &f->def;
    fprintf(t, "feed %s", d->name);
    describe_vec(t, "region", d->region_min), describe_vec(t, "to", d->region_max);
    for (int k = 0; k < d->shapes; k++)
        fprintf(t, " shape %s up to %.17g", w->shapes[d->shape[k]].name, f->below[k]);
    fprintf(t, " rate %.17g kg/s %.17g /s from %.17g until %.17g attempts %d", d->mass_rate,
            d->number_rate, d->from, d->until, d->attempts);
    describe_vec(t, "velocity", d->velocity), describe_vec(t, "spin", d->spin);
    quat q = d->orientation;
    fprintf(t, " turned %d %.17g %.17g %.17g %.17g\n", (int)d->turned, q.w, q.x, q.y, q.z);
}

void flow_describe(FILE *t, const clast_world *w) {
    const flow *o = w->flow;
    for (int i = 0; i < o->feed_count; i++) describe_feed(t, w, &o->feeds[i]);
    for (int i = 0; i < o->outlet_count; i++) {
        const clast_outlet_def *d = &o->outlets[i].def;
        bool box = d->kind == CLAST_OUTLET_BOX;
        fprintf(t, "outlet %s", d->name);
        describe_vec(t, box ? "box" : "beyond", box ? d->min : d->point);
        describe_vec(t, box ? "to" : "along", box ? d->max : d->normal);
        fprintf(t, "\n");
    }
}
