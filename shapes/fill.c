#include "shapes/fill.h"

#include <stdlib.h>
#include <string.h>

#include "shapes/check.h"
#include "shapes/deviation.h"
#include "shapes/numbers.h"
#include "shapes/symmetry.h"

enum { SAMPLES = 1500, SEEDS_MESH = 4000, SEEDS_BLOCK = 1500, SEEDS_OUTLINE = 400 };

/* Of a deviation that is asked for: places looked at in one round, seeds beside each, rounds in
 * vain after which it is given up, and to what part of it these places are filled: those beside
 * them lie a little farther. */
enum { PLACES = 64, SEEDS_PLACE = 16, IDLE_ROUNDS = 6 };
static const double BOUND_PART = 0.98;

typedef struct orbit {
    int first, size; /* in `pool` */
    double bound;    /* no more than this is gained by it, per sphere */
} orbit;

/* Samples stand in the order of the triangles, so neighbours in the list are neighbours in space: a
 * sphere that cannot come nearer to any of a batch than the clump is passes it by. */
enum { BATCH = 25 };

typedef struct batch {
    shape_vec middle;
    double radius;   /* m, of the batch */
    double distance; /* m, the largest of its samples */
} batch;

typedef struct sampling {
    int count;
    shape_vec *point;
    double *distance; /* m, from the clump so far */
    batch *batches;
} sampling;

typedef struct filler {
    const shape_target *target;
    const shape_stops *stops;
    sampling at;        /* first of the part of the surface that the symmetry repeats */
    shape_sphere *pool; /* spheres of all orbits */
    orbit *orbits;
    int pool_count, pool_room, orbit_count, orbit_room;
    double smallest; /* m, candidates are larger */
    double inscribed;
} filler;

typedef struct clump_so_far {
    shape_sphere *spheres;
    int *level; /* NULL: not asked for */
    int count, orbits;
} clump_so_far;

double shape_density_deviation(double density) {
    SHAPE_ASSERT(density >= 1);
    double x = 1 / density; /* mean of 1 - sqrt(1 - t^2) for |t| <= x */
    return 1 - 0.5 * (sqrt(1 - x * x) + shape_asin(x) / x);
}

static void *grown(void *old, int *room, size_t size) {
    *room = *room ? 2 * *room : 1024;
    void *p = realloc(old, (size_t)*room * size);
    SHAPE_ASSERT(p);
    return p;
}

/* ---- candidates ------------------------------------------------------------------------------ */

/* The largest sphere inside that touches the surface at p; radius 0 where there is none. */
static shape_sphere touching_sphere(const shape_target *t, shape_vec p, shape_vec normal) {
    double r = t->size;
    shape_vec q, c = p;
    for (int i = 0; i < 80 && r > 1e-9 * t->size; i++) {
        c = sv_along(p, -r, normal);
        double inside = -shape_target_distance(t, c, &q, NULL);
        if (inside > 0 && inside >= r * (1 - 1e-9) - t->slack) return (shape_sphere){c, r};
        shape_vec chord = sv_sub(p, q); /* beyond a sharp edge the centre may lie outside */
        double lift = 2 * sv_dot(normal, chord), square = sv_dot(chord, chord);
        double next = lift > 0 ? square / lift : 0.5 * r;
        r = next < 0.999 * r ? next : 0.999 * r;
    }
    return (shape_sphere){c, 0};
}

/* Moves a sphere that nearly falls on images of itself to where it does: onto the planes and axes
 * of symmetry, where fewer spheres do the same. */
static void snap(const shape_target *t, shape_symmetry *s, shape_sphere *one) {
    shape_vec sum = {0, 0, 0};
    int near = 0;
    for (int k = 0; k < s->count; k++) {
        shape_vec image = shape_image(s->matrix[k], one->centre);
        if (sv_distance(image, one->centre) > 0.35 * one->radius) continue;
        sum = sv_add(sum, image);
        near++;
    }
    if (near < 2) return;
    one->centre = sv_scale(1.0 / near, sum);
    one->radius = -shape_target_distance(t, one->centre, NULL, NULL);
}

static void add_orbit(filler *f, shape_symmetry *s, shape_sphere one) {
    if (f->orbit_count == f->orbit_room)
        f->orbits = grown(f->orbits, &f->orbit_room, sizeof *f->orbits);
    orbit *o = &f->orbits[f->orbit_count++];
    *o = (orbit){f->pool_count, 0, HUGE_VAL};
    for (int k = 0; k < s->count; k++) {
        shape_vec image = shape_image(s->matrix[k], one.centre);
        bool known = false;
        for (int i = 0; i < o->size && !known; i++)
            known = sv_distance(f->pool[o->first + i].centre, image) < 1e-6 * one.radius;
        if (known) continue;
        if (f->pool_count == f->pool_room) f->pool = grown(f->pool, &f->pool_room, sizeof *f->pool);
        f->pool[f->pool_count++] = (shape_sphere){image, one.radius};
        o->size++;
    }
}

/* Seeds of a body of revolution lie in one half plane. */
static shape_vec to_half_plane(shape_vec p, int axis, double *sine, double *cosine) {
    double at[3] = {p.x, p.y, p.z}, out[3];
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double rho = sqrt(at[u] * at[u] + at[v] * at[v]);
    *cosine = rho > 0 ? at[u] / rho : 1, *sine = rho > 0 ? at[v] / rho : 0;
    out[axis] = at[axis], out[u] = rho, out[v] = 0;
    return sv(out[0], out[1], out[2]);
}

static shape_vec turned_back(shape_vec n, int axis, double sine, double cosine) {
    double at[3] = {n.x, n.y, n.z}, out[3];
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    out[axis] = at[axis];
    out[u] = cosine * at[u] + sine * at[v], out[v] = cosine * at[v] - sine * at[u];
    return sv(out[0], out[1], out[2]);
}

/* Half a step further round: two such orbits together make a ring of twice as many. */
static shape_sphere between(const filler *f, shape_sphere one, int in_ring) {
    int axis;
    if (!shape_has_axis(f->target, &axis)) return one;
    double at[3] = {one.centre.x, one.centre.y, one.centre.z}, s, c;
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    shape_sincos(SHAPE_PI / in_ring, &s, &c);
    double across = c * at[u] - s * at[v];
    at[v] = s * at[u] + c * at[v], at[u] = across;
    return (shape_sphere){sv(at[0], at[1], at[2]), one.radius};
}

/* Returns false where the sphere falls on the axis: there all groups give the same. */
static bool add_images(filler *f, shape_symmetry *s, shape_sphere one) {
    double least = fmax(f->smallest, 1e-4 * f->target->size);
    snap(f->target, s, &one);
    f->inscribed = fmax(f->inscribed, one.radius);
    if (!(one.radius > least)) return true;
    add_orbit(f, s, one);
    return f->orbits[f->orbit_count - 1].size > 2;
}

static void add_candidate(filler *f, shape_vec p, shape_vec normal, shape_symmetry *groups,
                          int group_count) {
    shape_sphere raw = touching_sphere(f->target, p, normal);
    f->inscribed = fmax(f->inscribed, raw.radius);
    if (!(raw.radius > f->smallest)) return;
    for (int g = 0; g < group_count; g++) {
        bool rings = group_count > 1;
        if (!add_images(f, &groups[g], raw) && rings) break;
        if (rings) add_images(f, &groups[g], between(f, raw, groups[g].ring));
    }
}

static shape_symmetry *groups_of(const shape_target *t, int *count) {
    shape_symmetry *groups = malloc(SYMMETRY_RINGS * sizeof *groups);
    SHAPE_ASSERT(groups);
    *count = 0;
    while (*count < SYMMETRY_RINGS && shape_symmetry_of(t, *count, &groups[*count])) ++*count;
    return groups;
}

static void find_candidates(filler *f) {
    int axis, group_count;
    bool turns = shape_has_axis(f->target, &axis);
    int seeds = turns                                  ? SEEDS_OUTLINE
                : f->target->source == SHAPE_FROM_MESH ? SEEDS_MESH
                                                       : SEEDS_BLOCK;
    shape_vec *point = malloc((size_t)seeds * sizeof *point);
    shape_vec *normal = malloc((size_t)seeds * sizeof *normal);
    shape_symmetry *groups = groups_of(f->target, &group_count);
    SHAPE_ASSERT(point && normal);
    shape_target_samples(f->target, seeds, point, normal);
    for (int i = 0; i < seeds; i++) {
        if (turns) {
            double s, c;
            point[i] = to_half_plane(point[i], axis, &s, &c);
            normal[i] = turned_back(normal[i], axis, s, c);
        }
        add_candidate(f, point[i], normal[i], groups, group_count);
    }
    free(point), free(normal), free(groups);
}

/* ---- choice
 * ---------------------------------------------------------------------------------------- */

static double outside(shape_sphere one, shape_vec p) {
    double d = sv_distance(p, one.centre) - one.radius;
    return d > 0 ? d : 0;
}

/* What the orbit gains of one batch. */
static double batch_gain(const filler *f, const orbit *o, int which) {
    const batch *b = &f->at.batches[which];
    double nearest[BATCH], gain = 0;
    int first = which * BATCH, count = f->at.count - first < BATCH ? f->at.count - first : BATCH;
    bool met = false;
    for (int i = 0; i < o->size; i++) {
        shape_sphere one = f->pool[o->first + i];
        shape_vec way = sv_sub(b->middle, one.centre);
        double far = one.radius + b->distance + b->radius;
        if (sv_dot(way, way) >= far * far) continue;
        if (!met) memcpy(nearest, f->at.distance + first, (size_t)count * sizeof *nearest);
        met = true;
        for (int s = 0; s < count; s++) {
            shape_vec arm = sv_sub(f->at.point[first + s], one.centre);
            double reach = one.radius + nearest[s], square = sv_dot(arm, arm);
            if (square >= reach * reach) continue;
            double d = sqrt(square) - one.radius;
            nearest[s] = d > 0 ? d : 0;
        }
    }
    for (int s = 0; s < count && met; s++)
        gain += (f->at.distance[first + s] - nearest[s]) * (f->at.distance[first + s] + nearest[s]);
    return gain;
}

static int batch_count(const filler *f) {
    return (f->at.count + BATCH - 1) / BATCH;
}

static double gain_of(const filler *f, const orbit *o) {
    double gain = 0;
    for (int b = 0; b < batch_count(f); b++) gain += batch_gain(f, o, b);
    return gain / o->size;
}

/* The orbit with the most gain among those that fit; gains only fall from round to round, so old
 * ones are bounds and few have to be worked out again. NULL when nothing is gained. */
static orbit *best_orbit(filler *f, int room) {
    for (;;) {
        orbit *best = NULL;
        for (int i = 0; i < f->orbit_count; i++) {
            orbit *o = &f->orbits[i];
            if (o->size <= room && o->bound > 0 && (!best || o->bound > best->bound)) best = o;
        }
        if (!best) return NULL;
        double old = best->bound;
        best->bound = gain_of(f, best);
        bool still = true;
        for (int i = 0; i < f->orbit_count && still && best->bound < old; i++) {
            const orbit *o = &f->orbits[i];
            still = o->size > room || o->bound <= best->bound;
        }
        if (still && best->bound > 0) return best;
    }
}

static void measure_batches(filler *f) {
    for (int b = 0; b < batch_count(f); b++) {
        f->at.batches[b].distance = 0;
        for (int s = b * BATCH; s < (b + 1) * BATCH && s < f->at.count; s++)
            f->at.batches[b].distance = fmax(f->at.batches[b].distance, f->at.distance[s]);
    }
}

/* The largest spheres inside come first, whichever of them gains most: with nothing placed yet
 * every sphere gains from every sample. NULL when none of them fits. */
static orbit *first_orbit(filler *f, int room) {
    orbit *best = NULL;
    for (int i = 0; i < f->orbit_count; i++) {
        orbit *o = &f->orbits[i];
        if (o->size > room || f->pool[o->first].radius < 0.999 * f->inscribed) continue;
        o->bound = gain_of(f, o);
        if (!best || o->bound > best->bound) best = o;
    }
    return best;
}

static void come_near(sampling *at, const shape_sphere *spheres, int count) {
    for (int s = 0; s < at->count; s++)
        for (int i = 0; i < count; i++)
            at->distance[s] = fmin(at->distance[s], outside(spheres[i], at->point[s]));
}

static void take(filler *f, orbit *o, shape_sphere *to) {
    memcpy(to, &f->pool[o->first], (size_t)o->size * sizeof *to);
    come_near(&f->at, to, o->size);
    measure_batches(f);
    o->bound = 0;
}

static double mean_distance(const filler *f) {
    double sum = 0;
    for (int s = 0; s < f->at.count; s++) sum += f->at.distance[s];
    return sum / f->at.count;
}

static double largest_distance(const filler *f) {
    double largest = 0;
    for (int s = 0; s < f->at.count; s++) largest = fmax(largest, f->at.distance[s]);
    return largest;
}

static bool is_dense(const filler *f) {
    double density = f->stops->density;
    return density >= 1 && mean_distance(f) <= shape_density_deviation(density) * f->inscribed;
}

/* At the samples alone where a deviation is asked for. */
static bool seems_met(const filler *f) {
    double deviation = f->stops->deviation;
    return is_dense(f) || (deviation > 0 && largest_distance(f) <= deviation);
}

/* The density whose row would have this mean distance, by halving. */
static double density_of(double mean) {
    double low = 1, high = 1e4;
    if (mean > shape_density_deviation(1)) return 0;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        *(shape_density_deviation(middle) > mean ? &low : &high) = middle;
    }
    return low;
}

/* Samples of the whole surface, of which those stay that are no images of others. */
static void take_samples(filler *f) {
    shape_symmetry *common = malloc(sizeof *common);
    SHAPE_ASSERT(common);
    shape_common_symmetry(f->target, common);
    int all = SAMPLES * common->count;
    sampling *at = &f->at;
    at->point = malloc((size_t)all * sizeof *at->point);
    at->distance = malloc((size_t)all * sizeof *at->distance);
    shape_vec *normal = malloc((size_t)all * sizeof *normal);
    SHAPE_ASSERT(at->point && at->distance && normal);
    shape_target_samples(f->target, all, at->point, normal);
    for (int i = 0; i < all; i++)
        if (shape_in_first_part(common, at->point[i])) at->point[at->count++] = at->point[i];
    SHAPE_ASSERT(at->count > 0);
    for (int s = 0; s < at->count; s++) at->distance[s] = f->target->size;
    free(normal), free(common);
}

static void make_batches(filler *f) {
    f->at.batches = calloc((size_t)batch_count(f), sizeof *f->at.batches);
    SHAPE_ASSERT(f->at.batches);
    for (int b = 0; b < batch_count(f); b++) {
        int first = b * BATCH, end = first + BATCH < f->at.count ? first + BATCH : f->at.count;
        batch *one = &f->at.batches[b];
        for (int s = first; s < end; s++)
            one->middle = sv_along(one->middle, 1.0 / (end - first), f->at.point[s]);
        for (int s = first; s < end; s++)
            one->radius = fmax(one->radius, sv_distance(f->at.point[s], one->middle));
    }
    measure_batches(f);
}

static void free_sampling(sampling *at) {
    free(at->point), free(at->distance), free(at->batches);
}

static void begin(filler *f, const shape_target *target, const shape_stops *stops) {
    *f = (filler){.target = target, .stops = stops, .smallest = stops->smallest};
    take_samples(f);
    make_batches(f);
}

static bool can_be_told(const filler *f) {
    double deviation = f->stops->deviation;
    return deviation > 0 && deviation >= shape_deviation_least(f->target);
}

static bool is_met(const filler *f, const shape_sphere *spheres, int count) {
    shape_vec place;
    if (count == 0 || !seems_met(f)) return false;
    if (is_dense(f)) return true;
    return can_be_told(f) &&
           !shape_places_beyond(f->target, spheres, count, f->stops->deviation, &place, 1);
}

static shape_filling finish(filler *f, const shape_sphere *spheres, int count) {
    const shape_stops *stop = f->stops;
    shape_filling result = {.count = count,
                            .inscribed = f->inscribed,
                            .density = density_of(mean_distance(f) / f->inscribed)};
    result.met = !(stop->density >= 1 || stop->deviation > 0) || is_met(f, spheres, count);
    free_sampling(&f->at), free(f->pool), free(f->orbits);
    return result;
}

static void check_stops(const shape_stops *stops) {
    SHAPE_ASSERT(stops && stops->spheres >= 0 && stops->spheres <= SHAPE_SPHERES_MAX);
    SHAPE_ASSERT(stops->density == 0 || stops->density >= 1);
    SHAPE_ASSERT(stops->spheres > 0 || stops->density >= 1 || stops->deviation > 0);
}

/* The next orbit for so many spheres at most. Where the best one is too large, a small one may take
 * its place, but not for next to nothing: small spheres make steps small. */
static orbit *next_orbit(filler *f, int room, bool is_first) {
    orbit *largest = is_first ? first_orbit(f, room) : NULL;
    if (largest) return largest;
    orbit *best = best_orbit(f, SHAPE_SPHERES_MAX);
    if (!best || best->size <= room) return best;
    orbit *fits = best_orbit(f, room);
    return fits && fits->bound > 0.25 * best->bound ? fits : NULL;
}

static void append(clump_so_far *c, filler *f, orbit *o) {
    take(f, o, c->spheres + c->count);
    for (int i = 0; i < o->size && c->level; i++) c->level[c->count + i] = c->orbits;
    c->count += o->size;
    c->orbits++;
}

/* ---- the last places ------------------------------------------------------------------------- */

/* Candidates that touch the surface near the places of `f->at`; which ones hangs on the round. */
static void find_candidates_near(filler *f, int round) {
    int group_count;
    shape_symmetry *groups = groups_of(f->target, &group_count);
    double reach = 3 * f->stops->deviation;
    for (int i = 0; i < f->at.count * SEEDS_PLACE; i++) {
        uint64_t place = (uint64_t)round * PLACES * SEEDS_PLACE + (uint64_t)i;
        shape_vec normal, at = f->at.point[i % f->at.count];
        at.x += reach * (2 * shape_even(3, 0, place) - 1);
        at.y += reach * (2 * shape_even(3, 1, place) - 1);
        at.z += reach * (2 * shape_even(3, 2, place) - 1);
        shape_target_distance(f->target, at, &at, &normal);
        add_candidate(f, at, normal, groups, group_count);
    }
    free(groups);
}

static void value_orbits(filler *f) {
    for (int i = 0; i < f->orbit_count; i++) {
        orbit *o = &f->orbits[i];
        o->bound = f->pool[o->first].radius > f->smallest ? gain_of(f, o) : 0;
    }
}

/* Fills at the places of `f->at`, beside which it looks for candidates that it then forgets. */
static void fill_places(filler *f, clump_so_far *c, int limit, int round) {
    int orbits = f->orbit_count, pool = f->pool_count;
    for (int s = 0; s < f->at.count; s++) f->at.distance[s] = f->target->size;
    come_near(&f->at, c->spheres, c->count);
    make_batches(f);
    find_candidates_near(f, round);
    value_orbits(f);
    while (c->count < limit && largest_distance(f) > BOUND_PART * f->stops->deviation) {
        orbit *o = next_orbit(f, limit - c->count, false);
        if (!o) break;
        append(c, f, o);
    }
    f->orbit_count = orbits, f->pool_count = pool;
}

/* What the samples pass by: looks for places beyond the deviation, fills there, and looks again.
 * Any corner is reached by spheres small enough, but small spheres make steps small: radii below
 * the deviation are taken where larger ones were tried in vain. */
static void fill_beyond(filler *f, clump_so_far *c, int limit) {
    sampling even = f->at;
    double inscribed = f->inscribed;
    f->at = (sampling){.point = malloc(PLACES * sizeof *f->at.point),
                       .distance = malloc(PLACES * sizeof *f->at.distance)};
    SHAPE_ASSERT(f->at.point && f->at.distance);
    for (int round = 0, idle = 0; c->count < limit && idle < IDLE_ROUNDS; round++) {
        int before = c->count;
        f->at.count = shape_places_beyond(f->target, c->spheres, c->count, f->stops->deviation,
                                          f->at.point, PLACES);
        if (f->at.count == 0) break;
        f->smallest = fmax(f->stops->smallest, f->stops->deviation / (1 << idle));
        fill_places(f, c, limit, round);
        free(f->at.batches), f->at.batches = NULL;
        come_near(&even, c->spheres + before, c->count - before);
        idle = c->count == before ? idle + 1 : 0;
    }
    free_sampling(&f->at);
    f->at = even, f->inscribed = inscribed;
}

shape_filling shape_fill(const shape_target *target, const shape_stops *stops,
                         shape_sphere *spheres, int *level) {
    SHAPE_ASSERT(target && spheres);
    check_stops(stops);
    filler f;
    begin(&f, target, stops);
    find_candidates(&f);
    int limit = stops->spheres > 0 ? stops->spheres : SHAPE_SPHERES_MAX;
    clump_so_far c = {.spheres = spheres, .level = level};
    while (c.count < limit && !(c.count > 0 && seems_met(&f))) {
        orbit *o = next_orbit(&f, limit - c.count, c.count == 0);
        if (!o) break;
        append(&c, &f, o);
    }
    if (can_be_told(&f) && c.count > 0 && !is_dense(&f)) fill_beyond(&f, &c, limit);
    return finish(&f, spheres, c.count);
}

static void measure_row(filler *f, const shape_sphere *spheres, int count) {
    f->inscribed = 0;
    for (int i = 0; i < count; i++) f->inscribed = fmax(f->inscribed, spheres[i].radius);
    for (int s = 0; s < f->at.count; s++) f->at.distance[s] = f->target->size;
    come_near(&f->at, spheres, count);
}

shape_filling shape_fill_row(const shape_target *target, const shape_stops *stops,
                             shape_sphere *spheres) {
    SHAPE_ASSERT(target && target->source == SHAPE_FROM_PROFILE && spheres);
    check_stops(stops);
    filler f;
    begin(&f, target, stops);
    bool asks = stops->density >= 1 || stops->deviation > 0;
    int limit = stops->spheres > 0 ? stops->spheres : SHAPE_SPHERES_MAX / 4, count = 0;
    for (int n = asks ? 1 : limit; n <= limit; n++) {
        count = shape_profile_fit(&target->profile, n, spheres);
        measure_row(&f, spheres, count);
        if (asks && is_met(&f, spheres, count)) break;
    }
    return finish(&f, spheres, count);
}
