/* wall.c - planes and plates, and how they follow their parts. */
#include "engine/geometry.h"
#include "engine/part.h"
#include "engine/world.h"

static const char *fault_of(const clast_world *w, int part_index, const clast_wall_def *d) {
    if (part_index < 0 || part_index >= w->part_count) return "belongs to no part";
    if (d->material < 0 || d->material >= w->material_count) return "has no such material";
    if (!(v3_norm(d->normal) > 0)) return "has no normal";
    if (!isfinite(v3_norm(d->normal) + v3_norm(d->side) + v3_norm(d->point)))
        return "has a point or direction that is not finite";
    vec3 belt = d->belt_velocity;
    if (!(fabs(v3_dot(belt, d->normal)) <= 1e-6 * v3_norm(belt) * v3_norm(d->normal)))
        return "has a belt velocity that is not along its surface";
    if (d->kind == CLAST_WALL_PLANE) return NULL;
    if (d->kind != CLAST_WALL_PLATE) return "is of a kind that comes with a mesh alone";
    if (!(d->half_side[0] > 0 && d->half_side[1] > 0)) return "has a side that is not above zero";
    if (!isfinite(d->half_side[0] + d->half_side[1])) return "has a side that is not finite";
    double along = v3_norm(d->side);
    if (!(along > 0)) return "has no side direction";
    double cosine = v3_dot(d->side, d->normal) / (along * v3_norm(d->normal));
    if (!(fabs(cosine) < 1e-6)) return "has a side that is not across its normal";
    return NULL;
}

wall *wall_new(clast_world *w, int part_index, const clast_wall_def *def) {
    if (w->wall_count == w->wall_room) {
        int now = 2 * w->wall_room + 4;
        w->walls = memory_grow(w, w->walls, (size_t)w->wall_room, (size_t)now, sizeof *w->walls);
        w->wall_room = now;
    }
    wall *l = &w->walls[w->wall_count++];
    *l = (wall){.name = memory_text(w, def->name),
                .part = part_index,
                .def = *def,
                .family = -1,
                .smooth = -1};
    l->def.name = l->name;
    l->n = v3_scale(1 / v3_norm(def->normal), def->normal);
    l->point = l->anchor = l->anchor_start = def->point;
    return l;
}

int clast_wall_add(clast_world *w, int part_index, const clast_wall_def *def) {
    CLAST_ASSERT(w && def && !w->prepared);
    const char *fault = fault_of(w, part_index, def);
    if (fault)
        return world_fail(w, CLAST_ERR_ARGUMENT, "wall %s %s", def->name ? def->name : "?", fault),
               -1;
    int n = w->wall_count;
    wall *l = wall_new(w, part_index, def);
    if (def->kind == CLAST_WALL_PLATE) {
        l->u = v3_scale(1 / v3_norm(def->side), def->side);
        l->v = v3_cross(l->n, l->u);
        double a = def->half_side[0], b = def->half_side[1];
        l->bound = a + b;
        l->half_box = v3(a * fabs(l->u.x) + b * fabs(l->v.x), a * fabs(l->u.y) + b * fabs(l->v.y),
                         a * fabs(l->u.z) + b * fabs(l->v.z));
    }
    l->def.normal = l->n;
    l->def.side = l->u;
    return n;
}

/* Two plates in one plane whose rectangles touch or overlap. */
static bool are_coplanar(const clast_world *w, const wall *a, const wall *b) {
    if (a == b || a->def.kind != CLAST_WALL_PLATE || b->def.kind != CLAST_WALL_PLATE) return false;
    double size =
        a->def.half_side[0] + a->def.half_side[1] + b->def.half_side[0] + b->def.half_side[1];
    if (!(fabs(fabs(v3_dot(a->n, b->n)) - 1) < 1e-12)) return false;
    vec3 between = separation(&w->period, b->def.point, a->def.point);
    return fabs(v3_dot(between, a->n)) < 1e-9 * size && v3_norm(between) <= size;
}

/* Plates that lie in one plane and meet, directly or by others, are of one family. */
static void link_plate(clast_world *w, int i) {
    wall *own = &w->walls[i];
    for (int j = 0; j < i; j++) {
        const wall *other = &w->walls[j];
        if (!are_coplanar(w, own, other) || own->family == other->family) continue;
        int old = own->family, now = other->family;
        for (int k = 0; k <= i; k++)
            if (old >= 0 && w->walls[k].family == old) w->walls[k].family = now;
        own->family = now;
    }
}

/* An edge between two such plates is no edge, and a family shows where one may hide another. Meshes
 * are families from the start. */
void walls_link(clast_world *w) {
    for (int i = 0; i < w->wall_count; i++)
        if (w->walls[i].def.kind == CLAST_WALL_PLATE) w->walls[i].family = -1;
    for (int i = 0; i < w->wall_count; i++) {
        if (w->walls[i].def.kind != CLAST_WALL_PLATE) continue;
        bool meets = false;
        for (int j = 0; j < w->wall_count && !meets; j++)
            meets = are_coplanar(w, &w->walls[i], &w->walls[j]);
        if (!meets) continue;
        w->walls[i].family = i;
        link_plate(w, i);
    }
}

/* ---- levers ----------------------------------------------------------------------------------
 * What the lists and the guard need to know of a turn: how far it takes a place of a wall. */

/* m, from a point of the axis to the farthest place where a sphere can be. */
static double farthest_sphere(const clast_world *w, vec3 pivot) {
    vec3 low = v3_sub(w->def.domain_min, pivot), high = v3_sub(w->def.domain_max, pivot);
    vec3 far = v3(fmax(fabs(low.x), fabs(high.x)), fmax(fabs(low.y), fabs(high.y)),
                  fmax(fabs(low.z), fabs(high.z)));
    return v3_norm(far) + w->largest_bound;
}

/* A plane that turns about its normal stays where it is; another sweeps over its bodies. */
static void take_lever(const clast_world *w, part *p, const wall *l) {
    vec3 pivot = p->def.rotation.point;
    if (l->def.kind == CLAST_WALL_PLANE) {
        double tilt = v3_norm(v3_cross(l->n, p->axis));
        p->tilt = fmax(p->tilt, tilt);
        p->lever = fmax(p->lever, tilt * farthest_sphere(w, pivot));
        return;
    }
    vec3 arm = v3_sub(l->def.point, pivot);
    vec3 across = v3_sub(arm, v3_scale(v3_dot(arm, p->axis), p->axis));
    p->reach = fmax(p->reach, v3_norm(across) + l->bound);
    p->lever = fmax(p->lever, p->reach);
}

/* ---- following ------------------------------------------------------------------------------- */

static bool ever_moves(const part *p) {
    return p->turns || p->shifts;
}

/* Whether its work is more than that of its force. */
bool wall_drives(const clast_world *w, const wall *l) {
    return w->parts[l->part].turns || v3_norm(l->def.belt_velocity) > 0;
}

/* Whether its work has to be booked. */
bool wall_pushes(const clast_world *w, const wall *l) {
    return w->parts[l->part].shifts || wall_drives(w, l);
}

/* Which walls a part has, and what stays the same of them. */
void walls_group(clast_world *w) {
    for (int i = 0; i < w->part_count; i++) {
        part *p = &w->parts[i];
        p->lever = p->tilt = p->reach = 0, p->wall_count = 0;
        for (int k = 0; k < w->wall_count; k++) p->wall_count += w->walls[k].part == i;
        memory_release(p->walls);
        p->walls = memory_grow(w, NULL, 0, (size_t)p->wall_count + 1, sizeof *p->walls);
        p->wall_count = 0;
    }
    for (int k = 0; k < w->wall_count; k++) {
        wall *l = &w->walls[k];
        part *p = &w->parts[l->part];
        p->walls[p->wall_count++] = k;
        l->u_home = l->u, l->v_home = l->v;
        l->pushes = wall_pushes(w, l), l->drives = wall_drives(w, l);
        if (p->turns) take_lever(w, p, l);
    }
}

static bool are_same(vec3 a, vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* m, that a part which moves by its velocity alone goes on to its place at that time: nothing else
 * of it changes. */
static double glide(part *p, double time) {
    vec3 was = p->at.offset;
    p->at.offset = part_at(p, time).offset;
    return v3_norm(v3_sub(p->at.offset, was));
}

/* Puts a part where it is at that time, with velocities at another; whether its walls have to be
 * put anew. */
static bool move_part(clast_world *w, part *p, double time, double velocity_time) {
    bool present = !(p->def.removed_at > 0 && time >= p->def.removed_at);
    if (present != p->present) w->stale = w->parts_changed = true;
    bool running = part_is_running(&p->def, velocity_time);
    bool was_running = p->running;
    bool stays = w->prepared && running == was_running && !p->turns && !p->shifts;
    p->present = present, p->running = running;
    if (stays) return false;
    if (p->steady && running && was_running && w->prepared) {
        p->wall_way = p->wall_step = glide(p, time);
        return true;
    }
    part_place was = p->at, moves = part_at(p, velocity_time);
    p->at = part_at(p, time);
    p->at.velocity = moves.velocity, p->at.spin = moves.spin;
    bool same = are_same(p->at.offset, was.offset) && p->at.angle == was.angle &&
                are_same(p->at.velocity, was.velocity) && p->at.spin == was.spin;
    if (same && w->prepared && running == was_running) return false;
    p->wall_way = p->wall_step = v3_norm(v3_sub(p->at.offset, was.offset));
    if (!p->turns) return true;
    p->wall_way = part_way(p, &was);
    p->wall_step += fabs(p->at.angle - was.angle) * p->reach;
    p->turn = q_matrix(part_turn(p, p->at.angle));
    return true;
}

/* ---- rows ------------------------------------------------------------------------------------ */

static void put_row(const clast_world *w, double to[3], vec3 a) {
    vec3 k = to_kernel(w, a);
    to[0] = k.x, to[1] = k.y, to[2] = k.z;
}

static void place_row(const clast_world *w, wall_row *r, const wall *l) {
    const part *p = &w->parts[l->part];
    put_row(w, r->point, l->point);
    put_row(w, r->motion, v3_add(p->at.velocity, l->belt));
    if (!p->turns) return;
    put_row(w, r->n, l->n), put_row(w, r->u, l->u), put_row(w, r->v, l->v);
}

/* Plates of a family overlap, so the middle of one may be another's. */
static bool is_plate_of(const wall *l) {
    return l->family >= 0 && l->def.kind == CLAST_WALL_PLATE;
}

static void fill_row(const clast_world *w, wall_row *r, const wall *l) {
    bool plane = l->def.kind == CLAST_WALL_PLANE;
    *r = (wall_row){.zero = 0};
    put_row(w, r->n, l->n), put_row(w, r->u, l->u), put_row(w, r->v, l->v);
    r->half_u = plane ? WALL_ENDLESS : l->def.half_side[0];
    r->half_v = plane ? WALL_ENDLESS : l->def.half_side[1];
    bool never_clear = l->smooth >= 0 || is_plate_of(l);
    r->rim = l->fillets.count > 0 ? 2 * WALL_ENDLESS
             : never_clear        ? WALL_ENDLESS
             : l->family >= 0     ? fmax(l->rim, wall_rim(l))
                                  : -WALL_ENDLESS;
    place_row(w, r, l);
}

void walls_make_rows(clast_world *w) {
    w->wall_rows = memory_grow(w, NULL, 0, (size_t)w->wall_count + 1, sizeof *w->wall_rows);
    w->push_index = memory_grow(w, NULL, 0, (size_t)w->wall_count + 1, sizeof *w->push_index);
    for (int i = 0; i < w->wall_count; i++) {
        fill_row(w, &w->wall_rows[i], &w->walls[i]);
        int part_index = w->walls[i].part;
        int nobody = w->part_count + i % NOBODYS_ROWS;
        w->push_index[i] = ever_moves(&w->parts[part_index]) ? part_index : nobody;
    }
}

void walls_drop_rows(clast_world *w) {
    size_t size = sizeof *w->wall_rows + sizeof *w->push_index;
    memory_return(w, ((size_t)w->wall_count + 1) * size);
    memory_release(w->wall_rows), memory_release(w->push_index);
    w->wall_rows = NULL, w->push_index = NULL;
}

/* Walls stand in the frame of their part. */
static void place_wall(wall *l, const part *p) {
    l->point = part_out(p, l->def.point);
    l->anchor = part_out(p, l->anchor_start);
    l->belt = p->running ? part_direction(p, l->def.belt_velocity) : v3(0, 0, 0);
    if (!p->turns) return;
    l->n = part_direction(p, l->def.normal);
    l->u = part_direction(p, l->u_home), l->v = part_direction(p, l->v_home);
    l->half_box = v3(l->bound, l->bound, l->bound);
}

static void place_one(clast_world *w, int wall_index) {
    wall *l = &w->walls[wall_index];
    place_wall(l, &w->parts[l->part]);
    if (w->wall_rows) place_row(w, &w->wall_rows[wall_index], l);
}

/* Of a part that moves, those in the lists alone: the others stand where they were last listed. */
static void place_walls(clast_world *w, const part *p) {
    bool all = !w->prepared || !ever_moves(p);
    int count = all ? p->wall_count : p->near_count;
    for (int k = 0; k < count; k++) place_one(w, all ? p->walls[k] : p->near[k]);
}

/* A wall as it is now, whether it is listed or not; `room` is for one that is not. */
const wall *wall_now(const clast_world *w, int wall_index, wall *room) {
    const wall *l = &w->walls[wall_index];
    const part *p = &w->parts[l->part];
    if (!ever_moves(p) || l->near) return l;
    *room = *l;
    place_wall(room, p);
    return room;
}

static void list_near(clast_world *w, int wall_index) {
    part *p = &w->parts[w->walls[wall_index].part];
    if (w->walls[wall_index].near || !ever_moves(p)) return;
    if (p->near_count == p->near_capacity) {
        int now = 2 * p->near_capacity + 8;
        p->near = memory_grow(w, p->near, (size_t)p->near_capacity, (size_t)now, sizeof *p->near);
        p->near_capacity = now;
    }
    p->near[p->near_count++] = wall_index;
    w->walls[wall_index].near = true;
    place_one(w, wall_index);
}

/* Which walls go with their parts from here on. Needs new reach lists. */
void walls_list_near(clast_world *w) {
    for (int i = 0; i < w->part_count; i++) {
        part *p = &w->parts[i];
        for (int k = 0; k < p->near_count; k++) w->walls[p->near[k]].near = false;
        p->near_count = 0;
    }
    for (int t = 0; t < w->threads; t++) {
        const wall_reach *l = &w->shares[t].wall_reach;
        for (size_t k = 0; k < l->count; k++) list_near(w, l->wall[k]);
    }
}

static void move_parts(clast_world *w, double time, double velocity_time) {
    w->wall_way = w->wall_step = 0;
    for (int i = 0; i < w->part_count; i++) {
        part *p = &w->parts[i];
        if (!move_part(w, p, time, velocity_time)) continue;
        place_walls(w, p);
        if (!p->present) continue;
        if (p->wall_way > w->wall_way) w->wall_way = p->wall_way;
        if (p->wall_step > w->wall_step) w->wall_step = p->wall_step, w->wall_who = i;
    }
}

/* Within a step, for a stage of a scheme. */
void walls_move_to(clast_world *w, double time) {
    move_parts(w, time, time);
}

/* To the end of this step. The leapfrog has the velocities of the bodies in the middle of the step,
 * so it takes those of the walls there: what two surfaces slide is then the change of their places,
 * to second order. Other schemes have both at its end. */
void walls_move(clast_world *w) {
    double time = (double)w->step * w->dt;
    bool halves = w->def.scheme == CLAST_SCHEME_LEAPFROG && w->step > 0;
    move_parts(w, time, halves ? time - 0.5 * w->dt : time);
    for (int i = 0; i < w->part_count; i++) {
        part *p = &w->parts[i];
        p->start = p->end, p->end = p->at;
    }
}
