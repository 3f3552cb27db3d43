/* view.c - reading a world. Nothing here changes its state. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/part.h"
#include "engine/ranks.h"
#include "engine/world.h"

double clast_world_time(const clast_world *w) {
    return (double)w->step * w->dt;
}
double clast_world_time_step(const clast_world *w) {
    return w->dt;
}
uint64_t clast_world_steps(const clast_world *w) {
    return w->step;
}

clast_bodies clast_world_bodies(clast_world *w) {
    CLAST_ASSERT(w);
    velocities_synchronise(w);
    const body_store *b = &w->bodies;
    clast_bodies own = {.count = b->count,
                        .id = b->id,
                        .shape = b->shape,
                        .x = b->x,
                        .y = b->y,
                        .z = b->z,
                        .qw = b->qw,
                        .qx = b->qx,
                        .qy = b->qy,
                        .qz = b->qz,
                        .vx = w->view.vx,
                        .vy = w->view.vy,
                        .vz = w->view.vz,
                        .wx = w->view.wx,
                        .wy = w->view.wy,
                        .wz = w->view.wz,
                        .mass = w->view.mass,
                        .image = {b->image[0], b->image[1], b->image[2]}};
    return ranks_bodies(w, own);
}

uint32_t *bodies_by_id(const clast_world *w, const clast_bodies *b) {
    uint32_t *place = malloc((w->next_id + b->count + 1) * sizeof *place);
    CLAST_ASSERT(place);
    uint32_t *order = place + w->next_id; /* of the same piece, and moved to its front */
    size_t n = 0;
    for (uint32_t id = 0; id < w->next_id; id++) place[id] = UINT32_MAX;
    for (size_t i = 0; i < b->count; i++) place[b->id[i]] = (uint32_t)i;
    for (uint32_t id = 0; id < w->next_id; id++)
        if (place[id] != UINT32_MAX) order[n++] = place[id];
    CLAST_ASSERT(n == b->count);
    memmove(place, order, n * sizeof *place);
    return place;
}

static void reserve_spheres(clast_world *w) {
    size_t old = w->view.sphere_capacity, now = w->sphere_count;
    if (old >= now) return;
    double **columns[] = {&w->view.sx, &w->view.sy, &w->view.sz, &w->view.radius};
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        *columns[i] = memory_grow(w, *columns[i], old, now, sizeof(double));
    w->view.body = memory_grow(w, w->view.body, old, now, sizeof *w->view.body);
    w->view.sphere_capacity = now;
}

clast_spheres clast_world_spheres(clast_world *w) {
    CLAST_ASSERT(w && w->prepared);
    reserve_spheres(w);
    for (size_t i = 0; i < w->sphere_count; i++) {
        const centre_row *c = &w->rows.centre[i];
        vec3 p = from_kernel(w, centre_at(c));
        w->view.sx[i] = p.x, w->view.sy[i] = p.y, w->view.sz[i] = p.z;
        w->view.radius[i] = c->radius;
        w->view.body[i] = (int32_t)body_of_sphere(w, i);
    }
    clast_spheres own = {w->sphere_count, w->view.sx,     w->view.sy,
                         w->view.sz,      w->view.radius, w->view.body};
    return ranks_spheres(w, own);
}

size_t clast_world_contacts(clast_world *w, clast_contact *contacts, size_t room) {
    CLAST_ASSERT(w && w->prepared && (contacts || room == 0));
    contact_reading *readings;
    size_t count = contacts_read(w, &readings);
    for (size_t i = 0; i < count && i < room; i++) {
        const contact_reading *r = &readings[i];
        contacts[i] = (clast_contact){r->record.a,
                                      r->record.b,
                                      r->record.sphere_a,
                                      r->record.sphere_b,
                                      r->record.history.overlap,
                                      r->point,
                                      r->force,
                                      r->record.history.normal};
    }
    free(readings);
    return count;
}

/* W, with the velocities at the time of the positions. */
static double power_of(const clast_world *w, const part *p) {
    part_place now = part_at(p, clast_world_time(w));
    return v3_dot(from_kernel(w, p->push.force), now.velocity) + p->push.moment * now.spin +
           p->push.belt;
}

clast_part_load clast_world_part_load(clast_world *w, int index) {
    CLAST_ASSERT(w && w->prepared && index >= 0 && index < w->part_count);
    const part *p = &w->parts[index];
    clast_part_load load = {.about = p->turns ? part_pivot(p) : v3(0, 0, 0),
                            .power = power_of(w, p),
                            .work = p->work_total};
    contact_reading *readings;
    size_t count = contacts_read(w, &readings);
    for (size_t i = 0; i < count; i++) {
        const contact_reading *r = &readings[i];
        if (r->record.b < CLAST_WALL_ID || w->walls[r->record.b - CLAST_WALL_ID].part != index)
            continue;
        vec3 on_part = v3_scale(-1, r->force);
        load.force = v3_add(load.force, on_part);
        vec3 at = image_at_wall(w, &w->walls[r->record.b - CLAST_WALL_ID], r->point);
        load.torque = v3_add(load.torque, v3_cross(v3_sub(at, load.about), on_part));
    }
    free(readings);
    return load;
}

int clast_world_shape_count(const clast_world *w) {
    return w->shape_count;
}
int clast_world_part_count(const clast_world *w) {
    return w->part_count;
}
int clast_world_wall_count(const clast_world *w) {
    return w->wall_count;
}
int clast_world_material_count(const clast_world *w) {
    return w->material_count;
}

clast_shape_def clast_world_shape(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= 0 && i < w->shape_count);
    const shape *s = &w->shapes[i];
    return (clast_shape_def){s->name, s->material, s->spheres,        s->centre, s->radius,
                             s->mass, s->inertia,  s->outline_points, s->outline};
}

clast_part_def clast_world_part(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= 0 && i < w->part_count);
    return w->parts[i].def;
}

clast_wall_def clast_world_wall(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= 0 && i < w->wall_count);
    return w->walls[i].def;
}

int clast_world_wall_part(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= 0 && i < w->wall_count);
    return w->walls[i].part;
}

const clast_world_def *clast_world_definition(const clast_world *w) {
    return &w->def;
}

/* What was picked, in words. */
static const char *kernel_name(const clast_world *w) {
    static _Thread_local char name[200];
    const speciality *k = &w->special;
    const char *motion = w->def.motion != CLAST_MOTION_IN_PLANE ? "3-D motion"
                         : k->flat                              ? "in-plane motion, one layer"
                                                                : "in-plane motion";
    const char *friction = !k->tangent ? ", no friction" : k->spring ? "" : ", viscous friction";
    snprintf(name, sizeof name, "%s%s%s, %s%s%s%s", k->clumps ? "clumps" : "spheres",
             k->one_kind ? " of one kind" : "", k->shared ? " with shared dashpots" : "", motion,
             friction, k->rolling ? ", rolling friction" : "",
             w->def.precision == CLAST_PRECISION_MIXED ? ", mixed precision" : "");
    return name;
}

clast_plan clast_world_plan(const clast_world *w) {
    CLAST_ASSERT(w && w->prepared);
    clast_plan p = w->plan;
    p.skin = w->skin;
    p.threads = w->threads;
    p.isa = w->isa_name;
    p.kernel = kernel_name(w);
    return p;
}

clast_counters clast_world_counters(const clast_world *w) {
    clast_counters c = w->counters;
    c.steps = w->step;
    c.bodies = w->ranks ? w->ranks->bodies : w->bodies.count;
    c.spheres = w->ranks ? w->ranks->spheres : w->sphere_count;
    if (!w->integrator) c.force_evaluations = w->step;
    for (int t = 0; t < w->share_room; t++) {
        const share *s = &w->shares[t];
        c.pairs += s->reach.count + s->wall_reach.count;
        c.candidates += s->contacts.count + s->walls.count;
        c.wall_tests += s->wall_tests;
    }
    return c;
}
