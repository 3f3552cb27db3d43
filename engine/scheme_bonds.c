/* scheme_bonds.c - the Jacobian of implicit schemes: what every touching contact resists a small
 * displacement with. Along the normal n the tangent stiffness of the law and its dashpot, across it
 * the normal force (which turns with n: S12 3.47-3.50) and the tangential spring and dashpot as if
 * it stuck. What turns the normal under a dashpot is left out, so Newton's method is quadratic for
 * elastic forces and close to it with damping. A sliding contact resists less than its row
 * says, which costs iterations, not the solution. */
#include <stdlib.h>
#include <string.h>

#include "engine/geometry.h"
#include "engine/scheme.h"

/* ---- one contact ----------------------------------------------------------------------------- */

static vec3 centre_of(const clast_world *w, int32_t sphere) {
    const centre_row *c = &w->rows.centre[sphere];
    return from_kernel(w, centre_at(c));
}

/* Towards a, with the distance (m) over which it turns: infinite at a wall. */
static vec3 normal_of(const clast_world *w, const contact_place *at, double *distance) {
    int32_t a = at->list->a[at->index], b = at->list->b[at->index];
    *distance = INFINITY;
    if (at->with_wall)
        return touch_of_wall(&w->walls[b], image_at_wall(w, &w->walls[b], centre_of(w, a)),
                             w->rows.centre[a].radius)
            .normal;
    vec3 d = separation(&w->period, centre_of(w, a), centre_of(w, b));
    *distance = v3_norm(d);
    return v3_scale(1 / *distance, d);
}

typedef struct resistance {
    double elastic;        /* N */
    double k, c, k_t, c_t; /* N/m, N s/m */
    double rising;         /* N/m, of the dashpot's force at this speed with the overlap */
} resistance;

/* First and second difference of the energy that the law stores: exact to 1e-7 for all of them. */
static resistance elastic_of(const clast_world *w, const contact_kind *k, history h) {
    double step = 1e-3 * h.overlap, energy[3];
    for (int i = 0; i < 3; i++) {
        history near = h;
        near.overlap += (i - 1) * step;
        energy[i] = law_stored_energy(w, k->coef, k->radius, k->mass, &near).normal;
    }
    double twice = (energy[2] - energy[1]) - (energy[1] - energy[0]);
    return (resistance){.elastic = 0.5 * (energy[2] - energy[0]) / step,
                        .k = twice / (step * step)};
}

/* Dashpots are 2 ratio sqrt(k m), or A times the slope of the spring (Brilliantov, S12 2.37). */
static resistance resistance_of(const clast_world *w, const contact_kind *kind, history h) {
    const pair_coef *p = kind->coef;
    resistance r = elastic_of(w, kind, h);
    double a = r.k / p->k_normal, root = sqrt(a * kind->mass);
    const clast_law_info *law = clast_law_info_of(w->def.law);
    if (law->dissipation) root = a;
    r.c = p->c_normal * root;
    double power = law->linear ? 0 : law->dissipation ? 0.5 : 0.25; /* of the overlap in c */
    r.rising = power * (h.normal - r.elastic) / h.overlap;
    if (!w->special.tangent) return r;
    r.k_t = law_has_spring(w) ? p->k_tangent * a : 0;
    r.c_t = p->c_tangent * root;
    return r;
}

typedef struct gathering {
    const clast_scheme_info *info;
    bond *bonds;
    size_t count;
} gathering;

static void gather(const clast_world *w, const contact_place *at, void *context) {
    gathering *g = context;
    const clast_scheme_info *info = g->info;
    history h = contact_history(w, at->list, at->index, at->with_wall);
    if (!(h.normal > 0)) return; /* it would pull: no force, no resistance */
    contact_kind kind = contact_kind_of(w, at);
    resistance r = resistance_of(w, &kind, h);
    double distance, dt = w->dt, speed = info->felt.x_next / dt; /* of v against x, 1/s */
    bond *b = &g->bonds[g->count++];
    b->name = record_of(w, at->list, at->index, at->with_wall);
    b->n = normal_of(w, at, &distance);
    double elastic = info->keep.a_next, dashpot = info->splits ? info->dashpot_next : elastic;
    double slip = r.k_t * 0.5 * dt + r.c_t;
    b->along = dt * dt * (elastic * r.k + dashpot * (speed * r.c + r.rising));
    b->across = dt * dt * (dashpot * speed * slip - elastic * h.normal / distance);
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* Rows go by id. */
void bonds_rank(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    if (w->next_id > n->rank_room) {
        n->rank = memory_grow(w, n->rank, n->rank_room, w->next_id, sizeof *n->rank);
        n->rank_room = w->next_id;
    }
    n->rows = 0;
    for (uint32_t id = 0; id < w->next_id; id++)
        if (w->slot_of_id[id] >= 0) n->rank[id] = (uint32_t)n->rows++;
}

static void gather_bonds(clast_world *w, const clast_scheme_info *info) {
    newton_store *n = &w->integrator->newton;
    size_t most = w->integrator->touching;
    if (most > n->bond_room) {
        size_t room = most + most / 4 + 16;
        n->bonds = memory_grow(w, n->bonds, n->bond_room, room, sizeof *n->bonds);
        n->bond_room = room;
    }
    gathering g = {info, n->bonds, 0};
    contacts_visit(w, gather, &g);
    n->bond_count = g.count;
    if (g.count > 1) qsort(n->bonds, g.count, sizeof *n->bonds, record_compare);
}

static bool is_same_pair(const bond *a, const bond *b) {
    return a->name.a == b->name.a && a->name.b == b->name.b;
}

/* Pairs of bodies with at least one bond. */
static void lay_out(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    size_t pairs = 0;
    sparse_reserve(w, &n->matrix, n->rows, n->bond_count);
    for (size_t k = 0; k < n->bond_count; k++) {
        const bond *b = &n->bonds[k];
        if (b->name.b >= CLAST_WALL_ID) continue;
        if (k > 0 && is_same_pair(b, b - 1)) continue;
        n->matrix.pair[pairs++] = (sparse_pair){n->rank[b->name.a], n->rank[b->name.b], 0, 0};
    }
    sparse_lay_out(&n->matrix, n->rows, pairs);
}

/* across I + (along - across) n n^T, less what a plane of motion does not let move. */
static void block_of(const clast_world *w, const bond *b, double block[9]) {
    double n[3] = {b->n.x, b->n.y, b->n.z};
    int still = w->def.motion == CLAST_MOTION_IN_PLANE ? w->def.plane_axis : -1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double value = (b->along - b->across) * (n[i] * n[j]) + (i == j ? b->across : 0);
            block[3 * i + j] = i == still || j == still ? 0 : value;
        }
}

static void add_block(double *to, const double *block, double sign) {
    for (int k = 0; k < 9; k++) to[k] += sign * block[k];
}

/* The mass, and what global damping takes of it. */
static void add_masses(clast_world *w, const clast_scheme_info *info) {
    newton_store *n = &w->integrator->newton;
    double dashpot = info->splits ? info->dashpot_next : info->keep.a_next;
    double more = 1 + w->dt * dashpot * info->felt.x_next * w->def.global_damping;
    for (size_t i = 0; i < w->bodies.count; i++) {
        double *d = sparse_diagonal(&n->matrix, n->rank[w->bodies.id[i]]);
        double mass = w->shapes[w->bodies.shape[i]].mass * more;
        d[0] = d[4] = d[8] = mass;
    }
}

/* The Jacobian at the last trial, rows times masses. */
void bonds_assemble(clast_world *w, const clast_scheme_info *info) {
    newton_store *n = &w->integrator->newton;
    gather_bonds(w, info);
    lay_out(w);
    add_masses(w, info);
    size_t pair = 0;
    for (size_t k = 0; k < n->bond_count; k++) {
        const bond *b = &n->bonds[k];
        bool again = k > 0 && is_same_pair(b, b - 1);
        double block[9];
        block_of(w, b, block);
        add_block(sparse_diagonal(&n->matrix, n->rank[b->name.a]), block, 1);
        if (b->name.b >= CLAST_WALL_ID) continue;
        if (!again) pair++;
        const sparse_pair *at = &n->matrix.pair[pair - 1];
        add_block(sparse_diagonal(&n->matrix, n->rank[b->name.b]), block, 1);
        add_block(n->matrix.block + 9 * at->upper, block, -1);
        add_block(n->matrix.block + 9 * at->lower, block, -1);
    }
}

void bonds_free(newton_store *n) {
    memory_release(n->bonds), memory_release(n->rank), memory_release(n->history);
    memory_release(n->residual), memory_release(n->move), memory_release(n->last);
    memory_release(n->reach), memory_release(n->base), memory_release(n->scratch);
    sparse_free(&n->matrix);
}
