/* lanes.h - between rows and columns, and between doubles and 64-bit integers, in forms that turn
 * into vector code on every x86-64. */
#ifndef CLAST_LANES_H
#define CLAST_LANES_H

#include <stdint.h>
#include <string.h>

#define LANE_INLINE __attribute__((always_inline)) static inline

LANE_INLINE int64_t bits_of(double x) {
    int64_t i;
    memcpy(&i, &x, sizeof i);
    return i;
}

LANE_INLINE double double_of(int64_t i) {
    double x;
    memcpy(&x, &i, sizeof x);
    return x;
}

/* Nearest integer of |x| < 2^62, ties to even, in two parts: adding 1.5 * 2^84 leaves x / 2^32 in
 * the low bits. (An instruction for it came with AVX-512.) */
LANE_INLINE int64_t nearest(double x) {
    double high = x + 0x1.8p84, rest = x - (high - 0x1.8p84);
    return (int64_t)(((uint64_t)bits_of(high) << 32) + (uint64_t)bits_of(rest + 0x1.8p52) -
                     (uint64_t)bits_of(0x1.8p52));
}

/* (double)i, rounded once. */
LANE_INLINE double double_from(int64_t i) {
    double high = double_of((int64_t)((uint64_t)i >> 32) ^ bits_of(0x1p84 + 0x1p63));
    double low = double_of((i & 0xffffffff) | bits_of(0x1p52));
    return (high - (0x1p84 + 0x1p63 + 0x1p52)) + low;
}

/* Four numbers side by side: a row of 32 bytes, or four lanes of a column. Without AVX they only
 * cost (four times the scalar code): then LANE_ROWS is not defined. */
#ifdef __AVX__
#define LANE_ROWS
typedef double rows4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef int64_t whole4 __attribute__((vector_size(32), aligned(8), may_alias));

/* c[k] becomes the k-th numbers of r[0] .. r[3]. */
#define TRANSPOSE4(type, r, c)                                                                     \
    do {                                                                                           \
        type even01 = __builtin_shufflevector((r)[0], (r)[1], 0, 4, 2, 6),                         \
             odd01 = __builtin_shufflevector((r)[0], (r)[1], 1, 5, 3, 7),                          \
             even23 = __builtin_shufflevector((r)[2], (r)[3], 0, 4, 2, 6),                         \
             odd23 = __builtin_shufflevector((r)[2], (r)[3], 1, 5, 3, 7);                          \
        (c)[0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);                              \
        (c)[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);                                \
        (c)[2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);                              \
        (c)[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);                                \
    } while (0)
#endif

#endif
