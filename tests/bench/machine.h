/* machine.h - what the numbers were measured on. */
#ifndef CLAST_BENCH_MACHINE_H
#define CLAST_BENCH_MACHINE_H

#include <stdbool.h>

/* OUT/bench-machine.csv: processor, cores, sizes of the caches (0: unknown). */
void bench_machine_write(const char *out);

#endif
