#include "shapes/clump.h"

#include <stdlib.h>
#include <string.h>

#include "shapes/check.h"

shape_clump shape_clump_of(const shape_sphere *spheres, int count, const shape_mass *solid,
                           shape_mass_from from) {
    SHAPE_ASSERT(spheres && count >= 1 && (solid || from == SHAPE_MASS_UNION));
    shape_clump c = {.count = count, .as_union = shape_union_mass(spheres, count)};
    if (solid) c.as_solid = *solid;
    const shape_mass *used = from == SHAPE_MASS_SOLID ? &c.as_solid : &c.as_union;
    c.sphere = malloc((size_t)count * sizeof *c.sphere);
    SHAPE_ASSERT(c.sphere);
    memcpy(c.sphere, spheres, (size_t)count * sizeof *c.sphere);
    c.origin = used->centre;
    c.frame = shape_principal(used);
    c.volume = used->volume;
    shape_to_frame(&c.frame, c.origin, c.sphere, count);
    return c;
}

void shape_clump_free(shape_clump *clump) {
    free(clump->sphere);
    *clump = (shape_clump){0};
}
