/* sparse.h - a symmetric matrix of 3 x 3 blocks in compressed rows, and two ways to solve with it.
 */
#ifndef CLAST_SPARSE_H
#define CLAST_SPARSE_H

#include "engine/world.h"

/* Two rows that meet off the diagonal. */
typedef struct sparse_pair {
    uint32_t a, b;       /* a < b */
    size_t upper, lower; /* places of the blocks (a, b) and (b, a) */
} sparse_pair;

typedef struct sparse_matrix {
    size_t rows, row_room, pair_room;
    size_t *first;    /* per row and one more: its first block */
    size_t *diagonal; /* per row */
    uint32_t *column; /* per block, rising within a row */
    double *block;    /* nine per block, by rows */
    sparse_pair *pair;
} sparse_matrix;

/* Room for so many rows and pairs; pairs are to be filled in, sorted by (a, b), each once. */
void sparse_reserve(clast_world *w, sparse_matrix *m, size_t rows, size_t pairs);

/* Zero blocks where the pairs say, and on the diagonal. */
void sparse_lay_out(sparse_matrix *m, size_t rows, size_t pairs);

static inline double *sparse_diagonal(const sparse_matrix *m, size_t row) {
    return m->block + 9 * m->diagonal[row];
}

/* What x of a row alone answers `right`, where all others are zero: three numbers each. */
void sparse_answer_alone(const sparse_matrix *m, size_t row, const double *right, double *x);

void sparse_free(sparse_matrix *m);

/* to = m x; three numbers per row. */
void sparse_apply(const sparse_matrix *m, const double *x, double *to);

/* Numbers of scratch that a solver needs per row. */
enum { SPARSE_SCRATCH = 21 };

/* Solves m x = right from the x given, until no component of x changes by more than `tolerance` in
 * an iteration, or not by more than 1e-12 of the largest; the diagonal blocks must be positive
 * definite. Returns the iterations; a thousand are the most. */
typedef uint64_t sparse_solver(const sparse_matrix *m, const double *right, double *x,
                               double *scratch, double tolerance);

/* Row by row, as S12 3.8.3. */
sparse_solver sparse_gauss_seidel;

/* Conjugate gradients, preconditioned with the inverse blocks of the diagonal. */
sparse_solver sparse_conjugate_gradient;

#endif
