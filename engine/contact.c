/* contact.c - runs the contact kernel over all shares, adds up what the threads found, and reads
 * contacts one by one. */
#include <stdlib.h>
#include <string.h>

#include "engine/parallel.h"
#include "engine/ranks.h"

/* ---- passes ---------------------------------------------------------------------------------- */

typedef struct pass_order {
    clast_world *w;
    contact_mode mode;
} pass_order;

static void run_share(void *context, int thread) {
    const pass_order *o = context;
    for (int t = thread; t < o->w->lists; t += o->w->threads)
        o->w->contact_kernel(o->w, &o->w->shares[t], o->mode);
}

static void run_pass(clast_world *w, contact_mode mode) {
    if (mode != CONTACTS_REPORT && w->special.pushing) {
        size_t rows = (size_t)w->threads * ((size_t)w->part_count + NOBODYS_ROWS);
        if (w->special.driving) memset(w->push_room, 0, rows * sizeof *w->push_room);
        memset(w->push_row_room, 0, rows * sizeof *w->push_row_room);
    }
    pass_order o = {w, mode};
    parallel_run(w->threads, run_share, &o);
}

/* ---- what it found ---------------------------------------------------------------------------
 * All sums are exact, so the order of threads and processes does not matter; the totals grow step
 * by step. */

enum { SUM_ELASTIC, SUM_DASHPOT, SUM_GLOBAL, SUM_CONTACT, SUM_UNWRAPPED, SUMS };

/* Of all threads: PASS_NUMBERS and those of the parts. */
static void merge_threads(clast_world *w) {
    double *record = w->pass_record, overlap = 0, contacts = 0;
    exact_sum *sums = (exact_sum *)(record + 1);
    sums[SUM_ELASTIC] = sums[SUM_DASHPOT] = (exact_sum){0, 0};
    sums[SUM_GLOBAL] = w->found.global, sums[SUM_CONTACT] = w->found.contact;
    sums[SUM_UNWRAPPED] = w->found.unwrapped;
    for (int t = 0; t < w->threads; t++) {
        const contact_tally *tally = &w->shares[t].contact_tally;
        sum_merge(&sums[SUM_ELASTIC], &tally->elastic);
        sum_merge(&sums[SUM_DASHPOT], &tally->dashpot);
        contacts += (double)tally->contacts;
        overlap = tally->overlap_max > overlap ? tally->overlap_max : overlap;
    }
    record[0] = overlap, record[PASS_NUMBERS - 1] = contacts;
}

/* N of the two halves: multiples of one quantum, so that they too are added exactly. What the lower
 * halves have carried goes to the upper ones, which keeps `fine` far below 2^53 quanta. */
static void add_push(exact_sum force[3], const push_row *row, double quantum) {
    uint64_t offsets = row->high[3];
    for (int k = 0; k < 3; k++) {
        int64_t high = (int64_t)(row->high[k] - offsets + (row->low[k] >> 32));
        force[k].coarse += (double)high * (0x1p32 * quantum);
        force[k].fine += (double)(row->low[k] & 0xffffffff) * quantum;
    }
}

static void merge_pushes(clast_world *w) {
    size_t parts = w->special.pushing ? (size_t)w->part_count : 0;
    double *all = w->pass_record + PASS_NUMBERS, quantum = w->load_scale.force_quantum;
    memset(all, 0, parts * PART_NUMBERS * sizeof *all);
    for (int t = 0; t < w->threads; t++) {
        const share *s = &w->shares[t];
        const double *one = (const double *)s->pushes;
        for (size_t i = 0; i < parts; i++)
            add_push((exact_sum *)(all + i * PART_NUMBERS), &s->push_rows[i], quantum);
        for (size_t k = 0; k < parts * PART_NUMBERS && w->special.driving; k++) all[k] += one[k];
    }
}

static void merge_pass(clast_world *w) {
    _Static_assert(PASS_NUMBERS == 2 + 2 * SUMS, "overlap, sums, contacts");
    int parts = w->special.pushing ? w->part_count : 0;
    merge_threads(w);
    merge_pushes(w);
    ranks_reduce(w, w->pass_record, 1, PASS_NUMBERS - 1 + parts * (int)PART_NUMBERS);
}

/* What a part does to the bodies, at the forces of the last pass. */
static part_push push_of(const clast_world *w, int part_index) {
    part_sums all;
    memcpy(&all, w->pass_record + PASS_NUMBERS + (size_t)part_index * PART_NUMBERS, sizeof all);
    vec3 force = v3(sum_value(&all.force[0]), sum_value(&all.force[1]), sum_value(&all.force[2]));
    return (part_push){force, sum_value(&all.moment), sum_value(&all.belt)};
}

/* J: mean of the forces at the two ends of the step, on the way that the part has gone. */
static double step_work(const clast_world *w, const part *p, const part_push *now) {
    vec3 way = to_kernel(w, v3_sub(p->end.offset, p->start.offset));
    double turn = p->end.angle - p->start.angle;
    return 0.5 * (v3_dot(v3_add(p->push.force, now->force), way) +
                  (p->push.moment + now->moment) * turn + (p->push.belt + now->belt) * w->dt);
}

static void book_parts(clast_world *w) {
    double all = 0;
    for (int i = 0; i < w->part_count && w->special.pushing; i++) {
        part *p = &w->parts[i];
        part_push now = push_of(w, i);
        double work = step_work(w, p, &now);
        p->push = now;
        p->work_total += work;
        all += work;
    }
    w->ledger.wall_work += all;
    w->ledger.wall_input += fabs(all);
}

static void book_bodies_and_contacts(clast_world *w) {
    ledger *l = &w->ledger;
    const double *record = w->pass_record;
    const exact_sum *sums = (const exact_sum *)(record + 1);
    l->elastic += sum_value(&sums[SUM_ELASTIC]);
    l->dashpot += sum_value(&sums[SUM_DASHPOT]);
    l->global += sum_value(&sums[SUM_GLOBAL]);
    l->work += sum_value(&sums[SUM_CONTACT]);
    l->unwrapped += sum_value(&sums[SUM_UNWRAPPED]);
    w->found.global = w->found.contact = w->found.unwrapped = (exact_sum){0, 0};
    w->counters.contacts = (size_t)record[PASS_NUMBERS - 1];
    w->overlap_now = record[0];
    if (w->overlap_now > w->counters.overlap_max) w->counters.overlap_max = w->overlap_now;
}

/* At the end of a step: what bodies and contacts have done in it is booked. */
void contacts_evaluate(clast_world *w) {
    run_pass(w, CONTACTS_ADVANCE);
    merge_pass(w);
    book_bodies_and_contacts(w);
    book_parts(w);
}

/* Loads from stored histories, with the bits of the evaluation that stored them. */
void contacts_restore(clast_world *w) {
    loads_clear(w);
    run_pass(w, CONTACTS_AGAIN);
    merge_pass(w);
    for (int i = 0; i < w->part_count && w->special.pushing; i++) w->parts[i].push = push_of(w, i);
}

/* ---- one by one ------------------------------------------------------------------------------ */

static void visit_list(const clast_world *w, const contact_list *l, bool with_wall,
                       contact_visitor *visit, void *context) {
    for (size_t k = 0; k < l->count; k++)
        if (contact_touches(w, l, k)) visit(w, &(contact_place){l, k, with_wall}, context);
}

/* Touching contacts that are booked here, in no order. */
void contacts_visit(const clast_world *w, contact_visitor *visit, void *context) {
    for (int t = 0; t < w->threads; t++) {
        visit_list(w, &w->shares[t].contacts, false, visit, context);
        visit_list(w, &w->shares[t].walls, true, visit, context);
    }
}

static void forget_springs(clast_world *w, contact_list *l) {
    for (size_t k = 0; k < l->count; k++) entry_clear_spring(w, l, k);
}

/* Where friction ends, its springs do. */
void contacts_forget_springs(clast_world *w) {
    for (int t = 0; t < w->lists; t++) {
        forget_springs(w, &w->shares[t].contacts);
        forget_springs(w, &w->shares[t].walls);
    }
}

static const pair_coef *coef_of(const clast_world *w, const contact_place *at) {
    size_t a = (size_t)at->list->a[at->index], b = (size_t)at->list->b[at->index];
    int64_t own = w->rows.motion[body_of_sphere(w, a)].material;
    int64_t other =
        at->with_wall ? w->walls[b].def.material : w->rows.motion[body_of_sphere(w, b)].material;
    return &w->coefs[own * w->material_count + other];
}

static double effective_radius(const clast_world *w, const contact_place *at) {
    double ra = w->rows.centre[at->list->a[at->index]].radius;
    if (at->with_wall) return ra;
    double rb = w->rows.centre[at->list->b[at->index]].radius;
    return ra * rb / (ra + rb);
}

double contact_smaller_radius(const clast_world *w, const contact_place *at) {
    double ra = w->rows.centre[at->list->a[at->index]].radius;
    if (at->with_wall) return ra;
    double rb = w->rows.centre[at->list->b[at->index]].radius;
    return ra < rb ? ra : rb;
}

static double effective_mass(const clast_world *w, const contact_place *at) {
    size_t a = (size_t)at->list->a[at->index], b = (size_t)at->list->b[at->index];
    double ma = w->rows.motion[body_of_sphere(w, a)].mass;
    if (at->with_wall) return ma;
    double mb = w->rows.motion[body_of_sphere(w, b)].mass;
    return ma * mb / (ma + mb);
}

contact_kind contact_kind_of(const clast_world *w, const contact_place *at) {
    return (contact_kind){coef_of(w, at), effective_radius(w, at), effective_mass(w, at)};
}

stored_energy contact_stored_energy(const clast_world *w, const contact_place *at) {
    history h = contact_history(w, at->list, at->index, at->with_wall);
    contact_kind k = contact_kind_of(w, at);
    return law_stored_energy(w, k.coef, k.radius, k.mass, &h);
}

typedef struct energy_sums {
    exact_sum normal, tangential;
} energy_sums;

static void add_energy(const clast_world *w, const contact_place *at, void *context) {
    energy_sums *sums = context;
    stored_energy e = contact_stored_energy(w, at);
    sum_add(&sums->normal, &w->ledger.scale, e.normal);
    sum_add(&sums->tangential, &w->ledger.scale, e.tangential);
}

stored_energy contacts_stored_energy(const clast_world *w) {
    energy_sums sums = {{0, 0}, {0, 0}};
    contacts_visit(w, add_energy, &sums);
    ranks_sum(w, &sums.normal, 2);
    return (stored_energy){sum_value(&sums.normal), sum_value(&sums.tangential)};
}

/* ---- readings -------------------------------------------------------------------------------- */

static void make_reports(share *s) {
    s->report = malloc((s->contacts.count + 1) * sizeof *s->report);
    s->wall_report = malloc((s->walls.count + 1) * sizeof *s->wall_report);
    CLAST_ASSERT(s->report && s->wall_report);
}

static void drop_reports(share *s) {
    free(s->report), free(s->wall_report);
    s->report = s->wall_report = NULL;
}

/* Seen from the body of lower id, whichever stands first in the list. */
static contact_reading reading_of(const clast_world *w, const contact_list *l, size_t k,
                                  const contact_report *r, bool with_wall) {
    contact_reading reading = {.record = record_of(w, l, k, with_wall),
                               .normal = from_kernel(w, r->normal),
                               .force = from_kernel(w, r->force)};
    const centre_row *c = &w->rows.centre[l->a[k]];
    size_t a = body_of_sphere(w, (size_t)l->a[k]);
    if (reading.record.a != w->bodies.id[a]) {
        c = &w->rows.centre[l->b[k]];
        reading.normal = v3_scale(-1, reading.normal);
        reading.force = v3_scale(-1, reading.force);
    }
    vec3 zero = v3(0, 0, 0); /* the sign of a zero hangs on who was a */
    reading.normal = v3_add(reading.normal, zero), reading.force = v3_add(reading.force, zero);
    double lever = with_wall ? r->lever : c->radius - 0.5 * reading.record.history.overlap;
    vec3 centre = from_kernel(w, centre_at(c));
    reading.point = v3_sub(centre, v3_scale(lever, reading.normal));
    return reading;
}

static int by_record(const void *a, const void *b) {
    const contact_reading *x = a, *y = b;
    return record_compare(&x->record, &y->record);
}

static size_t read_list(const clast_world *w, const contact_list *l, const contact_report *reports,
                        bool with_wall, contact_reading *to) {
    size_t count = 0;
    for (size_t k = 0; k < l->count; k++)
        if (contact_touches(w, l, k)) to[count++] = reading_of(w, l, k, &reports[k], with_wall);
    return count;
}

static size_t read_lists(clast_world *w, contact_reading *to) {
    size_t count = 0;
    for (int t = 0; t < w->lists; t++) {
        share *s = &w->shares[t];
        if (!s->across) {
            count += read_list(w, &s->contacts, s->report, false, to + count);
            count += read_list(w, &s->walls, s->wall_report, true, to + count);
        }
        drop_reports(s);
    }
    return count;
}

/* The contacts that touch, all of the world, by a pass that changes nothing. */
size_t contacts_read(clast_world *w, contact_reading **readings) {
    size_t room = 1, count;
    for (int t = 0; t < w->lists; t++) {
        make_reports(&w->shares[t]);
        room += w->shares[t].contacts.count + w->shares[t].walls.count;
    }
    run_pass(w, CONTACTS_REPORT);
    *readings = malloc(room * sizeof **readings);
    CLAST_ASSERT(*readings);
    count = read_lists(w, *readings);
    if (w->ranks) {
        contact_reading *own = *readings;
        *readings = ranks_gather(w, own, count, sizeof *own, &count);
        free(own);
    }
    if (count > 1) qsort(*readings, count, sizeof **readings, by_record);
    return count;
}
