#include "tests/counts/marks.h"

#include "tests/counts/grains.h"

void counted_steps(clast_world *w, uint64_t count) {
    grains_steps(w, count);
}

static volatile int ends;

void counted_end(void) {
    ends = ends + 1; /* something to do, or the call would go */
}
