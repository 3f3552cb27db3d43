/* body.c - the columns of bodies. */
#include <string.h>

#include "engine/world.h"

vec3 body_position(const clast_world *w, size_t slot) {
    return v3(w->bodies.x[slot], w->bodies.y[slot], w->bodies.z[slot]);
}

quat body_orientation(const clast_world *w, size_t slot) {
    const body_store *b = &w->bodies;
    return (quat){b->qw[slot], b->qx[slot], b->qy[slot], b->qz[slot]};
}

/* A position that is not a number is outside. Along a periodic axis one that cannot be brought back
 * is; one that can is so, or is about to be. */
bool body_is_outside(const clast_world *w, size_t slot) {
    vec3 p = body_position(w, slot), lo = w->def.domain_min, hi = w->def.domain_max;
    bool outside = false;
    for (int k = 0; k < 3; k++) {
        double more = 1e3 * w->period.length[k], x = v3_at(p, k);
        outside |= !(x >= v3_at(lo, k) - more && x <= v3_at(hi, k) + more);
    }
    return outside;
}

/* Spin of a body with this angular momentum, omega = R I^-1 R^T L, with the bits of the kernel. */
vec3 body_spin_of(const clast_world *w, int32_t shape_index, quat q, vec3 l) {
    const shape *s = &w->shapes[shape_index];
    if (w->def.motion == CLAST_MOTION_IN_PLANE || w->special.round)
        return v3_mul(s->inverse_inertia,
                      l); /* in a plane, l has one component: about a principal axis */
    mat3 r = q_matrix(q);
    return m3_apply(&r, v3_mul(s->inverse_inertia, m3_apply_transposed(&r, l)));
}

vec3 body_spin(const clast_world *w, size_t slot) {
    const body_store *b = &w->bodies;
    return body_spin_of(w, b->shape[slot], body_orientation(w, slot),
                        v3(b->lx[slot], b->ly[slot], b->lz[slot]));
}

void body_reserve(clast_world *w, size_t count) {
    body_store *b = &w->bodies;
    if (count <= b->capacity) return;
    size_t half_more = b->capacity + b->capacity / 2,
           capacity = half_more > count ? half_more : count;
#define X(type, name) b->name = memory_grow(w, b->name, b->capacity, capacity, sizeof(type));
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++)
        if (w->def.periodic[k])
            b->image[k] = memory_grow(w, b->image[k], b->capacity, capacity, sizeof *b->image[k]);
    b->capacity = capacity;
}

static void permute_column(void *column, size_t size, const uint32_t *order, size_t count,
                           unsigned char *scratch) {
    unsigned char *bytes = column;
    for (size_t i = 0; i < count; i++) memcpy(scratch + i * size, bytes + order[i] * size, size);
    memcpy(column, scratch, count * size);
}

/* Slot i gets what stood in order[i]. */
void body_permute(clast_world *w, const uint32_t *order) {
    body_store *b = &w->bodies;
    size_t room = b->count * sizeof(double); /* of the widest column */
    void *scratch = memory_grow(w, NULL, 0, room, 1);
#define X(type, name) permute_column(b->name, sizeof(type), order, b->count, scratch);
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++)
        if (b->image[k]) permute_column(b->image[k], sizeof *b->image[k], order, b->count, scratch);
    integrator_permute(w, order, scratch);
    memory_release(scratch), memory_return(w, room);
    for (size_t i = 0; i < b->count; i++) w->slot_of_id[b->id[i]] = (int32_t)i;
}

/* The last body takes the place of the one that goes: storage order is not observable. */
void body_remove(clast_world *w, size_t slot) {
    body_store *b = &w->bodies;
    CLAST_ASSERT(slot < b->count);
    size_t last = b->count - 1;
    w->slot_of_id[b->id[slot]] = -1;
#define X(type, name) b->name[slot] = b->name[last];
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++)
        if (b->image[k]) b->image[k][slot] = b->image[k][last];
    integrator_move(w, slot, last);
    if (slot != last) w->slot_of_id[b->id[slot]] = (int32_t)slot;
    b->count = last;
    w->counters.removed++;
}

/* Room for so many ids ever given. */
void ids_reserve(clast_world *w, uint32_t ids) {
    size_t old = w->slot_of_id_capacity, now = 2 * old + 64;
    if (ids <= old) return;
    if (now < ids) now = ids;
    w->slot_of_id = memory_grow(w, w->slot_of_id, old, now, sizeof *w->slot_of_id);
    w->slot_of_id_capacity = now;
}

static uint32_t new_id(clast_world *w) {
    ids_reserve(w, w->next_id + 1);
    return w->next_id++;
}

static void store_pose(body_store *b, size_t i, vec3 p, quat q) {
    b->x[i] = p.x, b->y[i] = p.y, b->z[i] = p.z;
    b->qw[i] = q.w, b->qx[i] = q.x, b->qy[i] = q.y, b->qz[i] = q.z;
}

static void store_motion(body_store *b, size_t i, vec3 v, vec3 l) {
    b->vx[i] = v.x, b->vy[i] = v.y, b->vz[i] = v.z;
    b->lx[i] = l.x, b->ly[i] = l.y, b->lz[i] = l.z;
}

static bool is_finite(vec3 a) {
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* The slot of a new body, with a unit quaternion. */
size_t body_store_new(clast_world *w, const clast_body_def *def) {
    body_store *b = &w->bodies;
    size_t i = b->count + w->ghosts + w->arrived;
    body_reserve(w, i + 1);
    if (w->ranks)
        w->arrived++; /* comes to the others when the lists are made */
    else
        b->count++;
    mat3 r = q_matrix(def->orientation);
    vec3 local = m3_apply_transposed(&r, def->spin);
    b->id[i] = new_id(w);
    b->shape[i] = def->shape;
    store_pose(b, i, def->position, def->orientation);
    for (int k = 0; k < 3; k++)
        if (b->image[k]) b->image[k][i] = 0;
    store_motion(b, i, def->velocity, m3_apply(&r, v3_mul(w->shapes[def->shape].inertia, local)));
    w->slot_of_id[b->id[i]] = (int32_t)i;
    return i;
}

/* The one that arrived last belongs to another process. */
void body_forget_arrived(clast_world *w, size_t slot) {
    CLAST_ASSERT(w->arrived > 0 && slot == w->bodies.count + w->ghosts + w->arrived - 1);
    w->slot_of_id[w->bodies.id[slot]] = -1;
    w->arrived--;
}

int clast_body_add(clast_world *w, const clast_body_def *def) {
    CLAST_ASSERT(w && def && def->shape >= 0 && def->shape < w->shape_count && !w->prepared);
    quat q = def->orientation;
    double norm2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (norm2 == 0) q = (quat){1, 0, 0, 0};
    if (norm2 != 0 && !(norm2 > 0.98 && norm2 < 1.02))
        return world_fail(w, CLAST_ERR_ARGUMENT, "body %u: orientation is not a unit quaternion",
                          w->next_id),
               -1;
    if (!is_finite(def->position) || !is_finite(def->velocity) || !is_finite(def->spin))
        return world_fail(w, CLAST_ERR_ARGUMENT,
                          "body %u: position, velocity or spin is not finite", w->next_id),
               -1;
    clast_body_def unit = *def;
    unit.orientation = q_unit(q);
    size_t slot = body_store_new(w, &unit); /* may move the columns */
    return (int)w->bodies.id[slot];
}
