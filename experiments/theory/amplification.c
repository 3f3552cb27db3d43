/* amplification.c - schemes as linear maps. A scheme is two sums, one for the new position and one
 * for the new velocity, and the state at which the new force is felt; each sum runs over positions,
 * velocities and accelerations of the next, the present and earlier steps. Velocities are in units
 * of length per dt and accelerations of length per dt^2, so that the coefficients are those of the
 * printed equations. */
#include "experiments/theory/amplification.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>

#include "engine/check.h"

enum { NEXT, NOW, PAST, PAST_2, PAST_3, LEVELS }; /* t+1, t, t-1, t-2, t-3 of S12 */
enum { POSITION, VELOCITY, ELASTIC, DASHPOT, QUANTITIES };

typedef struct weights {
    double x[LEVELS], v[LEVELS], a[LEVELS];
    double elastic[LEVELS], dashpot[LEVELS]; /* parts of a, where a scheme tells them apart */
} weights;

typedef struct scheme {
    const char *source;
    int levels; /* steps that the state remembers */
    weights position, velocity;
    bool predicts; /* the new force is felt at these, not at the new state */
    weights felt_position, felt_velocity;
} scheme;

/* ---- the schemes, as printed ----------------------------------------------------------------- */

/* The leapfrog's state has the velocity of half a step before: its equations are those of the
 * symplectic Euler scheme. Numerov's velocity is the difference that its dashpot is taken with. */
#define NUMEROV_POSITION                                                                           \
    {                                                                                              \
        .x = {[NOW] = 2, [PAST] = -1},                                                             \
        .elastic = {[NEXT] = 1.0 / 12, [NOW] = 10.0 / 12, [PAST] = 1.0 / 12}, .dashpot = {         \
            [NEXT] = 1                                                                             \
        }                                                                                          \
    }
#define EULER                                                                                      \
    .levels = 1, .position = {.x = {[NOW] = 1}, .v = {[NEXT] = 1}},                                \
    .velocity = {.v = {[NOW] = 1}, .a = {[NOW] = 1}}
#define TRAPEZOID_VELOCITY                                                                         \
    {                                                                                              \
        .v = {[NOW] = 1}, .a = { [NEXT] = 0.5, [NOW] = 0.5 }                                       \
    }

static const scheme SCHEMES[SCHEME_COUNT] = {
    [CLAST_SCHEME_LEAPFROG] = {.source = "S12 2.56 and 2.58, half a step shifted", EULER},
    [CLAST_SCHEME_SYMPLECTIC_EULER] = {.source = "S12 2.56 and 2.58", EULER},
    [CLAST_SCHEME_TAYLOR] = {.source = "S12 2.59 and 2.60",
                             .levels = 1,
                             .position = {.x = {[NOW] = 1}, .v = {[NOW] = 1}, .a = {[NOW] = 0.5}},
                             .velocity = {.v = {[NOW] = 1}, .a = {[NOW] = 1}}},
    [CLAST_SCHEME_POSITION_VERLET] = {.source = "S12 2.67 and 2.68; the force feels the velocity "
                                                "that is known, that of Table 2.2",
                                      .levels = 2,
                                      .position = {.x = {[NOW] = 2, [PAST] = -1}, .a = {[NOW] = 1}},
                                      .velocity = {.x = {[NEXT] = 0.5, [PAST] = -0.5}}},
    [CLAST_SCHEME_VELOCITY_VERLET] = {.source = "S12 2.69 to 2.71",
                                      .levels = 1,
                                      .position = {.x = {[NOW] = 1},
                                                   .v = {[NOW] = 1},
                                                   .a = {[NOW] = 0.5}},
                                      .velocity = TRAPEZOID_VELOCITY,
                                      .predicts = true,
                                      .felt_position = {.x = {[NEXT] = 1}},
                                      .felt_velocity = {.v = {[NOW] = 1}, .a = {[NOW] = 0.5}}},
    /* 2.77 and 2.78 make the third derivative a(t) - a(t-1); Table 2.2 prints 11/12 for its weight
     * in the velocity, 2.73 and 2.76 give 1/2 - 5/12 = 1/12. */
    [CLAST_SCHEME_GEAR4] =
        {.source = "S12 2.72 to 2.78",
         .levels = 2,
         .position = {.x = {[NOW] = 1},
                      .v = {[NOW] = 1},
                      .a = {[NEXT] = 1.0 / 12, [NOW] = 1.0 / 2, [PAST] = -1.0 / 12}},
         .velocity = {.v = {[NOW] = 1},
                      .a = {[NEXT] = 5.0 / 12, [NOW] = 2.0 / 3, [PAST] = -1.0 / 12}},
         .predicts = true,
         .felt_position = {.x = {[NOW] = 1},
                           .v = {[NOW] = 1},
                           .a = {[NOW] = 2.0 / 3, [PAST] = -1.0 / 6}},
         .felt_velocity = {.v = {[NOW] = 1}, .a = {[NOW] = 1.5, [PAST] = -0.5}}},
    [CLAST_SCHEME_BACKWARD_EULER] = {.source = "S12 3.2 and 3.3",
                                     .levels = 1,
                                     .position = {.x = {[NOW] = 1}, .v = {[NEXT] = 1}},
                                     .velocity = {.v = {[NOW] = 1}, .a = {[NEXT] = 1}}},
    [CLAST_SCHEME_BEEMAN] = {.source = "S12 3.5 and 3.6",
                             .levels = 1,
                             .position = {.x = {[NOW] = 1},
                                          .v = {[NOW] = 1},
                                          .a = {[NEXT] = 1.0 / 6, [NOW] = 1.0 / 3}},
                             .velocity = TRAPEZOID_VELOCITY},
    [CLAST_SCHEME_NEWMARK_BETA] = {.source = "S12 3.7 and 3.8",
                                   .levels = 1,
                                   .position = {.x = {[NOW] = 1},
                                                .v = {[NOW] = 1},
                                                .a = {[NEXT] = 0.25, [NOW] = 0.25}},
                                   .velocity = TRAPEZOID_VELOCITY},
    [CLAST_SCHEME_BDF2] = {.source = "S12 3.12 and 3.13",
                           .levels = 2,
                           .position = {.x = {[NOW] = 4.0 / 3, [PAST] = -1.0 / 3},
                                        .v = {[NEXT] = 2.0 / 3}},
                           .velocity = {.v = {[NOW] = 4.0 / 3, [PAST] = -1.0 / 3},
                                        .a = {[NEXT] = 2.0 / 3}}},
    [CLAST_SCHEME_BDF4] = {.source = "S12 3.17 and 3.18",
                           .levels = 4,
                           .position = {.x = {[NOW] = 48.0 / 25,
                                              [PAST] = -36.0 / 25,
                                              [PAST_2] = 16.0 / 25,
                                              [PAST_3] = -3.0 / 25},
                                        .v = {[NEXT] = 12.0 / 25}},
                           .velocity = {.v = {[NOW] = 48.0 / 25,
                                              [PAST] = -36.0 / 25,
                                              [PAST_2] = 16.0 / 25,
                                              [PAST_3] = -3.0 / 25},
                                        .a = {[NEXT] = 12.0 / 25}}},
    [CLAST_SCHEME_ADAMS_MOULTON] =
        {.source = "S12 3.19 and 3.20",
         .levels = 2,
         .position = {.x = {[NOW] = 1},
                      .v = {[NEXT] = 5.0 / 12, [NOW] = 2.0 / 3, [PAST] = -1.0 / 12}},
         .velocity = {.v = {[NOW] = 1},
                      .a = {[NEXT] = 5.0 / 12, [NOW] = 2.0 / 3, [PAST] = -1.0 / 12}}},
    [CLAST_SCHEME_TRAPEZOID] = {.source = "S12 3.3.7",
                                .levels = 1,
                                .position = {.x = {[NOW] = 1}, .v = {[NEXT] = 0.5, [NOW] = 0.5}},
                                .velocity = TRAPEZOID_VELOCITY},
    [CLAST_SCHEME_NUMEROV_BACKWARD] = {.source = "S12 3.25 with 3.29",
                                       .levels = 2,
                                       .position = NUMEROV_POSITION,
                                       .velocity = {.x = {[NOW] = 1, [PAST] = -1}}},
    [CLAST_SCHEME_NUMEROV_FORWARD] = {.source = "S12 3.25 with 3.30",
                                      .levels = 2,
                                      .position = NUMEROV_POSITION,
                                      .velocity = {.x = {[NEXT] = 1, [NOW] = -1}}},
    [CLAST_SCHEME_NUMEROV_CENTRAL] = {.source = "S12 3.25 with 3.31",
                                      .levels = 2,
                                      .position = NUMEROV_POSITION,
                                      .velocity = {.x = {[NEXT] = 0.5, [PAST] = -0.5}}},
};

static const scheme *scheme_of(clast_scheme which) {
    CLAST_ASSERT((int)which >= 0 && (int)which < SCHEME_COUNT && SCHEMES[which].source);
    return &SCHEMES[which];
}

const char *scheme_source(clast_scheme which) {
    return scheme_of(which)->source;
}

int scheme_size(clast_scheme which) {
    return QUANTITIES * scheme_of(which)->levels;
}

/* ---- the matrix ------------------------------------------------------------------------------ */

static void weights_at(const weights *w, int level, double row[QUANTITIES]) {
    row[POSITION] = w->x[level];
    row[VELOCITY] = w->v[level];
    row[ELASTIC] = w->a[level] + w->elastic[level];
    row[DASHPOT] = w->a[level] + w->dashpot[level];
}

/* The four equations of a step, all terms of one level: position, velocity, and the two parts of
 * the new acceleration, elastic = -h^2 x and dashpot = -2 z h v. */
static void equations_at(const scheme *s, int level, double step, double damping,
                         double rows[QUANTITIES][QUANTITIES]) {
    static const weights NEW_POSITION = {.x = {[NEXT] = 1}}, NEW_VELOCITY = {.v = {[NEXT] = 1}};
    weights_at(&s->position, level, rows[POSITION]);
    weights_at(&s->velocity, level, rows[VELOCITY]);
    weights_at(s->predicts ? &s->felt_position : &NEW_POSITION, level, rows[ELASTIC]);
    weights_at(s->predicts ? &s->felt_velocity : &NEW_VELOCITY, level, rows[DASHPOT]);
    for (int k = 0; k < QUANTITIES; k++) {
        rows[ELASTIC][k] *= -step * step;
        rows[DASHPOT][k] *= -2 * damping * step;
    }
}

/* Solves (1 - next) new = old: old is overwritten by the rows of the new state. */
static void solve(double next[QUANTITIES][QUANTITIES], double *old, int size) {
    double left[QUANTITIES][QUANTITIES];
    for (int i = 0; i < QUANTITIES; i++)
        for (int j = 0; j < QUANTITIES; j++) left[i][j] = (i == j) - next[i][j];
    size_t order[QUANTITIES];
    int sign;
    gsl_matrix_view a = gsl_matrix_view_array(&left[0][0], QUANTITIES, QUANTITIES);
    gsl_permutation p = {QUANTITIES, order};
    gsl_linalg_LU_decomp(&a.matrix, &p, &sign);
    for (int j = 0; j < size; j++) {
        gsl_vector_view column =
            gsl_vector_view_array_with_stride(old + j, (size_t)size, QUANTITIES);
        gsl_linalg_LU_svx(&a.matrix, &p, &column.vector);
    }
}

void scheme_matrix(clast_scheme which, double step, double damping, double *matrix) {
    CLAST_ASSERT(step > 0 && damping >= 0 && matrix);
    const scheme *s = scheme_of(which);
    int size = scheme_size(which);
    memset(matrix, 0, (size_t)(size * size) * sizeof *matrix);
    double rows[QUANTITIES][QUANTITIES];
    for (int level = NOW; level <= s->levels; level++) {
        equations_at(s, level, step, damping, rows);
        for (int i = 0; i < QUANTITIES; i++)
            memcpy(matrix + i * size + QUANTITIES * (level - NOW), rows[i], sizeof rows[i]);
    }
    equations_at(s, NEXT, step, damping, rows);
    solve(rows, matrix, size);
    for (int i = QUANTITIES; i < size; i++) matrix[i * size + i - QUANTITIES] = 1;
}

/* ---- eigenvalues ----------------------------------------------------------------------------- */

/* matrix, size x size, becomes that of the same map on its own range, in an orthonormal basis of
 * it. Returns the rank. */
static size_t to_range(double *matrix, size_t size) {
    double q[SCHEME_SIZE_MAX * SCHEME_SIZE_MAX], r[SCHEME_SIZE_MAX * SCHEME_SIZE_MAX];
    double room[SCHEME_SIZE_MAX * SCHEME_SIZE_MAX], tau[SCHEME_SIZE_MAX], norm[SCHEME_SIZE_MAX];
    size_t order[SCHEME_SIZE_MAX], rank = 0;
    int sign;
    gsl_matrix_view m = gsl_matrix_view_array(matrix, size, size);
    gsl_matrix_view basis = gsl_matrix_view_array(q, size, size);
    gsl_matrix_view upper = gsl_matrix_view_array(r, size, size);
    gsl_vector_view t = gsl_vector_view_array(tau, size), n = gsl_vector_view_array(norm, size);
    gsl_permutation p = {size, order};
    gsl_linalg_QRPT_decomp2(&m.matrix, &basis.matrix, &upper.matrix, &t.vector, &p, &sign,
                            &n.vector);
    while (rank < size && fabs(r[rank * size + rank]) > 1e-13 * fabs(r[0])) rank++;
    gsl_matrix_view range = gsl_matrix_submatrix(&basis.matrix, 0, 0, size, rank ? rank : 1);
    gsl_matrix_view image = gsl_matrix_view_array(room, size, rank ? rank : 1);
    gsl_matrix_view small = gsl_matrix_view_array(matrix, rank ? rank : 1, rank ? rank : 1);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1, &m.matrix, &range.matrix, 0, &image.matrix);
    gsl_blas_dgemm(CblasTrans, CblasNoTrans, 1, &range.matrix, &image.matrix, 0, &small.matrix);
    return rank;
}

/* All that are not zero. A state holds some numbers twice, which gives defective eigenvalues zero
 * that GSL's iteration does not find: they are split off first. */
static int eigenvalues(clast_scheme which, double step, double damping,
                       double complex values[SCHEME_SIZE_MAX]) {
    double matrix[SCHEME_SIZE_MAX * SCHEME_SIZE_MAX], packed[2 * SCHEME_SIZE_MAX];
    size_t size = (size_t)scheme_size(which), rank;
    scheme_matrix(which, step, damping, matrix);
    while ((rank = to_range(matrix, size)) < size) size = rank;
    CLAST_ASSERT(size > 0);
    gsl_matrix_view m = gsl_matrix_view_array(matrix, size, size);
    gsl_vector_complex_view v = gsl_vector_complex_view_array(packed, size);
    gsl_eigen_nonsymm_workspace *room = gsl_eigen_nonsymm_alloc(size);
    CLAST_ASSERT(room);
    gsl_eigen_nonsymm_params(0, 1, room); /* balanced: the rows differ by powers of h */
    int status = gsl_eigen_nonsymm(&m.matrix, &v.vector, room);
    gsl_eigen_nonsymm_free(room);
    CLAST_ASSERT(status == 0);
    for (size_t i = 0; i < size; i++) values[i] = packed[2 * i] + packed[2 * i + 1] * I;
    return (int)size;
}

double scheme_growth(clast_scheme which, double step, double damping) {
    double complex values[SCHEME_SIZE_MAX];
    double most = 0;
    int count = eigenvalues(which, step, damping, values);
    for (int i = 0; i < count; i++) most = fmax(most, cabs(values[i]));
    return most;
}

scheme_motion scheme_motion_of(clast_scheme which, double step, double damping) {
    CLAST_ASSERT(damping < 1);
    double complex values[SCHEME_SIZE_MAX], nearest = 0;
    double complex exact = cexp(step * (-damping + sqrt(1 - damping * damping) * I));
    int count = eigenvalues(which, step, damping, values);
    for (int i = 0; i < count; i++)
        if (i == 0 || cabs(values[i] - exact) < cabs(nearest - exact)) nearest = values[i];
    return (scheme_motion){cabs(nearest), carg(nearest), cabs(nearest - exact)};
}

/* ---- ranges of stable steps ------------------------------------------------------------------ */

static const double ROUNDING = 1e-10, SMALL_STEP = 0.05, LARGEST_STEP = 100, STRIDE = 1.01;

static bool is_stable(clast_scheme which, double step, double damping) {
    return scheme_growth(which, step, damping) <= 1 + ROUNDING;
}

/* Where the answer changes between two steps, low on the side of `at_low`. */
static double change_between(clast_scheme which, double damping, double low, double high,
                             bool at_low) {
    while (high - low > 1e-10 * high) {
        double middle = 0.5 * (low + high);
        if (is_stable(which, middle, damping) == at_low)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

int scheme_ranges(clast_scheme which, double damping, scheme_range ranges[SCHEME_RANGES_MAX]) {
    CLAST_ASSERT(damping == 0 || damping >= 1e-4);
    double step = damping > 0 ? fmin(SMALL_STEP, damping) : SMALL_STEP;
    bool stable = damping > 0 || is_stable(which, step, damping);
    int count = 0;
    double from = 0;
    for (double next = step * STRIDE; step < LARGEST_STEP; step = next, next *= STRIDE) {
        bool then = is_stable(which, next, damping);
        if (then == stable) continue;
        double change = change_between(which, damping, step, next, stable);
        if (stable) {
            CLAST_ASSERT(count < SCHEME_RANGES_MAX);
            ranges[count++] = (scheme_range){from, change};
        }
        from = change, stable = then;
    }
    if (stable && count < SCHEME_RANGES_MAX) ranges[count++] = (scheme_range){from, INFINITY};
    return count;
}

double scheme_limit(clast_scheme which, double damping) {
    scheme_range ranges[SCHEME_RANGES_MAX];
    int count = scheme_ranges(which, damping, ranges);
    return count > 0 && ranges[0].from == 0 ? ranges[0].to : 0;
}

double scheme_steps_to_grow(clast_scheme which, double step, double damping, double ratio) {
    CLAST_ASSERT(ratio > 1);
    double growth = scheme_growth(which, step, damping);
    return growth > 1 + ROUNDING ? log(ratio) / log(growth) : INFINITY;
}

/* ---- running the map ------------------------------------------------------------------------- */

void scheme_start(clast_scheme which, double step, double damping, double x, double v,
                  double state[SCHEME_SIZE_MAX]) {
    CLAST_ASSERT(damping >= 0 && damping < 1 && step > 0);
    double w = sqrt(1 - damping * damping), rate = v / step; /* per unit of w0 t */
    for (int level = 0; level < scheme_of(which)->levels; level++) {
        double t = -level * step, decay = exp(-damping * t), c = cos(w * t), s = sin(w * t);
        double *at = state + QUANTITIES * level, slope = (rate + damping * x) / w;
        at[POSITION] = decay * (x * c + slope * s);
        double speed = decay * (rate * c - (x + damping * rate) / w * s);
        at[VELOCITY] = step * speed;
        at[ELASTIC] = -step * step * at[POSITION];
        at[DASHPOT] = -2 * damping * step * at[VELOCITY];
    }
}

void scheme_advance(clast_scheme which, const double *matrix, double state[SCHEME_SIZE_MAX]) {
    double next[SCHEME_SIZE_MAX] = {0};
    int size = scheme_size(which);
    for (int i = 0; i < size; i++)
        for (int j = 0; j < size; j++) next[i] += matrix[i * size + j] * state[j];
    memcpy(state, next, sizeof next);
}
