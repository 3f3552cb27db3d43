/* sparse.c - compressed rows of 3 x 3 blocks. Everything is summed in the order of rows, by one
 * thread: the bits are a function of the matrix. */
#include "engine/sparse.h"

#include <string.h>

enum { ITERATIONS_MAX = 1000 };

/* ---- layout ---------------------------------------------------------------------------------- */

void sparse_reserve(clast_world *w, sparse_matrix *m, size_t rows, size_t pairs) {
    bool grows = rows > m->row_room || pairs > m->pair_room;
    if (!grows && m->first) return;
    size_t old_rows = m->row_room, old_pairs = m->pair_room, old_blocks = old_rows + 2 * old_pairs;
    size_t now_rows = rows > old_rows ? rows : old_rows;
    size_t now_pairs = pairs > old_pairs ? pairs + pairs / 4 : old_pairs;
    size_t blocks = now_rows + 2 * now_pairs;
    m->first =
        memory_grow(w, m->first, m->first ? old_rows + 1 : 0, now_rows + 1, sizeof *m->first);
    m->diagonal = memory_grow(w, m->diagonal, old_rows, now_rows, sizeof *m->diagonal);
    m->column = memory_grow(w, m->column, old_blocks, blocks, sizeof *m->column);
    m->block = memory_grow(w, m->block, 9 * old_blocks, 9 * blocks, sizeof *m->block);
    m->pair = memory_grow(w, m->pair, old_pairs, now_pairs, sizeof *m->pair);
    m->row_room = now_rows, m->pair_room = now_pairs;
}

static size_t put(sparse_matrix *m, size_t *next, uint32_t row, uint32_t column) {
    m->column[next[row]] = column;
    return next[row]++;
}

/* Sorted pairs come to a row first as its lower neighbours, then as its upper ones. */
void sparse_lay_out(sparse_matrix *m, size_t rows, size_t pairs) {
    CLAST_ASSERT(rows <= m->row_room && pairs <= m->pair_room);
    m->rows = rows;
    size_t *first = m->first, *next = m->diagonal;
    memset(first, 0, (rows + 1) * sizeof *first);
    for (size_t k = 0; k < pairs; k++) first[m->pair[k].a + 1]++, first[m->pair[k].b + 1]++;
    for (size_t r = 0; r < rows; r++) first[r + 1] += first[r] + 1, next[r] = first[r];
    for (size_t k = 0; k < pairs; k++) m->pair[k].lower = put(m, next, m->pair[k].b, m->pair[k].a);
    for (uint32_t r = 0; r < rows; r++) put(m, next, r, r);
    for (size_t k = 0; k < pairs; k++) m->pair[k].upper = put(m, next, m->pair[k].a, m->pair[k].b);
    for (size_t r = 0; r < rows; r++) {
        size_t at = first[r];
        while (m->column[at] != r) at++;
        m->diagonal[r] = at;
    }
    memset(m->block, 0, 9 * first[rows] * sizeof *m->block);
}

void sparse_free(sparse_matrix *m) {
    memory_release(m->first), memory_release(m->diagonal), memory_release(m->column);
    memory_release(m->block), memory_release(m->pair);
}

/* ---- products -------------------------------------------------------------------------------- */

/* to += block x */
static void add_product(const double *block, const double *x, double *to) {
    for (int i = 0; i < 3; i++)
        to[i] += block[3 * i] * x[0] + block[3 * i + 1] * x[1] + block[3 * i + 2] * x[2];
}

void sparse_apply(const sparse_matrix *m, const double *x, double *to) {
    for (size_t r = 0; r < m->rows; r++) {
        double sum[3] = {0, 0, 0};
        for (size_t k = m->first[r]; k < m->first[r + 1]; k++)
            add_product(m->block + 9 * k, x + 3 * (size_t)m->column[k], sum);
        memcpy(to + 3 * r, sum, sizeof sum);
    }
}

static double dot(const double *a, const double *b, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += a[i] * b[i];
    return sum;
}

static double largest(const double *a, size_t count) {
    double most = 0;
    for (size_t i = 0; i < count; i++) most = fabs(a[i]) > most ? fabs(a[i]) : most;
    return most;
}

/* ---- Gauss and Seidel ------------------------------------------------------------------------ */

/* Returns the largest change of a component. */
static double relax_row(const sparse_matrix *m, size_t row, const double *right, double *x) {
    double sum[3] = {0, 0, 0}, most = 0;
    const double *d = sparse_diagonal(m, row);
    for (size_t k = m->first[row]; k < m->first[row + 1]; k++)
        if (k != m->diagonal[row]) add_product(m->block + 9 * k, x + 3 * (size_t)m->column[k], sum);
    double *own = x + 3 * row;
    for (int i = 0; i < 3; i++) {
        double rest = right[3 * row + (size_t)i] - sum[i];
        for (int j = 0; j < 3; j++)
            if (j != i) rest -= d[3 * i + j] * own[j];
        double now = rest / d[4 * i];
        most = fmax(most, fabs(now - own[i]));
        own[i] = now;
    }
    return most;
}

uint64_t sparse_gauss_seidel(const sparse_matrix *m, const double *right, double *x,
                             double *scratch, double tolerance) {
    (void)scratch;
    uint64_t n = 0;
    double change = INFINITY;
    while (n < ITERATIONS_MAX && change > fmax(tolerance, 1e-12 * largest(x, 3 * m->rows))) {
        change = 0;
        for (size_t r = 0; r < m->rows; r++) change = fmax(change, relax_row(m, r, right, x));
        n++;
    }
    return n;
}

/* ---- conjugate gradients --------------------------------------------------------------------- */

/* Of a symmetric block, by its adjugate. */
static void invert(const double *a, double *to) {
    double c00 = a[4] * a[8] - a[5] * a[5], c01 = a[5] * a[2] - a[1] * a[8],
           c02 = a[1] * a[5] - a[4] * a[2];
    double inverse = 1 / (a[0] * c00 + a[1] * c01 + a[2] * c02);
    to[0] = inverse * c00;
    to[1] = to[3] = inverse * c01;
    to[2] = to[6] = inverse * c02;
    to[4] = inverse * (a[0] * a[8] - a[2] * a[2]);
    to[5] = to[7] = inverse * (a[1] * a[2] - a[0] * a[5]);
    to[8] = inverse * (a[0] * a[4] - a[1] * a[1]);
}

void sparse_answer_alone(const sparse_matrix *m, size_t row, const double *right, double *x) {
    double inverse[9];
    invert(sparse_diagonal(m, row), inverse);
    x[0] = x[1] = x[2] = 0;
    add_product(inverse, right, x);
}

static void precondition(const double *inverse, const double *r, double *z, size_t rows) {
    memset(z, 0, 3 * rows * sizeof *z);
    for (size_t k = 0; k < rows; k++) add_product(inverse + 9 * k, r + 3 * k, z + 3 * k);
}

/* Residual of x. */
static void begin_gradient(const sparse_matrix *m, const double *right, const double *x,
                           double *inverse, double *r) {
    sparse_apply(m, x, r);
    for (size_t i = 0; i < 3 * m->rows; i++) r[i] = right[i] - r[i];
    for (size_t k = 0; k < m->rows; k++) invert(sparse_diagonal(m, k), inverse + 9 * k);
}

uint64_t sparse_conjugate_gradient(const sparse_matrix *m, const double *right, double *x,
                                   double *scratch, double tolerance) {
    size_t size = 3 * m->rows;
    double *inverse = scratch, *r = inverse + 3 * size, *z = r + size, *p = z + size,
           *ap = p + size;
    begin_gradient(m, right, x, inverse, r);
    precondition(inverse, r, z, m->rows);
    memcpy(p, z, size * sizeof *p);
    double rz = dot(r, z, size);
    uint64_t n = 0;
    while (n < ITERATIONS_MAX && rz > 0) {
        sparse_apply(m, p, ap);
        double curvature = dot(p, ap, size);
        if (!(curvature > 0)) break; /* not positive definite here: what there is must do */
        double step = rz / curvature;
        for (size_t i = 0; i < size; i++) x[i] += step * p[i], r[i] -= step * ap[i];
        n++;
        precondition(inverse, r, z, m->rows);
        if (largest(z, size) <= fmax(tolerance, 1e-12 * largest(x, size))) break;
        double now = dot(r, z, size), more = now / rz;
        for (size_t i = 0; i < size; i++) p[i] = z[i] + more * p[i];
        rz = now;
    }
    return n;
}
