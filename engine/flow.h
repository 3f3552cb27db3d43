/* flow.h - what comes into the world by feeds and goes out by outlets. Private to engine/. */
#ifndef CLAST_ENGINE_FLOW_H
#define CLAST_ENGINE_FLOW_H

#include "engine/world.h"

/* What the next body of a feed depends on; saved and hashed. */
typedef struct feed_state {
    uint64_t bodies, refused;
    uint64_t places;     /* tried so far: counts the random numbers of places */
    uint64_t rest_until; /* step before which it does not try again */
    double mass;         /* kg */
} feed_state;

typedef struct feed {
    clast_feed_def def; /* shapes and shares are the world's own copies */
    double *below;      /* shares of the kinds up to each, the last is 1 */
    feed_state state;
} feed;

typedef struct outlet_state {
    uint64_t bodies;
    double mass; /* kg */
} outlet_state;

typedef struct outlet {
    clast_outlet_def def;
    outlet_state state;
} outlet;

/* Records, oldest first; those before `read` have been. */
typedef struct passage_list {
    size_t read, count, capacity;
    clast_passage *items;
} passage_list;

struct flow {
    feed *feeds;
    outlet *outlets;
    int feed_count, outlet_count;
    outlet_state domain; /* what left it */
    passage_list arrivals, departures;
    uint32_t *leaving; /* scratch: ids */
    size_t leaving_room;
};

/* feed.c: what the ledger must expect of all feeds: kg, and m2/s2 of the fastest, if above. */
double feeds_mass_expected(const clast_world *w, double *fastest2);

/* outlet.c: the outlet that the body is in, CLAST_OUTLET_DOMAIN where it is outside the domain. */
enum { NO_OUTLET = -2 };
int outlet_of(const clast_world *w, size_t slot);

/* flow.c */
void passage_note(clast_world *w, passage_list *l, size_t slot, int gate);
void passages_install(clast_world *w, passage_list *l, size_t count, clast_passage *items);

#endif
