/* periodic_lanes.h - ways to the nearest image, for the columns of a batch. Not inline: copied with
 * everything that a scene may need they would double the kernels for a few instructions of a
 * thousand. */
#ifndef CLAST_PERIODIC_LANES_H
#define CLAST_PERIODIC_LANES_H

#include "engine/contact_law.h"
#include "engine/periodic.h"

static __attribute__((noinline)) void take_nearest(const period *p, batch *b, int count) {
    for (int k = 0; k < 3; k++) {
        if (p->length[k] == 0) continue;
        double *d = b->d[k], length = p->length[k], half = p->half[k];
#pragma omp simd
        for (int i = 0; i < count; i++) d[i] = nearest_along(d[i], length, half);
    }
}

/* Spheres in their images at the walls, with the bits that geometry.h makes of them. */
static __attribute__((noinline)) void take_images(const clast_world *w, const contact_list *l,
                                                  size_t begin, batch *b, int count) {
    for (int i = 0; i < count; i++) {
        int32_t met = l->b[begin + (size_t)i];
        vec3 centre = from_kernel(w, centre_at(&w->rows.centre[l->a[begin + (size_t)i]]));
        const double *point = w->wall_rows[met].point;
        vec3 image = to_kernel(w, image_at_wall(w, &w->walls[met], centre));
        b->d[0][i] = image.x - point[0];
        b->d[1][i] = image.y - point[1];
        b->d[2][i] = image.z - point[2];
    }
}

#endif
