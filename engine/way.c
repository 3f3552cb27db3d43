/* way.c - how far something has moved since the lists were made. Every step adds the way of the
 * fastest, which is a bound: nothing has gone farther. Where the bound asks for new lists, the ways
 * of all spheres are measured, and replace it: what rattles in a cage is fast and goes nowhere. Not
 * observable. */
#include <math.h>

#include "engine/parallel.h"
#include "engine/periodic.h"
#include "engine/ranks.h"

/* Numbers in single precision are as near as this to what they were made of, of their size; twice
 * that covers the arithmetic. */
#define ROUNDED 0x1p-23

static bool asks(double way, double room) {
    return !(2 * way < room);
}

/* ---- places that are remembered -------------------------------------------------------------- */

static void keep(float to[3], const centre_row *c) {
    to[0] = (float)c->x, to[1] = (float)c->y, to[2] = (float)c->z;
}

/* Spheres of a share; ghosts are watched by the last. */
static size_t end_of(const clast_world *w, int thread) {
    bool last = thread == w->threads - 1;
    return last ? w->sphere_count + w->ghost_spheres : w->shares[thread].sphere_end;
}

static void remember_share(void *context, int thread) {
    clast_world *w = context;
    const share *s = &w->shares[thread];
    bool reach = w->way.reach.bound == 0;
    for (size_t i = s->sphere_begin; i < end_of(w, thread); i++) {
        kept_place *p = &w->way.places[i];
        keep(p->contacts, &w->rows.centre[i]);
        if (reach) keep(p->reach, &w->rows.centre[i]);
    }
}

/* Before the reach list is made anew: no other stage needs as much memory. */
void way_forget(clast_world *w) {
    way_store *o = &w->way;
    memory_return(w, o->capacity * sizeof *o->places);
    memory_release(o->places);
    o->places = NULL;
    o->capacity = 0;
    o->knows_reach = o->knows_contacts = false;
}

/* The lists have been made: the contact list, and the reach list too where its bound is zero. Not
 * at the start, when a large state has just been read. */
void way_remember(clast_world *w) {
    way_store *o = &w->way;
    if (!w->prepared || w->integrator) return;
    if (!o->places) {
        o->capacity = w->sphere_count + w->ghost_spheres;
        o->places = memory_lines(w, NULL, 0, o->capacity * sizeof *o->places);
    }
    if (o->reach.bound == 0) o->knows_reach = true;
    o->knows_contacts = true;
    parallel_run(w->threads, remember_share, w);
}

/* ---- ways that are measured ------------------------------------------------------------------ */

static double squared(const period *p, const float from[3], const centre_row *c) {
    vec3 way = separation(p, centre_at(c), v3((double)from[0], (double)from[1], (double)from[2]));
    return v3_dot(way, way);
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

/* The two largest so far, the larger first. */
static void note(double most[2], double x) {
    if (x <= most[1]) return;
    bool first = x > most[0];
    most[1] = first ? most[0] : x;
    most[0] = first ? x : most[0];
}

static void measure_share(void *context, int thread) {
    clast_world *w = context;
    share *s = &w->shares[thread];
    double reach[2] = {0, 0}, contacts[2] = {0, 0}, size = 0;
    for (size_t i = s->sphere_begin; i < end_of(w, thread); i++) {
        const centre_row *c = &w->rows.centre[i];
        const kept_place *p = &w->way.places[i];
        note(reach, squared(&w->kernel_period, p->reach, c));
        note(contacts, squared(&w->kernel_period, p->contacts, c));
        size = larger(fabs(c->x) + fabs(c->y) + fabs(c->z), size);
    }
    for (int k = 0; k < 2; k++) {
        s->way_reach[k] = sqrt(reach[k]) + ROUNDED * size;
        s->way_contacts[k] = sqrt(contacts[k]) + ROUNDED * size;
    }
}

/* The longest of all processes stands for the second as well: a sphere and its ghosts are measured
 * more than once, and its partner may be anywhere. */
static void agree(clast_world *w, double reach[2], double contacts[2]) {
    double most[2] = {reach[0], contacts[0]};
    if (!w->ranks) return;
    ranks_reduce(w, most, 2, 0);
    reach[0] = reach[1] = most[0], contacts[0] = contacts[1] = most[1];
}

/* Two spheres have come nearer by no more than the two longest ways, a sphere and a wall by no more
 * than its way and the wall's. */
static void replace(way_bound *b, const double most[2]) {
    double way = 0.5 * larger(most[0] + most[1], most[0] + b->walls);
    if (way < b->bound) b->bound = way;
}

static void measure(clast_world *w) {
    parallel_run(w->threads, measure_share, w);
    double reach[2] = {0, 0}, contacts[2] = {0, 0};
    for (int t = 0; t < w->threads; t++)
        for (int k = 0; k < 2; k++) {
            note(reach, w->shares[t].way_reach[k]);
            note(contacts, w->shares[t].way_contacts[k]);
        }
    agree(w, reach, contacts);
    if (w->way.knows_reach) replace(&w->way.reach, reach);
    replace(&w->way.contacts, contacts);
}

/* Where a list would be stale soon again, it is made now: looking costs something as well. */
static bool is_worn(const way_bound *b, double room) {
    return asks(b->bound, 0.8 * room);
}

static void add(way_bound *b, double bodies, double walls) {
    b->bound += larger(bodies, walls);
    b->walls += walls;
}

/* Across a periodic face a way is measured to the nearest image: below half a length. */
static bool is_measurable(const clast_world *w) {
    const way_store *o = &w->way;
    double shortest = INFINITY;
    for (int k = 0; k < 3; k++) shortest = fmin(shortest, w->period.half[k]);
    return o->contacts.bound < INFINITY && !(o->reach.bound >= 0.5 * shortest);
}

/* After a step: which lists have to be made anew. */
way_verdict way_judge(clast_world *w) {
    way_store *o = &w->way;
    add(&o->reach, w->found.way, w->wall_way);
    add(&o->contacts, w->found.way, w->wall_way);
    bool reach = asks(o->reach.bound, w->skin), contacts = asks(o->contacts.bound, w->margin);
    if (!(reach || contacts) || !o->knows_contacts || !is_measurable(w))
        return (way_verdict){reach, contacts};
    measure(w);
    return (way_verdict){reach && is_worn(&o->reach, w->skin), is_worn(&o->contacts, w->margin)};
}

void way_restart(clast_world *w, bool reach) {
    if (reach) w->way.reach = (way_bound){0, 0};
    w->way.contacts = (way_bound){0, 0};
}
