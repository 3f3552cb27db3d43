/* view.c - reading a world. Nothing here changes its state. */
#include "engine/geometry.h"

double clast_world_time(const clast_world *w) { return (double)w->step * w->dt; }
double clast_world_time_step(const clast_world *w) { return w->dt; }
uint64_t clast_world_steps(const clast_world *w) { return w->step; }

clast_bodies clast_world_bodies(clast_world *w) {
    CLAST_ASSERT(w);
    velocities_synchronise(w);
    const body_store *b = &w->bodies;
    return (clast_bodies){
        .count = b->count, .id = b->id, .shape = b->shape, .x = b->x, .y = b->y, .z = b->z,
        .qw = b->qw, .qx = b->qx, .qy = b->qy, .qz = b->qz,
        .vx = w->view.vx, .vy = w->view.vy, .vz = w->view.vz,
        .wx = w->view.wx, .wy = w->view.wy, .wz = w->view.wz, .mass = w->view.mass};
}

clast_spheres clast_world_spheres(clast_world *w) {
    CLAST_ASSERT(w && w->prepared);
    const sphere_store *s = &w->spheres;
    return (clast_spheres){s->count, s->x, s->y, s->z, s->radius, s->body};
}

/* The geometry of a recorded contact, by the kernel's own functions. */
static touch touch_of_record(const clast_world *w, const contact_record *r) {
    int32_t a = w->slot_of_id[r->a];
    int32_t sa = (int32_t)w->spheres.first[a] + r->sphere_a;
    if (r->b >= CLAST_WALL_ID) {
        pair p = {.a = a, .b = -1 - (int32_t)(r->b - CLAST_WALL_ID)};
        return touch_of_wall(w, &p, sa);
    }
    pair p = {.a = a, .b = w->slot_of_id[r->b]};
    return touch_of_spheres(w, &p, sa, (int32_t)w->spheres.first[p.b] + r->sphere_b);
}

static vec3 point_of(const clast_world *w, const contact_record *r, const touch *t) {
    return v3_add(body_position(w, (size_t)w->slot_of_id[r->a]), t->arm_a);
}

size_t clast_world_contacts(clast_world *w, clast_contact *contacts, size_t room) {
    CLAST_ASSERT(w && w->prepared && (contacts || room == 0));
    records_collect(w);
    for (size_t i = 0; i < w->records.count && i < room; i++) {
        const contact_record *r = &w->records.items[i];
        vec3 f = r->history.force;
        touch t = touch_of_record(w, r);
        contacts[i] = (clast_contact){r->a, r->b, r->sphere_a, r->sphere_b, r->history.overlap,
                                      point_of(w, r, &t), f, v3_dot(f, t.normal)};
    }
    return w->records.count;
}

clast_part_load clast_world_part_load(clast_world *w, int index) {
    CLAST_ASSERT(w && w->prepared && index >= 0 && index < w->part_count);
    clast_part_load load = {.work = w->parts[index].work_total};
    records_collect(w);
    for (size_t i = 0; i < w->records.count; i++) {
        const contact_record *r = &w->records.items[i];
        if (r->b < CLAST_WALL_ID || w->walls[r->b - CLAST_WALL_ID].part != index) continue;
        vec3 on_part = v3_scale(-1, r->history.force);
        load.force = v3_add(load.force, on_part);
        touch t = touch_of_record(w, r);
        load.torque = v3_add(load.torque, v3_cross(point_of(w, r, &t), on_part));
    }
    return load;
}

bool clast_world_part_present(const clast_world *w, int index) { return w->parts[index].present; }
clast_vec3 clast_world_part_offset(const clast_world *w, int index) {
    return w->parts[index].offset;
}

int clast_world_shape_count(const clast_world *w) { return w->shape_count; }
int clast_world_part_count(const clast_world *w) { return w->part_count; }
int clast_world_wall_count(const clast_world *w) { return w->wall_count; }
int clast_world_material_count(const clast_world *w) { return w->material_count; }

clast_shape_def clast_world_shape(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= 0 && i < w->shape_count);
    const shape *s = &w->shapes[i];
    return (clast_shape_def){s->name, s->material, s->spheres, s->centre, s->radius, s->mass,
                             s->inertia, s->outline_points, s->outline};
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

const clast_world_def *clast_world_definition(const clast_world *w) { return &w->def; }

static const char *kernel_name(const clast_world *w) {
    bool single = true;
    for (int i = 0; i < w->shape_count; i++) single &= w->shapes[i].spheres == 1;
    if (w->def.motion == CLAST_MOTION_IN_PLANE)
        return single ? "spheres, in-plane motion" : "clumps, in-plane motion";
    return single ? "spheres, 3-D motion" : "clumps, 3-D motion";
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
    c.bodies = w->bodies.count;
    c.spheres = w->spheres.count;
    return c;
}
