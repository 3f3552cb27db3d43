/* feed.c - bodies that arrive while the world runs. When the next is due, of which kind it is,
 * where its place is looked for and how it is turned are functions of the seed, the number of the
 * feed and what it has fed so far. A place must be clear of bounding spheres and walls, so a body
 * arrives without contacts and brings what it carries and no more. */
#include "engine/cells.h"
#include "engine/flow.h"
#include "engine/geometry.h"
#include "engine/numbers.h"
#include "engine/periodic.h"
#include "engine/ranks.h"

/* steps: how long a feed that has found no place waits before it looks again */
enum { USUAL_ATTEMPTS = 100, REST = 100 };

/* ---- the definition -------------------------------------------------------------------------- */

static bool is_finite(vec3 a) {
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

static bool is_rate(double rate) {
    return rate >= 0 && isfinite(rate);
}

static const char *fault_of_kinds(const clast_world *w, const clast_feed_def *d) {
    if (d->shapes < 1 || !d->shape) return "has no shape";
    for (int i = 0; i < d->shapes; i++) {
        if (d->shape[i] < 0 || d->shape[i] >= w->shape_count)
            return "has a shape that is not there";
        if (d->share && !(d->share[i] > 0 && isfinite(d->share[i])))
            return "has a share that is not above zero";
    }
    return NULL;
}

static const char *fault_of(const clast_world *w, const clast_feed_def *d) {
    vec3 low = d->region_min, high = d->region_max;
    if (!is_finite(low) || !is_finite(high)) return "has a region that is not finite";
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z))
        return "has a region with a corner below the other";
    if (!is_rate(d->mass_rate) || !is_rate(d->number_rate)) return "has a rate below zero";
    if ((d->mass_rate > 0) == (d->number_rate > 0))
        return "needs a rate of mass or of number, one of the two";
    if (!isfinite(d->from) || (d->until != 0 && !(d->until > d->from)))
        return "ends before it begins";
    if (!is_finite(d->velocity) || !is_finite(d->spin))
        return "has a velocity or spin that is not finite";
    quat q = d->orientation;
    double norm2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (norm2 != 0 && !(norm2 > 0.98 && norm2 < 1.02))
        return "has an orientation that is not a unit quaternion";
    if (d->attempts < 0) return "makes less than no attempts";
    return fault_of_kinds(w, d);
}

/* Shares of the kinds up to each. */
static double *summed(clast_world *w, const clast_feed_def *d) {
    double *below = memory_grow(w, NULL, 0, (size_t)d->shapes, sizeof *below), sum = 0;
    for (int i = 0; i < d->shapes; i++) below[i] = sum += d->share ? d->share[i] : 1;
    for (int i = 0; i < d->shapes; i++) below[i] /= sum;
    return below;
}

int clast_feed_add(clast_world *w, const clast_feed_def *def) {
    CLAST_ASSERT(w && def && !w->prepared);
    const char *fault = fault_of(w, def), *name = def->name ? def->name : "?";
    if (fault) return world_fail(w, CLAST_ERR_ARGUMENT, "feed %s %s", name, fault), -1;
    flow *f = w->flow;
    size_t n = (size_t)f->feed_count, kinds = (size_t)def->shapes;
    f->feeds = memory_grow(w, f->feeds, n, n + 1, sizeof *f->feeds);
    feed *d = &f->feeds[n];
    *d = (feed){.def = *def, .below = summed(w, def)};
    d->def.name = memory_text(w, name);
    d->def.shape = memory_copy(w, def->shape, kinds, sizeof *def->shape);
    if (def->share) d->def.share = memory_copy(w, def->share, kinds, sizeof *def->share);
    if (def->attempts == 0) d->def.attempts = USUAL_ATTEMPTS;
    quat q = def->orientation;
    bool given = q.w != 0 || q.x != 0 || q.y != 0 || q.z != 0;
    d->def.orientation = given ? q_unit(q) : (quat){1, 0, 0, 0};
    return f->feed_count++;
}

/* ---- before the start ------------------------------------------------------------------------ */

static bool is_in_domain(const clast_world *w, vec3 p) {
    vec3 lo = w->def.domain_min, hi = w->def.domain_max;
    return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z;
}

static const char *fault_in_plane(const clast_world *w, const clast_feed_def *d) {
    if (w->def.motion != CLAST_MOTION_IN_PLANE) return NULL;
    vec3 wide = to_kernel(w, v3_sub(d->region_max, d->region_min));
    vec3 velocity = to_kernel(w, d->velocity), spin = to_kernel(w, d->spin);
    if (wide.z != 0) return "has a region that is not one layer in the plane of motion";
    if (velocity.z != 0) return "has a velocity across the plane of motion";
    if (spin.x != 0 || spin.y != 0) return "has a spin out of the plane of motion";
    mat3 turn = q_matrix(d->orientation);
    int axis = w->def.plane_axis;
    bool upright = v3_at(turn.row[axis], axis) > 1 - 1e-9;
    return upright ? NULL : "has an orientation tilted out of the plane of motion";
}

/* What the definition alone does not show. */
clast_status flow_check(clast_world *w) {
    const flow *f = w->flow;
    if (f->feed_count > 0 && w->def.scheme != CLAST_SCHEME_LEAPFROG)
        return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT,
                                        "feeds need the leapfrog: other schemes look back");
    for (int i = 0; i < f->feed_count; i++) {
        const clast_feed_def *d = &f->feeds[i].def;
        const char *fault = fault_in_plane(w, d);
        if (!is_in_domain(w, d->region_min) || !is_in_domain(w, d->region_max))
            fault = "has a region that reaches out of the domain";
        if (fault)
            return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT, "feed %s %s", d->name, fault);
    }
    return CLAST_OK;
}

/* How many bodies will be there at once is not known: room for a thousand, and 32 thousand times as
 * much before the sums lose what is below them (sum.h). */
double feeds_mass_expected(const clast_world *w, double *fastest2) {
    double mass = 0;
    for (int i = 0; i < w->flow->feed_count; i++) {
        const clast_feed_def *d = &w->flow->feeds[i].def;
        double most = 0;
        for (int k = 0; k < d->shapes; k++) most = fmax(most, w->shapes[d->shape[k]].mass);
        double v = v3_norm(d->velocity) + v3_norm(d->spin) * w->largest_bound;
        mass += 1000 * most;
        *fastest2 = fmax(*fastest2, v * v);
    }
    return mass;
}

/* ---- what is due ----------------------------------------------------------------------------- */

typedef enum draw { DRAW_KIND, DRAW_PLACE, DRAW_TURN, DRAWS } draw;

static double drawn(const clast_world *w, int index, draw what, uint64_t counter) {
    const uint64_t streams = UINT64_C(0x66656564) << 32; /* "feed": apart from those of scenes */
    return clast_random(w->def.seed, streams + (uint64_t)(DRAWS * index + (int)what), counter);
}

/* kg or bodies that should have come by now; negative before it begins. */
static double due(const clast_feed_def *d, double time) {
    double rate = d->mass_rate > 0 ? d->mass_rate : d->number_rate;
    double until = d->until != 0 && d->until < time ? d->until : time;
    return rate * (until - d->from);
}

static double come(const feed *f) {
    return f->def.mass_rate > 0 ? f->state.mass : (double)f->state.bodies;
}

clast_flow clast_world_feed_flow(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= 0 && i < w->flow->feed_count);
    const feed *f = &w->flow->feeds[i];
    double owed = due(&f->def, clast_world_time(w)) - come(f);
    return (clast_flow){f->state.bodies, f->state.mass, owed > 0 ? owed : 0, f->state.refused};
}

static int kind_of_next(const clast_world *w, const feed *f, int index) {
    double u = drawn(w, index, DRAW_KIND, f->state.bodies);
    int k = 0;
    while (k < f->def.shapes - 1 && !(u < f->below[k])) k++;
    return f->def.shape[k];
}

static quat turn_of_next(const clast_world *w, const feed *f, int index) {
    if (!f->def.turned) return f->def.orientation;
    uint64_t at = 3 * f->state.bodies;
    double u = drawn(w, index, DRAW_TURN, at);
    if (w->def.motion == CLAST_MOTION_IN_PLANE)
        return clast_quat_axis_angle(v3_axis(w->def.plane_axis, 1), 2 * NUMBER_PI * u);
    return clast_quat_uniform(u, drawn(w, index, DRAW_TURN, at + 1),
                              drawn(w, index, DRAW_TURN, at + 2));
}

/* ---- a place --------------------------------------------------------------------------------- */

static vec3 next_place(const clast_world *w, feed *f, int index) {
    uint64_t at = 3 * f->state.places++;
    vec3 wide = v3_sub(f->def.region_max, f->def.region_min);
    vec3 u = v3(drawn(w, index, DRAW_PLACE, at), drawn(w, index, DRAW_PLACE, at + 1),
                drawn(w, index, DRAW_PLACE, at + 2));
    return v3_add(f->def.region_min, v3_mul(u, wide));
}

static bool is_clear_of_slots(const clast_world *w, size_t from, size_t to, vec3 p, double bound) {
    for (size_t slot = from; slot < to; slot++) {
        vec3 d = separation(&w->period, body_position(w, slot), p);
        double apart = bound + w->shapes[w->bodies.shape[slot]].bound;
        if (v3_dot(d, d) < apart * apart) return false;
    }
    return true;
}

/* Bodies stand in the cells of the last rebuild; those that came since stand behind. Where cells go
 * round, across periodic faces, all bodies are asked. */
static bool is_clear_of_bodies(const clast_world *w, vec3 p, double bound) {
    size_t sorted = w->period.any ? 0 : w->cells.bodies;
    size_t came = w->bodies.count + w->ghosts;
    if (!is_clear_of_slots(w, sorted, w->bodies.count, p, bound)) return false;
    if (!is_clear_of_slots(w, came, came + w->arrived, p, bound)) return false;
    if (sorted == 0) return true;
    const cell_grid *g = &w->cells.grid;
    double far = bound + w->largest_bound + w->skin + w->found.way;
    cell_place low = cell_at(g, p.x - far, p.y - far, p.z - far);
    cell_place high = cell_at(g, p.x + far, p.y + far, p.z + far);
    for (int k = low.k; k <= high.k; k++)
        for (int j = low.j; j <= high.j; j++) {
            size_t row = row_of_cells(g, j, k);
            size_t from = w->cells.cell_first[row + (size_t)low.i];
            size_t to = w->cells.cell_first[row + (size_t)high.i + 1];
            if (!is_clear_of_slots(w, from, to, p, bound)) return false;
        }
    return true;
}

/* As they stand now: those of a part that moves are not where they were last listed. */
static bool is_clear_of_walls(clast_world *w, vec3 p, double bound) {
    share *s = &w->shares[0];
    double raise = w->special.fillets ? FILLET_RAISE * bound : 0;
    size_t count = walls_around(w, s, p, bound + raise);
    for (size_t k = 0; k < count; k++) {
        wall room;
        const wall *l = wall_now(w, s->around[k], &room);
        vec3 at = image_at_wall(w, l, p);
        double clear = bound + wall_raise(l, bound);
        if (l->def.kind != CLAST_WALL_PLANE && !is_in_box(l, at, clear)) continue;
        if (wall_approach(l, at).distance < clear) return false;
    }
    return true;
}

/* Every process looks at its own bodies, and all have to find it clear. */
static bool is_clear(clast_world *w, vec3 place, double bound) {
    double taken = !is_clear_of_bodies(w, place, bound) || !is_clear_of_walls(w, place, bound);
    ranks_reduce(w, &taken, 1, 0);
    return taken == 0;
}

static bool find_place(clast_world *w, feed *f, int index, int kind, vec3 *place) {
    double bound = w->shapes[kind].bound;
    for (int i = 0; i < f->def.attempts; i++) {
        *place = next_place(w, f, index);
        if (is_clear(w, *place, bound)) return true;
    }
    return false;
}

/* ---- delivery -------------------------------------------------------------------------------- */

/* The columns hold velocities of half a step ago: nothing but gravity and global damping will have
 * acted by the time of the position. */
static void put_body(clast_world *w, feed *f, int index, int kind, vec3 place) {
    double back = 1 + 0.5 * w->def.global_damping * w->dt;
    vec3 gravity = to_kernel(w, w->def.gravity);
    if (w->def.motion == CLAST_MOTION_IN_PLANE) gravity.z = 0;
    vec3 kick = v3_scale(0.5 * w->dt, from_kernel(w, gravity));
    clast_body_def def = {.shape = kind,
                          .position = place,
                          .orientation = turn_of_next(w, f, index),
                          .velocity = v3_sub(v3_scale(back, f->def.velocity), kick),
                          .spin = v3_scale(back, f->def.spin)};
    size_t slot = body_store_new(w, &def);
    ledger_add_body(w, slot);
    f->state.bodies++;
    f->state.mass += w->shapes[kind].mass;
    w->counters.fed++;
    w->stale = true;
    passage_note(w, &w->flow->arrivals, slot, index);
    clast_passage *p = &w->flow->arrivals.items[w->flow->arrivals.count - 1];
    p->velocity = f->def.velocity;
    if (w->ranks && ranks_nearest(w, place) != w->ranks->by->number) body_forget_arrived(w, slot);
}

static clast_status refuse(clast_world *w, feed *f, int kind) {
    const clast_feed_def *d = &f->def;
    f->state.refused++;
    f->state.rest_until = w->step + REST;
    if (d->full == CLAST_FULL_WAIT) return CLAST_OK;
    w->failed = true;
    return (clast_status)world_fail(
        w, CLAST_ERR_GUARD,
        "run failed at step %llu, t = %.9g s: feed %s found no room for a %s in %d attempts; it "
        "has fed %llu bodies, %.6g kg",
        (unsigned long long)w->step, clast_world_time(w), d->name, w->shapes[kind].name,
        d->attempts, (unsigned long long)f->state.bodies, f->state.mass);
}

static clast_status deliver(clast_world *w, feed *f, int index) {
    double owed = due(&f->def, clast_world_time(w));
    while (owed >= 0 && come(f) <= owed && w->step >= f->state.rest_until) {
        int kind = kind_of_next(w, f, index);
        vec3 place;
        if (!find_place(w, f, index, kind, &place)) return refuse(w, f, kind);
        uint64_t names = ((uint64_t)w->next_id + 1) * w->name_stride;
        if (names >= UINT32_MAX || w->next_id + 1 >= CLAST_WALL_ID) {
            w->failed = true;
            return (clast_status)world_fail(w, CLAST_ERR_GUARD,
                                            "run failed at step %llu: feed %s: more bodies than "
                                            "can be named",
                                            (unsigned long long)w->step, f->def.name);
        }
        put_body(w, f, index, kind, place);
    }
    return CLAST_OK;
}

/* Bodies that are due, between the moves of the bodies and the making of the lists. */
clast_status feeds_deliver(clast_world *w) {
    for (int i = 0; i < w->flow->feed_count; i++) {
        clast_status s = deliver(w, &w->flow->feeds[i], i);
        if (s) return s;
    }
    return CLAST_OK;
}
