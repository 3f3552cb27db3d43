/* ranks.h - a world that several processes share. Private to engine/.
 *
 * Every process holds all walls, shapes and parts, and a part of the bodies: its own. Behind them
 * in storage stand ghosts, bodies of others that are within reach of the box around its own ones;
 * who they are is found out whenever the lists are made, and where they are comes in every step. A
 * pair of an own body and a ghost is worked out on both processes, with the same bits, and booked
 * where the body of lower id is: shares beyond the first `threads` hold the pairs that are booked
 * elsewhere. What is summed up over the world is exact (sum.h) and has no order.
 *
 * Without several processes every function here does nothing, and none of them is in the way of a
 * step by more than a test. */
#ifndef CLAST_ENGINE_RANKS_H
#define CLAST_ENGINE_RANKS_H

#include "engine/world.h"

/* What the processes say to each other (ranks_mpi.c). All call each of these, and in one order. */
typedef struct rank_transport {
    int number, count;
    int beside; /* processes on this machine */
    /* In place: the first `most` become the largest, the `sums` behind them are added up. */
    void (*reduce)(double *values, int most, int sums);
    void (*add_words)(uint64_t *words, int count); /* modulo 2^64 */
    void (*tell)(void *bytes, size_t size, int from);
    /* What all have, one behind the other; malloc'ed. `sizes`: bytes, one per process. */
    char *(*gather)(const void *bytes, size_t size, size_t *sizes);
    /* Pieces for each process stand one behind the other; what came, likewise, malloc'ed. */
    char *(*exchange)(const void *out, const size_t *out_sizes, size_t *in_sizes);
    /* The same where both sides know the sizes, and none needs to be empty. Returns messages sent.
     */
    int (*swap)(const void *out, const size_t *out_sizes, void *in, const size_t *in_sizes);
    /* Recursive bisection by coordinates: who is to have each of the bodies that are here. False
     * with nothing written where it fails. */
    bool (*divide)(size_t bodies, const double *x, const double *y, const double *z,
                   const float *work, int *owner);
} rank_transport;

extern const rank_transport *ranks_transport; /* NULL without several processes */

/* Bytes: what is longer goes in several messages, since MPI counts in 31 bits. Tests have less. */
extern size_t ranks_piece;

/* m, around the own bodies of a process when the lists were made; low > high where it has none */
typedef struct rank_box {
    double low[3], high[3];
} rank_box;

/* Columns that readers were given: bodies, then spheres. */
enum { RANK_READS = 48 };

typedef struct ranks {
    const rank_transport *by;
    rank_box *boxes;    /* of all processes */
    uint32_t *out_slot; /* own bodies that are ghosts elsewhere, process by process */
    uint32_t *in_slot;  /* ghosts in the order in which they came */
    size_t out_count, out_room, in_count, in_room;
    size_t *out_bodies, *in_bodies; /* per process */
    size_t *out_bytes, *in_bytes;   /* per process, of a step */
    double *out, *in;               /* rows of a step */
    size_t out_numbers, in_numbers; /* room */
    size_t bodies, spheres;         /* of all */
    void *read[RANK_READS];
    double waste, price; /* of the division so far, and of making another: ranks_divide.c */
    double ghosts_new;   /* of all, after the last division */
    uint64_t since;      /* step of the last rebuild that was looked at */
} ranks;

/* ranks.c */
clast_status ranks_join(clast_world *w);
void ranks_leave(clast_world *w);
int ranks_beside(void);
void ranks_reduce(const clast_world *w, double *values, int most, int sums);
void ranks_sum(const clast_world *w, exact_sum *sums, int count);
void ranks_add_words(const clast_world *w, uint64_t *words, int count);
void ranks_agree(clast_world *w);
void ranks_count_all(clast_world *w);
bool ranks_speaks(const clast_world *w);
clast_status ranks_agree_status(clast_world *w, clast_status status);
/* The text of the process whose first key is largest, among equals the second, ...; `keys` become
 * its own. Where all are equal, the first process speaks: keys that name the culprit make it the
 * same one for any number of processes. */
void ranks_elect(const clast_world *w, double *keys, int count, char *text, size_t room);
/* `count` things of `size` bytes of every process, one behind the other; malloc'ed. */
void *ranks_gather(const clast_world *w, const void *own, size_t count, size_t size, size_t *all);

/* A body on its way to another process, whole. */
typedef struct traveller {
#define X(type, name) type name;
    BODY_COLUMNS(X)
#undef X
    int32_t image[3];
} traveller;

/* ranks_ghosts.c */
traveller ranks_body_at(const clast_world *w, size_t slot);
void ranks_put_body(clast_world *w, size_t slot, const traveller *t);
double ranks_away(const clast_world *w, const rank_box *b, vec3 place);
void ranks_forget_ghosts(clast_world *w);
void ranks_list_ghosts(clast_world *w);
void ranks_swap(clast_world *w);

/* ranks_read.c */
clast_bodies ranks_bodies(clast_world *w, clast_bodies own);
clast_spheres ranks_spheres(clast_world *w, clast_spheres own);

/* ranks_divide.c */
double ranks_work(const clast_world *w);
void ranks_scatter(clast_world *w);
bool ranks_wish_to_divide(clast_world *w);
void ranks_divide(clast_world *w);
int ranks_nearest(const clast_world *w, vec3 place);

#endif
