/* scheme_implicit.c - steps whose new positions depend on the forces there:
 *
 *     x1 = X0 + dt^2 (b a(x1, v1) + d dashpots(x1, v1)),    v1 linear in x1,
 *
 * for the translations of all bodies at once, by Newton's method (S12 3.7). Contacts are looked for
 * at every iteration (S12 3.8.1). The Jacobian has its rows multiplied by the masses, which makes
 * it symmetric (S12 3.47-3.50 is so for equal masses alone); it is in scheme_bonds.c. Rotation is
 * not implicit: torques are the mean of those at both ends of the step (S12 3.8.5), orientations go
 * by the torque at the start.
 *
 * Rows of the system are in the order of the bodies' ids, and contacts are added in the order of
 * their names, so the bits do not depend on storage or threads. */
#include <string.h>

#include "engine/scheme.h"

static const vec3 NOTHING = {0, 0, 0};

/* ---- room ------------------------------------------------------------------------------------ */

static void reserve(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    size_t rows = w->bodies.count, limit = (size_t)w->def.newton_iterations;
    if (!n->history) n->history = memory_grow(w, NULL, 0, limit, sizeof *n->history);
    if (rows <= n->row_room) return;
    double **columns[] = {&n->residual, &n->move, &n->last, &n->base, &n->reach, &n->scratch};
    size_t width[] = {3, 3, 3, 3, 2, SPARSE_SCRATCH};
    for (int k = 0; k < 6; k++)
        *columns[k] =
            memory_grow(w, *columns[k], width[k] * n->row_room, width[k] * rows, sizeof(double));
    n->row_room = rows;
}

/* ---- the system ------------------------------------------------------------------------------ */

/* What is known of the new position, and the first guess: with the forces of the start, which a
 * body in free flight keeps. (S12 starts from the old position.) */
static void guess(clast_world *w) {
    integrator *s = w->integrator;
    const clast_scheme_info *info = s->info;
    double dt2 = w->dt * w->dt;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 known = rule_position(s, &info->keep, i, w->dt, NOTHING);
        if (info->splits)
            known = v3_add(known, v3_scale(dt2 * info->dashpot, triple_at(s, DASHPOT, i)));
        triple_put(s, KNOWN, i, known);
        vec3 a = triple_at(s, A_AGO, i);
        body_place(w, i, v3_add(known, v3_scale(dt2 * info->keep.a_next, a)));
    }
    turn_bodies(w, 1);
}

/* Forces at the iterate. */
static void evaluate(clast_world *w) {
    const clast_scheme_info *info = w->integrator->info;
    if (info->splits && info->dashpot_next > 0) {
        split_forces(w);
        return;
    }
    if (info->splits) {
        elastic_forces(w, 0.5 * w->dt);
        return;
    }
    feel_velocities(w);
    trial_try(w, 0.5 * w->dt);
    take_accelerations(w, A_NEXT);
}

/* kg m: what the equation of each body misses, times minus its mass. */
static void find_residual(clast_world *w) {
    integrator *s = w->integrator;
    const clast_scheme_info *info = s->info;
    double dt2 = w->dt * w->dt;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 push = v3_scale(info->keep.a_next, triple_at(s, A_NEXT, i));
        if (info->splits)
            push = v3_add(push, v3_scale(info->dashpot_next, triple_at(s, DASHPOT, i)));
        vec3 miss =
            v3_sub(v3_add(triple_at(s, KNOWN, i), v3_scale(dt2, push)), body_position(w, i));
        miss = v3_scale(w->shapes[w->bodies.shape[i]].mass, miss);
        double *to = s->newton.residual + 3 * (size_t)s->newton.rank[w->bodies.id[i]];
        to[0] = miss.x, to[1] = miss.y, to[2] = miss.z;
    }
}

static vec3 v3_of(const double *d) {
    return v3(d[0], d[1], d[2]);
}

/* Newton's method can go to and fro across a kink: a contact that opens and closes from iterate to
 * iterate, a friction that slips and sticks. A body that turns back goes half its last way at most,
 * and half of that next, which closes in on the place; when it then wants on in one direction it
 * may go farther again. The linear law with a dashpot even jumps when a contact begins, so that no
 * position balances the forces: the place of the jump is what a step ends at. */
static vec3 held_move(newton_store *n, size_t row) {
    vec3 move = v3_of(n->move + 3 * row), last = v3_of(n->last + 3 * row);
    double *most = &n->reach[2 * row], *onwards = &n->reach[2 * row + 1], way = v3_norm(move);
    bool returns = v3_dot(move, last) < 0 && way > 0.25 * v3_norm(last);
    *onwards = returns ? 0 : *onwards + 1;
    *most = returns ? 0.5 * v3_norm(last) : *onwards < 2 ? 0.5 * *most : 2 * *most;
    return way > *most ? v3_scale(*most / way, move) : move;
}

/* Of all ways since the last begin_ways() the longest, of equals that of the lowest row; one that
 * is no number is longer than all. */
static void begin_ways(newton_store *n) {
    n->farthest = SIZE_MAX, n->way = 0;
}

static void note_way(newton_store *n, size_t row, double way) {
    bool first = row < n->farthest;
    bool farther =
        way == way ? way > n->way || (way == n->way && first) : n->way == n->way || first;
    if (farther) n->farthest = row, n->way = way;
}

/* Notes how far bodies go. */
static void move_bodies(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    for (size_t i = 0; i < w->bodies.count; i++) {
        size_t row = n->rank[w->bodies.id[i]];
        vec3 move = held_move(n, row);
        n->last[3 * row] = move.x, n->last[3 * row + 1] = move.y, n->last[3 * row + 2] = move.z;
        double way = v3_norm(move);
        if (way < INFINITY) body_place(w, i, v3_add(body_position(w, i), move));
        note_way(n, row, way);
    }
}

/* ---- Newton's method ------------------------------------------------------------------------- */

/* Iterations in which bodies are held one by one. Where these go round in circles, since what holds
 * one body is a push to its neighbours, all bodies go the same part of their ways after them. */
enum { HELD_ITERATIONS = 40 };

/* A body that stands at a jump of its force is pinned there: the others then go where they want to
 * while it stays, and not where they would if it went. */
static bool is_pinned(const newton_store *n, size_t row) {
    return n->reach[2 * row] == 0;
}

static void pin(newton_store *n, size_t row) {
    n->reach[2 * row] = 0;
    n->pinned++;
}

static void hold_pinned(newton_store *n) {
    for (size_t row = 0; n->pinned > 0 && row < n->rows; row++) {
        if (!is_pinned(n, row)) continue;
        double *block = sparse_diagonal(&n->matrix, row);
        for (int k = 0; k < 3; k++) n->residual[3 * row + (size_t)k] = 0, block[4 * k] *= 1e12;
    }
}

static void solve(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    bonds_assemble(w, w->integrator->info);
    hold_pinned(n);
    double tolerance = 1e-3 * w->def.newton_tolerance * w->smallest_radius;
    bool relax = w->def.linear_solver == CLAST_SOLVER_GAUSS_SEIDEL;
    sparse_solver *solver = relax ? sparse_gauss_seidel : sparse_conjugate_gradient;
    memset(n->move, 0, 3 * n->rows * sizeof *n->move);
    w->counters.linear_iterations +=
        solver(&n->matrix, n->residual, n->move, n->scratch, tolerance);
}

static void keep_base(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    for (size_t i = 0; i < w->bodies.count; i++) {
        double *to = n->base + 3 * (size_t)n->rank[w->bodies.id[i]];
        to[0] = w->bodies.x[i], to[1] = w->bodies.y[i], to[2] = w->bodies.z[i];
    }
}

/* Notes how far bodies go. */
static void go_part(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    for (size_t i = 0; i < w->bodies.count; i++) {
        size_t row = n->rank[w->bodies.id[i]];
        vec3 way = v3_scale(n->part, v3_of(n->move + 3 * row));
        n->last[3 * row] = way.x, n->last[3 * row + 1] = way.y, n->last[3 * row + 2] = way.z;
        body_place(w, i, v3_add(v3_of(n->base + 3 * row), way));
        note_way(n, row, v3_norm(way));
    }
}

/* kg2 m2, of the bodies that are not pinned. */
static double missed_here(const newton_store *n) {
    double missed = 0;
    for (size_t row = 0; row < n->rows; row++) {
        vec3 miss = v3_of(n->residual + 3 * row);
        if (n->pinned == 0 || !is_pinned(n, row)) missed += v3_dot(miss, miss);
    }
    return missed;
}

/* Newton's method with a search along its direction: a place that misses less than the best so far
 * becomes the base of the next direction, else half of the way is tried. At a jump of the force no
 * place misses nothing, and the way shrinks until it is as good as none. */
static void search(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    bool first = n->iterations == n->held_until;
    double missed = missed_here(n);
    if (first || missed < n->missed) {
        n->missed = missed;
        n->part = first ? 1 : fmin(2 * n->part, 1);
        keep_base(w);
        solve(w);
    } else {
        n->part *= 0.5;
    }
    go_part(w);
}

static void look(clast_world *w) {
    evaluate(w);
    bonds_rank(w);
    find_residual(w);
}

/* Returns how far the body goes that goes farthest (m); not a number where one is not. */
static double iterate(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    look(w);
    begin_ways(n);
    if (n->iterations >= n->held_until) {
        search(w);
    } else {
        solve(w);
        move_bodies(w);
    }
    return n->way;
}

/* ---- where a step ends ------------------------------------------------------------------------
 */

/* Bodies may go as far as they want. */
static void release(newton_store *n, size_t row) {
    for (int k = 0; k < 3; k++) n->last[3 * row + (size_t)k] = 0;
    n->reach[2 * row] = INFINITY, n->reach[2 * row + 1] = 0;
}

static void begin_held(newton_store *n) {
    n->held_until = n->iterations + HELD_ITERATIONS;
}

/* m, of the body that wants to go farthest by the last solution, whatever holds it. */
static double longest_wish(const newton_store *n) {
    double most = 0;
    for (size_t row = 0; row < n->rows; row++) most = fmax(most, v3_norm(v3_of(n->move + 3 * row)));
    return most;
}

/* From the base, where each wants to, and so far at most. */
static void go_a_little(clast_world *w, double far) {
    newton_store *n = &w->integrator->newton;
    for (size_t i = 0; i < w->bodies.count; i++) {
        size_t row = 3 * (size_t)n->rank[w->bodies.id[i]];
        vec3 way = v3_of(n->move + row);
        double length = v3_norm(way);
        if (length > far) way = v3_scale(far / length, way);
        body_place(w, i, v3_add(v3_of(n->base + row), way));
    }
}

/* m: how far the body wants to go by itself, which in a soft direction is far for the same miss
 * (kg m). */
static double own_wish(const newton_store *n, size_t row, vec3 miss) {
    double right[3] = {miss.x, miss.y, miss.z}, way[3];
    sparse_answer_alone(&n->matrix, row, right, way);
    return v3_norm(v3_of(way));
}

/* That bodies are held is no reason to end a step. It ends where the equations are fulfilled, or,
 * for a body whose force jumps (a contact of the linear law with a dashpot begins), at the jump:
 * what is missing is another thing a few tolerances on. Others are released. What is missing is
 * measured by the way that makes up for it: where nothing jumps, ways of so few tolerances change
 * that by less than half of what is not fulfilled. Notes the longest wish that stays open. */
static bool ends_here(clast_world *w, double tolerance) {
    enum { FAR = 4, FULFILLED = 4 * FAR };
    newton_store *n = &w->integrator->newton;
    bool ends = true;
    n->pinned = 0;
    look(w);
    solve(w);
    keep_base(w);
    double *before = n->scratch; /* of the linear solver, which is done */
    memcpy(before, n->residual, 3 * n->rows * sizeof *before);
    go_a_little(w, FAR * tolerance);
    look(w);
    begin_ways(n);
    for (size_t row = 0; row < n->rows; row++) {
        vec3 miss = v3_of(before + 3 * row), change = v3_sub(v3_of(n->residual + 3 * row), miss);
        double wish = own_wish(n, row, miss);
        bool missing = !(wish <= FULFILLED * tolerance);
        bool jumps = own_wish(n, row, change) > 0.5 * wish;
        release(n, row);
        if (missing && jumps) pin(n, row);
        if (missing && !jumps) note_way(n, row, wish), ends = false;
    }
    go_a_little(w, 0);
    if (ends) evaluate(w);
    return ends;
}

static void find_root(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    double tolerance = w->def.newton_tolerance * w->smallest_radius, way = 0;
    for (size_t row = 0; row < n->row_room; row++) release(n, row);
    n->converged = false;
    n->iterations = n->pinned = 0;
    begin_held(n);
    while (n->iterations < w->def.newton_iterations && !n->converged && way < INFINITY) {
        way = iterate(w);
        n->history[n->iterations++] = way;
        if (!(way <= tolerance)) continue;
        bool wishless = n->pinned == 0 && longest_wish(n) <= tolerance;
        n->converged = wishless || ends_here(w, tolerance);
        if (!n->converged && n->iterations > n->held_until) begin_held(n);
    }
}

/* Of the body that went farthest, or wants to. */
static clast_status complain(clast_world *w) {
    const newton_store *n = &w->integrator->newton;
    size_t who = 0;
    for (size_t i = 0; i < w->bodies.count; i++)
        if (n->rank[w->bodies.id[i]] == n->farthest) who = i;
    w->counters.unconverged++;
    return guards_unconverged(w, who, n->iterations, n->way);
}

/* ---- the step -------------------------------------------------------------------------------- */

/* `dashpots`: the columns with those of this step. */
static void keep_velocities(clast_world *w, int dashpots) {
    const integrator *s = w->integrator;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 v = rule_velocity(s, &s->info->kept, i, w->dt, body_position(w, i),
                               triple_at(s, A_NEXT, i));
        if (s->info->splits) v = v3_add(v, v3_scale(0.5 * w->dt, triple_at(s, dashpots, i)));
        body_speed_up(w, i, v);
    }
}

/* For a scheme that splits: forces at the new positions, and velocities with the dashpots of this
 * step: those of its end, or those of its start, which new ones take the place of. */
static void end_split(clast_world *w) {
    integrator *s = w->integrator;
    int dashpots = s->info->dashpot > 0 ? KNOWN : DASHPOT;
    for (size_t i = 0; i < w->bodies.count; i++) triple_put(s, KNOWN, i, triple_at(s, DASHPOT, i));
    split_forces(w);
    keep_velocities(w, dashpots);
}

clast_status step_implicit(clast_world *w) {
    newton_store *n = &w->integrator->newton;
    bool splits = w->integrator->info->splits;
    reserve(w);
    guess(w);
    find_root(w);
    clast_counters *c = &w->counters;
    c->newton_iterations += (uint64_t)n->iterations;
    if ((uint64_t)n->iterations > c->newton_most) c->newton_most = (uint64_t)n->iterations;
    if (!n->converged) {
        clast_status status = complain(w);
        if (status) return status;
    }
    if (splits)
        end_split(w);
    else
        feel_velocities(w);
    correct_momenta(w);
    if (!splits) keep_velocities(w, DASHPOT);
    clast_status status = step_settle(w, true);
    if (status) return status;
    c->force_evaluations++;
    take_accelerations(w, splits ? KNOWN : A_NEXT);
    return CLAST_OK;
}

clast_newton clast_world_newton(const clast_world *w) {
    CLAST_ASSERT(w);
    if (!w->integrator) return (clast_newton){true, 0, NULL};
    const newton_store *n = &w->integrator->newton;
    return (clast_newton){n->converged || n->iterations == 0, n->iterations, n->history};
}
