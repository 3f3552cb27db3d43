/* ranks_mpi.c - what processes say to each other, by MPI, and how the bodies are divided among
 * them, by Zoltan. The one file that knows these two. */
#include <mpi.h>
#include <stdlib.h>
#include <string.h>
#include <zoltan.h>

#include "engine/ranks.h"

static rank_transport transport;
static bool begun;

/* ---- reductions ------------------------------------------------------------------------------ */

/* Of the reduction that is going on. */
static struct {
    int most, numbers;
    MPI_Datatype record;
    MPI_Op join;
} reduction;

static void join(void *in, void *inout, int *count, MPI_Datatype *type) {
    (void)type;
    const double *from = in;
    double *to = inout;
    for (int r = 0; r < *count; r++, from += reduction.numbers, to += reduction.numbers)
        for (int k = 0; k < reduction.numbers; k++) {
            if (k >= reduction.most)
                to[k] += from[k];
            else
                to[k] = from[k] > to[k] ? from[k] : to[k];
        }
}

/* A record is one element, so that MPI never cuts it. */
static void reduce(double *values, int most, int sums) {
    if (most + sums == 0) return;
    if (reduction.numbers != most + sums) {
        if (reduction.numbers > 0) MPI_Type_free(&reduction.record);
        MPI_Type_contiguous(most + sums, MPI_DOUBLE, &reduction.record);
        MPI_Type_commit(&reduction.record);
    }
    reduction.most = most, reduction.numbers = most + sums;
    MPI_Allreduce(MPI_IN_PLACE, values, 1, reduction.record, reduction.join, MPI_COMM_WORLD);
}

static void add_words(uint64_t *words, int count) {
    MPI_Allreduce(MPI_IN_PLACE, words, count, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
}

/* ---- bytes ----------------------------------------------------------------------------------- */

static int as_int(size_t bytes) {
    CLAST_ASSERT(bytes <= INT32_MAX);
    return (int)bytes;
}

static void tell(void *bytes, size_t size, int from) {
    MPI_Bcast(bytes, as_int(size), MPI_BYTE, from, MPI_COMM_WORLD);
}

static int *places_of(const size_t *sizes, int **counts) {
    int *place = malloc(2 * (size_t)transport.count * sizeof *place);
    size_t at = 0;
    CLAST_ASSERT(place);
    *counts = place + transport.count;
    for (int q = 0; q < transport.count; q++) {
        place[q] = as_int(at), (*counts)[q] = as_int(sizes[q]);
        at += sizes[q];
    }
    as_int(at);
    return place;
}

static size_t sum_of(const size_t *sizes) {
    size_t sum = 0;
    for (int q = 0; q < transport.count; q++) sum += sizes[q];
    return sum;
}

static char *room_for(size_t bytes) {
    char *room = malloc(bytes + 1);
    CLAST_ASSERT(room);
    return room;
}

static char *gather(const void *bytes, size_t size, size_t *sizes) {
    int *counts;
    MPI_Allgather(&size, sizeof size, MPI_BYTE, sizes, sizeof size, MPI_BYTE, MPI_COMM_WORLD);
    int *place = places_of(sizes, &counts);
    char *all = room_for(sum_of(sizes));
    MPI_Allgatherv(bytes, as_int(size), MPI_BYTE, all, counts, place, MPI_BYTE, MPI_COMM_WORLD);
    free(place);
    return all;
}

static char *exchange(const void *out, const size_t *out_sizes, size_t *in_sizes) {
    int *out_counts, *in_counts;
    MPI_Alltoall(out_sizes, sizeof *out_sizes, MPI_BYTE, in_sizes, sizeof *in_sizes, MPI_BYTE,
                 MPI_COMM_WORLD);
    int *from = places_of(out_sizes, &out_counts), *to = places_of(in_sizes, &in_counts);
    char *in = room_for(sum_of(in_sizes));
    MPI_Alltoallv(out, out_counts, from, MPI_BYTE, in, in_counts, to, MPI_BYTE, MPI_COMM_WORLD);
    free(from), free(to);
    return in;
}

static int swap(const void *out, const size_t *out_sizes, void *in, const size_t *in_sizes) {
    static MPI_Request *request;
    int n = 0, sent = 0;
    if (!request) request = malloc(2 * (size_t)transport.count * sizeof *request);
    CLAST_ASSERT(request);
    char *to = in;
    const char *from = out;
    for (int q = 0; q < transport.count; to += in_sizes[q], q++)
        if (in_sizes[q] > 0)
            MPI_Irecv(to, as_int(in_sizes[q]), MPI_BYTE, q, 0, MPI_COMM_WORLD, &request[n++]);
    for (int q = 0; q < transport.count; from += out_sizes[q], q++) {
        if (out_sizes[q] == 0) continue;
        MPI_Isend(from, as_int(out_sizes[q]), MPI_BYTE, q, 0, MPI_COMM_WORLD, &request[n++]);
        sent++;
    }
    MPI_Waitall(n, request, MPI_STATUSES_IGNORE);
    return sent;
}

/* ---- division -------------------------------------------------------------------------------- */

typedef struct crowd {
    size_t bodies;
    const double *x[3];
    const float *work;
} crowd;

static int count_bodies(void *data, int *error) {
    *error = ZOLTAN_OK;
    return (int)((const crowd *)data)->bodies;
}

static void list_bodies(void *data, int id_size, int place_size, ZOLTAN_ID_PTR ids,
                        ZOLTAN_ID_PTR places, int weights, float *work, int *error) {
    (void)id_size, (void)place_size, (void)weights;
    const crowd *c = data;
    for (size_t i = 0; i < c->bodies; i++) {
        ids[i] = (ZOLTAN_ID_TYPE)i; /* this and the process together are unique enough for RCB */
        places[i] = (ZOLTAN_ID_TYPE)i;
        work[i] = c->work[i];
    }
    *error = ZOLTAN_OK;
}

static int count_axes(void *data, int *error) {
    (void)data;
    *error = ZOLTAN_OK;
    return 3;
}

static void list_places(void *data, int id_size, int place_size, int count, ZOLTAN_ID_PTR ids,
                        ZOLTAN_ID_PTR places, int axes, double *to, int *error) {
    (void)id_size, (void)place_size, (void)ids, (void)axes;
    const crowd *c = data;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) to[3 * i + k] = c->x[k][places[i]];
    *error = ZOLTAN_OK;
}

static struct Zoltan_Struct *bisection(crowd *c) {
    static const char *const SETTING[][2] = {
        {"DEBUG_LEVEL", "0"},       {"LB_METHOD", "RCB"},     {"LB_APPROACH", "PARTITION"},
        {"NUM_GID_ENTRIES", "1"},   {"NUM_LID_ENTRIES", "1"}, {"OBJ_WEIGHT_DIM", "1"},
        {"RETURN_LISTS", "EXPORT"}, {"IMBALANCE_TOL", "1.02"}};
    struct Zoltan_Struct *z = Zoltan_Create(MPI_COMM_WORLD);
    CLAST_ASSERT(z);
    for (size_t i = 0; i < sizeof SETTING / sizeof *SETTING; i++)
        Zoltan_Set_Param(z, SETTING[i][0], SETTING[i][1]);
    Zoltan_Set_Num_Obj_Fn(z, count_bodies, c);
    Zoltan_Set_Obj_List_Fn(z, list_bodies, c);
    Zoltan_Set_Num_Geom_Fn(z, count_axes, c);
    Zoltan_Set_Geom_Multi_Fn(z, list_places, c);
    return z;
}

static bool divide(size_t bodies, const double *x, const double *y, const double *z,
                   const float *work, int *owner) {
    crowd c = {bodies, {x, y, z}, work};
    struct Zoltan_Struct *zoltan = bisection(&c);
    int changes, id_size, place_size, in = 0, out = 0, *in_from, *in_part, *out_to, *out_part;
    ZOLTAN_ID_PTR in_id, in_place, out_id, out_place;
    int failed =
        Zoltan_LB_Partition(zoltan, &changes, &id_size, &place_size, &in, &in_id, &in_place,
                            &in_from, &in_part, &out, &out_id, &out_place, &out_to, &out_part);
    bool good = failed == ZOLTAN_OK || failed == ZOLTAN_WARN;
    for (size_t i = 0; i < bodies; i++) owner[i] = transport.number;
    for (int i = 0; good && i < out; i++) owner[out_place[i]] = out_to[i];
    Zoltan_LB_Free_Part(&in_id, &in_place, &in_from, &in_part);
    Zoltan_LB_Free_Part(&out_id, &out_place, &out_to, &out_part);
    Zoltan_Destroy(&zoltan);
    return good;
}

/* ---- life ------------------------------------------------------------------------------------ */

/* A process that nobody started beside others needs no MPI. */
static bool is_one_of_many(void) {
    static const char *const SIGN[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMI_RANK", "PMIX_RANK",
                                       "MPI_LOCALNRANKS"};
    for (size_t i = 0; i < sizeof SIGN / sizeof *SIGN; i++)
        if (getenv(SIGN[i])) return true;
    return false;
}

static int count_beside(void) {
    MPI_Comm beside;
    int count;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &beside);
    MPI_Comm_size(beside, &count);
    MPI_Comm_free(&beside);
    return count;
}

clast_status clast_ranks_begin(void) {
    int given;
    float version;
    if (begun || !is_one_of_many()) return CLAST_OK;
    /* who waits gives way: a process that spins is in the way of those that it waits for wherever
     * there are more of them than processors */
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &given);
    begun = true;
    transport = (rank_transport){.reduce = reduce,
                                 .add_words = add_words,
                                 .tell = tell,
                                 .gather = gather,
                                 .exchange = exchange,
                                 .swap = swap,
                                 .divide = divide};
    MPI_Comm_rank(MPI_COMM_WORLD, &transport.number);
    MPI_Comm_size(MPI_COMM_WORLD, &transport.count);
    transport.beside = count_beside();
    Zoltan_Initialize(0, NULL, &version);
    MPI_Op_create(join, 1, &reduction.join);
    if (transport.count > 1) ranks_transport = &transport;
    return CLAST_OK;
}

void clast_ranks_end(void) {
    if (!begun) return;
    ranks_transport = NULL;
    if (reduction.numbers > 0) MPI_Type_free(&reduction.record);
    MPI_Op_free(&reduction.join);
    MPI_Finalize();
    begun = false;
    reduction.numbers = 0;
}
