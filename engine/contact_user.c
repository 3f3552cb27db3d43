/* contact_user.c - laws of the user's own: loaded from a shared object, called contact by contact,
 * and asked what the engine must know of a law: what it stores, how hard it pushes. */
#include "engine/contact_user.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "engine/clast_law.h"
#include "engine/fnv.h"
#include "engine/numbers.h"
#include "engine/world.h"

/* ---- loading --------------------------------------------------------------------------------- */

static clast_status refuse(clast_world *w, const char *path, const char *what) {
    return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT, "contact law %s: %s", path, what);
}

static clast_status check_entry(clast_world *w, const char *path, const char *name,
                                const clast_law_entry *entry) {
    if (!entry)
        return (clast_status)world_fail(w, CLAST_ERR_FORMAT, "contact law %s: has no '%s'", path,
                                        name);
    if (entry->version != CLAST_LAW_VERSION)
        return (clast_status)world_fail(w, CLAST_ERR_VERSION,
                                        "contact law %s: '%s' is of version %u, expected %d", path,
                                        name, (unsigned)entry->version, CLAST_LAW_VERSION);
    if (!entry->force)
        return (clast_status)world_fail(w, CLAST_ERR_FORMAT, "contact law %s: '%s' has no function",
                                        path, name);
    return CLAST_OK;
}

/* A checkpoint goes on under the law that it was made with. */
static uint64_t hash_of_file(const char *path) {
    uint64_t hash = FNV_START;
    fnv_file(&hash, path);
    return hash;
}

clast_status clast_world_use_law(clast_world *w, const char *path, const char *name) {
    CLAST_ASSERT(w && path && name && !w->prepared);
    if (w->def.law != CLAST_LAW_USER) return refuse(w, path, "the world has another law");
    if (w->def.precision != CLAST_PRECISION_DOUBLE)
        return refuse(w, path, "runs in double precision alone");
    if (clast_scheme_info_of(w->def.scheme)->implicit)
        return refuse(w, path, "runs with explicit schemes alone");
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return (clast_status)world_fail(w, CLAST_ERR_OPEN, "contact law %s: %s", path, dlerror());
    const clast_law_entry *entry = dlsym(library, name);
    clast_status status = check_entry(w, path, name, entry);
    if (status) {
        dlclose(library);
        return status;
    }
    user_law_free(w);
    w->user_law = (user_law){library, entry->force, hash_of_file(path)};
    return CLAST_OK;
}

void user_law_free(clast_world *w) {
    if (w->user_law.library) dlclose(w->user_law.library);
    w->user_law = (user_law){NULL, NULL, 0};
}

/* ---- asking ---------------------------------------------------------------------------------- */

static clast_law_pair pair_of(const pair_coef *c, double radius, double mass) {
    return (clast_law_pair){.parameter = c->parameter,
                            .friction = c->friction,
                            .cohesion = c->cohesion,
                            .e_star = c->e_star,
                            .g_star = c->g_star,
                            .radius = radius,
                            .mass = mass};
}

static clast_law_force ask(const clast_world *w, const clast_law_pair *pair,
                           const clast_law_touch *touch, clast_law_history *own) {
    clast_law_force force = {0};
    if (touch->overlap > 0) w->user_law.force(pair, touch, own, &force);
    return force;
}

/* At rest, with a history that stays as it is. */
static clast_law_force ask_at_rest(const clast_world *w, const clast_law_pair *pair, double overlap,
                                   clast_law_history own) {
    return ask(w, pair, &(clast_law_touch){.overlap = overlap}, &own);
}

double user_law_elastic_force(const clast_world *w, const pair_coef *c, double radius, double mass,
                              double overlap) {
    clast_law_pair pair = pair_of(c, radius, mass);
    return ask_at_rest(w, &pair, overlap, (clast_law_history){0}).elastic;
}

stored_energy user_law_stored_energy(const clast_world *w, const pair_coef *c, double radius,
                                     double mass, const history *h) {
    clast_law_pair pair = pair_of(c, radius, mass);
    clast_law_history own = {{h->spring.x, h->spring.y, h->spring.z}, h->plastic};
    clast_law_force f = ask_at_rest(w, &pair, h->overlap, own);
    return (stored_energy){f.normal_energy, f.tangential_energy};
}

/* Overlap at which the law has stored the energy of an impact; INFINITY for a law that stores too
 * little within a radius. */
static double overlap_of_impact(const clast_world *w, const clast_law_pair *pair, double speed) {
    double energy = 0.5 * pair->mass * speed * speed, low = 0, high = pair->radius;
    clast_law_history none = {0};
    if (!(ask_at_rest(w, pair, high, none).normal_energy > energy)) return INFINITY;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        if (ask_at_rest(w, pair, middle, none).normal_energy > energy)
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* N/m, at the largest overlap of an impact, where a law that hardens is stiffest; 0 when there is
 * none. */
double user_law_stiffness(const clast_world *w, const pair_coef *c, double radius, double mass,
                          double speed) {
    clast_law_pair pair = pair_of(c, radius, mass);
    double overlap = overlap_of_impact(w, &pair, speed);
    if (isinf(overlap)) return 0;
    double near = 1e-4 * overlap, more = user_law_elastic_force(w, c, radius, mass, overlap + near);
    return (more - user_law_elastic_force(w, c, radius, mass, overlap - near)) / (2 * near);
}

/* Tangential over normal stiffness at that overlap, of a spring that has not slipped: a dashpot
 * pushes alike in a step and in two, the spring twice. */
double user_law_tangent_ratio(const clast_world *w, const pair_coef *c, double radius, double mass,
                              double speed) {
    clast_law_pair pair = pair_of(c, radius, mass);
    double overlap = overlap_of_impact(w, &pair, speed), force[2];
    if (isinf(overlap)) return 0;
    double slip = 1e-9 * overlap; /* m/s: for one second and for two */
    for (int i = 0; i < 2; i++) {
        clast_law_history none = {0};
        clast_law_touch touch = {.overlap = overlap, .slip = {slip}, .dt = i + 1};
        force[i] = ask(w, &pair, &touch, &none).tangential[0];
    }
    double stiffness = (force[0] - force[1]) / slip;
    return stiffness > 0 ? stiffness / user_law_stiffness(w, c, radius, mass, speed) : 0;
}

/* ---- one contact ----------------------------------------------------------------------------- */

static clast_law_pair pair_at(const clast_world *w, const contact_place *at) {
    size_t a = (size_t)at->list->a[at->index], b = (size_t)at->list->b[at->index];
    const motion_row *ma = &w->rows.motion[body_of_sphere(w, a)];
    const pair_coef *row = &w->coefs[ma->material * w->material_count];
    double ra = w->rows.centre[a].radius;
    if (at->with_wall) return pair_of(&row[w->walls[b].def.material], ra, ma->mass);
    const motion_row *mb = &w->rows.motion[body_of_sphere(w, b)];
    double rb = w->rows.centre[b].radius;
    return pair_of(&row[mb->material], ra * rb / (ra + rb),
                   ma->mass * mb->mass / (ma->mass + mb->mass));
}

static clast_law_history history_in(history_lanes h, int i) {
    return (clast_law_history){{h.sx[i], h.sy[i], h.sz[i]}, h.plastic[i]};
}

static void keep_history(history_lanes h, int i, const clast_law_history *now, double overlap,
                         double normal) {
    h.overlap[i] = overlap, h.normal[i] = normal;
    h.sx[i] = now->spring[0], h.sy[i] = now->spring[1], h.sz[i] = now->spring[2];
    h.plastic[i] = now->memory;
}

/* Turned into the tangent plane of now at its length. */
static void turn_spring(clast_law_history *h, three n, law_need need) {
    three s = {h->spring[0], h->spring[1], h->spring[2]};
    double length2 = dot3(need, s, s);
    s = add3(need, s, -dot3(need, s, n), n);
    double flat2 = dot3(need, s, s), keep = flat2 > 0 ? sqrt(length2 / flat2) : 0;
    h->spring[0] = keep * s.x, h->spring[1] = keep * s.y, h->spring[2] = keep * s.z;
}

/* The bookkeeping of law_normal(): the work of the normal force from both ends of the step. */
static void book(batch *b, int i, const clast_law_force *now, double old_elastic, double old_normal,
                 double way) {
    double dashpots = (old_normal - old_elastic) + (now->normal - now->elastic);
    b->elastic[i] = -0.5 * (old_elastic + now->elastic) * way;
    b->dashpot[i] = -0.5 * dashpots * way;
}

void user_law_lane(const clast_world *w, const contact_place *at, batch *b, history_lanes h, int i,
                   law_choice choice, law_need need) {
    double overlap = b->depth[i], old_overlap = h.overlap[i];
    three n = {b->n[0][i], b->n[1][i], b->n[2][i]};
    clast_law_pair pair = pair_at(w, at);
    clast_law_history own = history_in(h, i);
    double old_elastic = ask_at_rest(w, &pair, old_overlap, own).elastic, rate = 0;
    clast_law_force f = {0};
    if (overlap > 0 || old_overlap > 0) {
        three slip = slip_of(b, i, n, need);
        rate = -dot3(need, slip, n);
        slip = add3(need, slip, rate, n);
        if (choice.advance > 0) turn_spring(&own, n, need);
        clast_law_touch touch = {overlap, rate, {slip.x, slip.y, slip.z}, choice.dt};
        f = ask(w, &pair, &touch, &own);
    }
    bool lasting = overlap > 0 && old_overlap > 0;
    double way = lasting ? overlap - old_overlap : choice.dt * rate;
    book(b, i, &f, old_elastic, h.normal[i], way);
    if (overlap == 0) own = (clast_law_history){0};
    keep_history(h, i, &own, overlap, f.normal);
    three f_t = {f.tangential[0], f.tangential[1], f.tangential[2]};
    three all = add3(need, f_t, f.normal, n);
    store3(b->f, i, all);
    store_torques(b, i, n, all, f_t, need);
}
