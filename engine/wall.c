/* wall.c - planes and plates, grouped in parts that move as the scene prescribes. */
#include "engine/geometry.h"

int clast_part_add(clast_world *w, const clast_part_def *def) {
    CLAST_ASSERT(w && def && !w->prepared);
    const char *name = def->name ? def->name : "?";
    if (!isfinite(v3_dot(def->velocity, def->velocity)))
        return world_fail(w, CLAST_ERR_ARGUMENT, "part %s: velocity is not finite", name), -1;
    if (isnan(def->move_from) || isnan(def->removed_at))
        return world_fail(w, CLAST_ERR_ARGUMENT, "part %s: a time is not a number", name), -1;
    if (def->move_until != 0 && !(def->move_until > def->move_from))
        return world_fail(w, CLAST_ERR_ARGUMENT, "part %s: move_until is not after move_from",
                          name),
               -1;
    int n = w->part_count;
    w->parts = memory_grow(w, w->parts, (size_t)n, (size_t)n + 1, sizeof *w->parts);
    w->parts[n] = (part){.name = memory_text(w, def->name), .def = *def, .present = true};
    w->parts[n].def.name = w->parts[n].name;
    w->part_count++;
    return n;
}

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
    *l = (wall){.name = memory_text(w, def->name), .part = part_index, .def = *def};
    l->def.name = l->name;
    l->n = v3_scale(1 / v3_norm(def->normal), def->normal);
    l->point = def->point;
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
static bool are_coplanar(const wall *a, const wall *b) {
    if (a == b || a->def.kind != CLAST_WALL_PLATE || b->def.kind != CLAST_WALL_PLATE) return false;
    double size =
        a->def.half_side[0] + a->def.half_side[1] + b->def.half_side[0] + b->def.half_side[1];
    if (!(fabs(fabs(v3_dot(a->n, b->n)) - 1) < 1e-12)) return false;
    vec3 between = v3_sub(b->def.point, a->def.point);
    return fabs(v3_dot(between, a->n)) < 1e-9 * size && v3_norm(between) <= size;
}

void wall_join(clast_world *w, int i, int j) {
    wall *l = &w->walls[i];
    for (int k = 0; k < l->joined_count; k++)
        if (l->joined[k] == j) return;
    if (l->joined_count == l->joined_room) {
        int now = 2 * l->joined_room + 4;
        l->joined =
            memory_grow(w, l->joined, (size_t)l->joined_room, (size_t)now, sizeof *l->joined);
        l->joined_room = now;
    }
    l->joined[l->joined_count++] = j;
}

/* An edge between two such plates is no edge: the narrow phase asks this list. */
void walls_link(clast_world *w) {
    for (int i = 0; i < w->wall_count; i++)
        for (int j = 0; j < w->wall_count; j++)
            if (are_coplanar(&w->walls[i], &w->walls[j])) wall_join(w, i, j);
}

/* The box around a plate or patch; a plane has none. */
bool wall_box(const wall *l, vec3 *low, vec3 *high) {
    if (l->def.kind == CLAST_WALL_PLANE) return false;
    vec3 half = v3(l->half_box.x, l->half_box.y, l->half_box.z);
    *low = v3_sub(l->point, half), *high = v3_add(l->point, half);
    return true;
}

/* Seconds that a part has been moving until t. */
static double moving_time(const clast_part_def *d, double t) {
    double until = d->move_until > 0 && d->move_until < t ? d->move_until : t;
    return until > d->move_from ? until - d->move_from : 0;
}

static bool is_moving(const clast_part_def *d, double t) {
    return t >= d->move_from && !(d->move_until > 0 && t >= d->move_until);
}

/* Whether its walls have to be put anew. */
static bool move_part(clast_world *w, part *p, double t) {
    bool present = !(p->def.removed_at > 0 && t >= p->def.removed_at);
    if (present != p->present) w->stale = w->parts_changed = true;
    p->present = present;
    vec3 offset = v3_scale(moving_time(&p->def, t), p->def.velocity);
    vec3 velocity = is_moving(&p->def, t) ? p->def.velocity : v3(0, 0, 0);
    vec3 step = v3_sub(offset, p->offset), change = v3_sub(velocity, p->velocity);
    bool still = v3_dot(step, step) == 0 && v3_dot(change, change) == 0 && w->prepared;
    p->offset = offset, p->velocity = velocity;
    double way = v3_norm(step);
    if (way > w->wall_way) w->wall_way = way;
    return !still;
}

/* ---- rows ------------------------------------------------------------------------------------ */

static void put_row(const clast_world *w, double to[3], vec3 a) {
    vec3 k = to_kernel(w, a);
    to[0] = k.x, to[1] = k.y, to[2] = k.z;
}

static void place_row(const clast_world *w, wall_row *r, const wall *l) {
    put_row(w, r->point, l->point);
    put_row(w, r->motion, l->surface_velocity);
}

static void fill_row(const clast_world *w, wall_row *r, const wall *l) {
    bool plane = l->def.kind == CLAST_WALL_PLANE;
    bool uneven = l->def.kind == CLAST_WALL_PATCH && !l->is_rectangle;
    *r = (wall_row){.zero = 0};
    put_row(w, r->n, l->n), put_row(w, r->u, l->u), put_row(w, r->v, l->v);
    r->half_u = plane ? WALL_ENDLESS : uneven ? l->bound : l->def.half_side[0];
    r->half_v = plane ? WALL_ENDLESS : uneven ? l->bound : l->def.half_side[1];
    if (uneven || (l->joined_count > 0 && !l->is_rectangle))
        r->rim = WALL_ENDLESS; /* never clear of it */
    else
        r->rim = l->joined_count > 0 ? wall_rim(l) : -WALL_ENDLESS;
    place_row(w, r, l);
}

void walls_make_rows(clast_world *w) {
    w->wall_rows = memory_grow(w, NULL, 0, (size_t)w->wall_count + 1, sizeof *w->wall_rows);
    for (int i = 0; i < w->wall_count; i++) fill_row(w, &w->wall_rows[i], &w->walls[i]);
}

/* Puts every part where it is at that time. Positions are functions of time, never sums of steps.
 */
void walls_move_to(clast_world *w, double time) {
    bool any = false;
    w->wall_way = 0;
    for (int i = 0; i < w->part_count; i++) any |= move_part(w, &w->parts[i], time);
    for (int i = 0; i < w->wall_count && any; i++) {
        wall *l = &w->walls[i];
        const part *p = &w->parts[l->part];
        l->point = v3_add(l->def.point, p->offset);
        l->surface_velocity = v3_add(p->velocity, l->def.belt_velocity);
        if (w->wall_rows) place_row(w, &w->wall_rows[i], l);
    }
}

void walls_move(clast_world *w) {
    walls_move_to(w, (double)w->step * w->dt);
}
