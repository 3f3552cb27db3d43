/* Prints the hash of a short run of the bed, for tests that start it under other conditions: with
 * glibc's variants for FMA and AVX2 masked, as hash_program <baseline|avx2|avx512>. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/support/bed.h"

/* The bits of libm's own results: differs where another variant of it is at work. */
static unsigned long long libm_fingerprint(void) {
    unsigned long long hash = 0;
    for (int i = 1; i < 400000; i++) {
        double x = 0.0137 * i, values[4] = {sin(x), exp(-x / 300), pow(x, 0.21), cos(x)};
        for (int k = 0; k < 4; k++) {
            unsigned long long bits;
            memcpy(&bits, &values[k], sizeof bits);
            hash = (hash ^ bits) * 0x100000001b3u;
        }
    }
    return hash;
}

int main(int count, char **words) {
    bed_wish wish = {.threads = 1, .law = CLAST_LAW_HERTZ_A00, .bodies = 40};
    if (count > 1 && strcmp(words[1], "baseline") == 0) wish.isa = CLAST_ISA_BASELINE;
    if (count > 1 && strcmp(words[1], "avx2") == 0) wish.isa = CLAST_ISA_AVX2;
    printf("hash 0x%016llx\n", (unsigned long long)bed_hash(&wish, 900));
    if (count > 2) printf("libm 0x%016llx\n", libm_fingerprint());
    return 0;
}
