/* paired.h - is the difference of two settings within a tolerance? Runs with the same seeds are
 * compared pair by pair, at most TUNE_LOOKS times with more and more seeds.
 *
 * Looking repeatedly gives chance more chances, so every look asks for confidence
 * 1 - 0.05 / looks (Bonferroni): all looks together miss the true difference in at most 5 %. */
#ifndef CLAST_TUNE_PAIRED_H
#define CLAST_TUNE_PAIRED_H

enum { TUNE_LOOKS = 3 };

/* Differences in units of the reference's mean, whose own error is left out: it changes the
 * difference by the difference times that error. */
typedef struct paired {
    double reference;  /* mean of the reference over the pairs */
    double difference; /* mean of (candidate - reference) / |reference| */
    double half;       /* half width of its interval at confidence 1 - alpha, Student */
    int n;             /* pairs in which the reference has a value */
    int lost;          /* pairs in which only the reference has one */
} paired;

typedef enum paired_answer { PAIRED_WITHIN, PAIRED_OUTSIDE, PAIRED_OPEN } paired_answer;

/* Values that are not finite are missing. With n < 2 or a reference of mean zero the difference is
 * NAN. 0 < alpha < 1. */
paired paired_compare(const double *reference, const double *candidate, int n, double alpha);

/* Within: the whole interval lies in [-tolerance, tolerance]; outside: none of it does. A candidate
 * without a value where the reference has one is outside. tolerance > 0, relative. */
paired_answer paired_judge(const paired *p, double tolerance);

/* Pairs at look 0, 1, ...: `first` doubled each time, `most` at last. Returns the number of looks,
 * 1 to TUNE_LOOKS. 1 <= first <= most. */
int paired_looks(int first, int most, int pairs[TUNE_LOOKS]);

#endif
