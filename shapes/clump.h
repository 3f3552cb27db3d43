/* clump.h - spheres and mass properties of a clump in the frame that the engine wants: origin at
 * the centre of mass, axes principal. */
#ifndef CLAST_SHAPES_CLUMP_H
#define CLAST_SHAPES_CLUMP_H

#include "shapes/fill.h"
#include "shapes/mass.h"

typedef enum shape_mass_from { SHAPE_MASS_UNION, SHAPE_MASS_SOLID } shape_mass_from;

typedef struct shape_clump {
    int count;
    shape_sphere *sphere; /* malloc'ed, in the frame of the body */
    shape_mass as_union;  /* in the frame of the target, as `as_solid` */
    shape_mass as_solid;  /* volume 0 without a target */
    shape_vec origin;     /* m, of the body's frame, in that of the target */
    shape_frame frame;    /* with the principal moments of density 1 */
    double volume;        /* m3: of the one chosen, as origin and frame */
} shape_clump;

/* From spheres in the frame of the target. `solid` may be NULL: mass of the union. */
shape_clump shape_clump_of(const shape_sphere *spheres, int count, const shape_mass *solid,
                           shape_mass_from from);
void shape_clump_free(shape_clump *clump);

#endif
