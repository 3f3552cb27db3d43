#include "experiments/aspect-ratio-hopper/aspect.h"
int aspect_pictures(const aspect_study *s) {
    (void)s;
    return 0;
}
