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

/* Of so many bytes, those of the piece that begins there. */
static int piece_at(size_t bytes, size_t at) {
    size_t rest = bytes - at, piece = rest < ranks_piece ? rest : ranks_piece;
    CLAST_ASSERT(at <= bytes && piece <= INT32_MAX);
    return (int)piece;
}

static void tell(void *bytes, size_t size, int from) {
    for (size_t at = 0; at < size; at += ranks_piece)
        MPI_Bcast((char *)bytes + at, piece_at(size, at), MPI_BYTE, from, MPI_COMM_WORLD);
}

static size_t sum_of(const size_t *sizes) {
    size_t sum = 0;
    for (int q = 0; q < transport.count; q++) sum += sizes[q];
    return sum;
}

/* Where each one's begin, then how many they are. */
static int *places_of(const size_t *sizes) {
    int *place = malloc(2 * (size_t)transport.count * sizeof *place), at = 0;
    CLAST_ASSERT(place);
    for (int q = 0; q < transport.count; q++) {
        place[q] = at, place[transport.count + q] = (int)sizes[q];
        at += (int)sizes[q];
    }
    return place;
}

static char *room_for(size_t bytes) {
    char *room = malloc(bytes + 1);
    CLAST_ASSERT(room);
    return room;
}

/* Little in one go, much from one process after the other. */
static char *gather(const void *bytes, size_t size, size_t *sizes) {
    MPI_Allgather(&size, sizeof size, MPI_BYTE, sizes, sizeof size, MPI_BYTE, MPI_COMM_WORLD);
    size_t sum = sum_of(sizes);
    char *all = room_for(sum), *to = all;
    if (sum <= ranks_piece) {
        int *place = places_of(sizes);
        MPI_Allgatherv(bytes, (int)size, MPI_BYTE, all, place + transport.count, place, MPI_BYTE,
                       MPI_COMM_WORLD);
        free(place);
        return all;
    }
    for (int q = 0; q < transport.count; to += sizes[q++]) {
        if (q == transport.number && size > 0) memcpy(to, bytes, size);
        tell(to, sizes[q], q);
    }
    return all;
}

static struct {
    MPI_Request *items;
    size_t count, room;
} requests;

static MPI_Request *next_request(void) {
    if (requests.count == requests.room) {
        requests.room = 2 * requests.room + 16;
        requests.items = realloc(requests.items, requests.room * sizeof *requests.items);
        CLAST_ASSERT(requests.items);
    }
    return &requests.items[requests.count++];
}

static int swap(const void *out, const size_t *out_sizes, void *in, const size_t *in_sizes) {
    char *to = in;
    const char *from = out;
    requests.count = 0;
    for (int q = 0; q < transport.count; to += in_sizes[q++])
        for (size_t at = 0; at < in_sizes[q]; at += ranks_piece)
            MPI_Irecv(to + at, piece_at(in_sizes[q], at), MPI_BYTE, q, 0, MPI_COMM_WORLD,
                      next_request());
    size_t taken = requests.count;
    for (int q = 0; q < transport.count; from += out_sizes[q++])
        for (size_t at = 0; at < out_sizes[q]; at += ranks_piece)
            MPI_Isend(from + at, piece_at(out_sizes[q], at), MPI_BYTE, q, 0, MPI_COMM_WORLD,
                      next_request());
    MPI_Waitall((int)requests.count, requests.items, MPI_STATUSES_IGNORE);
    return (int)(requests.count - taken);
}

static char *exchange(const void *out, const size_t *out_sizes, size_t *in_sizes) {
    MPI_Alltoall(out_sizes, sizeof *out_sizes, MPI_BYTE, in_sizes, sizeof *in_sizes, MPI_BYTE,
                 MPI_COMM_WORLD);
    char *in = room_for(sum_of(in_sizes));
    swap(out, out_sizes, in, in_sizes);
    return in;
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
    free(requests.items);
    requests.items = NULL, requests.room = 0;
    ranks_transport = NULL;
    if (reduction.numbers > 0) MPI_Type_free(&reduction.record);
    MPI_Op_free(&reduction.join);
    MPI_Finalize();
    begun = false;
    reduction.numbers = 0;
}
