/* rows.c - room and fixed entries of the rows; called when the list of bodies or their order has
 * changed. */
#include "engine/rows.h"
#include "engine/world.h"

static size_t count_spheres(const clast_world *w, size_t from, size_t to) {
    size_t count = 0;
    for (size_t i = from; i < to; i++) count += (size_t)w->shapes[w->bodies.shape[i]].spheres;
    return count;
}

static void reserve_bodies(clast_world *w) {
    row_store *r = &w->rows;
    size_t need = w->bodies.count + w->ghosts, old = r->bodies;
    if (need <= old && r->motion) return;
    r->motion = memory_lines(w, r->motion, old * sizeof *r->motion, need * sizeof *r->motion);
    r->loads = memory_lines(w, r->loads, old * sizeof *r->loads, need * sizeof *r->loads);
    if (w->special.clumps)
        r->first = memory_grow(w, r->first, old ? old + 1 : 0, need + 1, sizeof *r->first);
    if (w->special.shared)
        r->inertia =
            memory_lines(w, r->inertia, old * sizeof *r->inertia, need * sizeof *r->inertia);
    r->bodies = need;
}

static void reserve_spheres(clast_world *w) {
    row_store *r = &w->rows;
    size_t need = w->sphere_count + w->ghost_spheres, old = r->spheres;
    if (need <= old) return;
    r->centre = memory_lines(w, r->centre, old * sizeof *r->centre, need * sizeof *r->centre);
    if (w->special.clumps) {
        r->arm = memory_lines(w, r->arm, old * sizeof *r->arm, need * sizeof *r->arm);
    }
    r->spheres = need;
}

/* Lays spheres out in the order of their bodies, ghosts behind the own ones. (In a plane the
 * inverse moment about its axis is the only one that counts, and stays.) */
void rows_layout(clast_world *w) {
    size_t own = w->bodies.count, all = own + w->ghosts;
    w->sphere_count = count_spheres(w, 0, own);
    w->ghost_spheres = count_spheres(w, own, all);
    reserve_bodies(w);
    reserve_spheres(w);
    row_store *r = &w->rows;
    size_t place = 0;
    for (size_t i = 0; i < all; i++) {
        const shape *s = &w->shapes[w->bodies.shape[i]];
        r->motion[i].mass = s->mass;
        r->motion[i].material = s->material;
        if (w->special.clumps) r->first[i] = (uint32_t)place;
        if (w->special.shared) r->inertia[i].zz = to_kernel(w, s->inverse_inertia).z;
        for (int k = 0; k < s->spheres; k++, place++) {
            r->centre[place].radius = s->radius[k];
            if (w->special.clumps) r->arm[place].body = (int64_t)i;
        }
    }
    if (w->special.clumps) r->first[all] = (uint32_t)place;
}

/* Everything that moves, from the columns. */
void rows_fill(clast_world *w, size_t body_begin, size_t body_end) {
    kernel_columns c = columns_of(w);
    for (size_t i = body_begin; i < body_end; i++) {
        vec3 spin = to_kernel(w, body_spin(w, i));
        motion_row *m = &w->rows.motion[i];
        for (int k = 0; k < 3; k++) m->v[k] = c.v[k][i];
        m->w[0] = spin.x, m->w[1] = spin.y, m->w[2] = spin.z;
    }
    place_spheres(w, &c, body_begin, body_end);
}
