/* fnv.h - FNV-1a of bytes: names for what has been seen before, no protection. */
#ifndef CLAST_FNV_H
#define CLAST_FNV_H

#include <stdint.h>
#include <stdio.h>

#define FNV_START UINT64_C(0xcbf29ce484222325)

static inline uint64_t fnv_bytes(uint64_t hash, const void *bytes, size_t count) {
    const unsigned char *b = bytes;
    for (size_t i = 0; i < count; i++) hash = (hash ^ b[i]) * UINT64_C(0x100000001b3);
    return hash;
}

/* All of a file; false when it cannot be opened. */
static inline _Bool fnv_file(uint64_t *hash, const char *path) {
    FILE *f = fopen(path, "rb");
    if (!f) return 0;
    char buffer[4096];
    for (size_t n; (n = fread(buffer, 1, sizeof buffer, f)) > 0;)
        *hash = fnv_bytes(*hash, buffer, n);
    fclose(f);
    return 1;
}

#endif
