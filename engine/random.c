/* Philox 4x32-10 (Salmon et al., SC11): a keyed counter, so that any number can be had at any time
 * by any thread and a restart needs no generator state. */
#include <stdint.h>

#include "engine/numbers.h"
#include "engine/vec.h"

static void philox_round(uint32_t c[4], uint32_t k0, uint32_t k1) {
    uint64_t a = (uint64_t)0xD2511F53u * c[0], b = (uint64_t)0xCD9E8D57u * c[2];
    uint32_t next[4] = {(uint32_t)(b >> 32) ^ c[1] ^ k0, (uint32_t)b,
                        (uint32_t)(a >> 32) ^ c[3] ^ k1, (uint32_t)a};
    for (int i = 0; i < 4; i++) c[i] = next[i];
}

double clast_random(uint64_t seed, uint64_t stream, uint64_t counter) {
    uint32_t c[4] = {(uint32_t)counter, (uint32_t)(counter >> 32), (uint32_t)stream,
                     (uint32_t)(stream >> 32)};
    uint32_t k0 = (uint32_t)seed, k1 = (uint32_t)(seed >> 32);
    for (int round = 0; round < 10; round++) {
        philox_round(c, k0, k1);
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
    uint64_t bits = ((uint64_t)c[0] << 32 | c[1]) >> 11;
    return (double)bits * 0x1p-53;
}

/* K. Shoemake, Uniform random rotations, Graphics Gems III, 1992. */
clast_quat clast_quat_uniform(double u, double v, double w) {
    double low = sqrt(1 - u), high = sqrt(u), sv, cv, sw, cw;
    clast_sincos(2 * NUMBER_PI * v, &sv, &cv);
    clast_sincos(2 * NUMBER_PI * w, &sw, &cw);
    return (clast_quat){high * cw, low * sv, low * cv, high * sw};
}
