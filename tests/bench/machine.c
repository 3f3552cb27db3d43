/* machine.c - what the numbers were measured on. */
#include "tests/bench/machine.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The first line of /proc/cpuinfo that begins with "model name", without what is before the colon.
 */
static void processor(char *name, size_t room) {
    snprintf(name, room, "unknown");
    FILE *f = fopen("/proc/cpuinfo", "r");
    char line[512];
    while (f && fgets(line, sizeof line, f)) {
        if (strncmp(line, "model name", 10) != 0 || !strchr(line, ':')) continue;
        snprintf(name, room, "%s", strchr(line, ':') + 2);
        name[strcspn(name, "\n")] = '\0';
        for (char *c = name; *c; c++)
            if (*c == ',') *c = ' ';
        break;
    }
    if (f) fclose(f);
}

static bool read_word(int index, const char *what, char *word, size_t room) {
    char path[128];
    snprintf(path, sizeof path, "/sys/devices/system/cpu/cpu0/cache/index%d/%s", index, what);
    FILE *f = fopen(path, "r");
    if (!f) return false;
    bool read = fgets(word, (int)room, f) != NULL;
    fclose(f);
    word[strcspn(word, "\n")] = '\0';
    return read;
}

/* Bytes of the data cache of a level as cpu0 sees it; 0 when unknown. */
static long cache_bytes(int level) {
    for (int i = 0; i < 8; i++) {
        char type[32], number[32], size[32];
        long amount;
        if (!read_word(i, "type", type, sizeof type)) break;
        if (!read_word(i, "level", number, sizeof number)) continue;
        if (!read_word(i, "size", size, sizeof size)) continue;
        if (strcmp(type, "Instruction") == 0 || number[0] != '0' + level) continue;
        if (sscanf(size, "%ldK", &amount) == 1) return 1024 * amount;
    }
    static const int NAMES[] = {_SC_LEVEL1_DCACHE_SIZE, _SC_LEVEL2_CACHE_SIZE,
                                _SC_LEVEL3_CACHE_SIZE};
    long known = sysconf(NAMES[level - 1]);
    return known > 0 ? known : 0;
}

void bench_machine_write(const char *out) {
    char path[4096], name[256];
    snprintf(path, sizeof path, "%s/bench-machine.csv", out);
    FILE *f = fopen(path, "w");
    if (!f) return;
    processor(name, sizeof name);
    fprintf(f, "key,value\nprocessor,%s\ncores,%ld\nl1d_bytes,%ld\nl2_bytes,%ld\nl3_bytes,%ld\n",
            name, sysconf(_SC_NPROCESSORS_ONLN), cache_bytes(1), cache_bytes(2), cache_bytes(3));
    fclose(f);
}
