/* sum.h - sums that do not depend on their order.
 *
 * A term is rounded to a multiple of a coarse quantum, the rest to a multiple of a fine one. Sums
 * of multiples of one quantum are exact in double as long as they stay below 2^53 quanta, and exact
 * sums have no order: threads, blocks and (later) processes may add in any way and get the same
 * bits. With quanta of 2^-38 and 2^-66 of the scene's energy scale, 32 thousand scales fit into the
 * coarse bin and one scale is resolved to 10^-20. A term leaves at most half a coarse quantum for
 * the fine bin, which so takes 67 million terms of one sign. Rejected: 2^-30 and 2^-70 (full after
 * 16 thousand terms of one sign, and losses have one sign), 128-bit fixed point (a libgcc call per
 * term), sums in list order (the list is not observable, so its order must not be either). */
#ifndef CLAST_SUM_H
#define CLAST_SUM_H

typedef struct sum_scale {
    double coarse, fine; /* 1.5 * 2^52 quanta: adding and subtracting it rounds to the quantum */
} sum_scale;

typedef struct exact_sum {
    double coarse, fine;
} exact_sum;

/* `scale` is any power of two not below the size of the largest total expected. */
static inline sum_scale sum_scale_for(double scale) {
    const double magic = 6755399441055744.0; /* 1.5 * 2^52 */
    return (sum_scale){magic * (scale * 0x1p-38), magic * (scale * 0x1p-66)};
}

static inline void sum_add(exact_sum *s, const sum_scale *scale, double term) {
    double coarse = (term + scale->coarse) - scale->coarse;
    double rest = term - coarse;
    s->coarse += coarse;
    s->fine += (rest + scale->fine) - scale->fine;
}

static inline void sum_merge(exact_sum *into, const exact_sum *from) {
    into->coarse += from->coarse;
    into->fine += from->fine;
}

static inline double sum_value(const exact_sum *s) {
    return s->coarse + s->fine;
}

#endif
