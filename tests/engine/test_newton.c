/* Implicit steps: the linear solvers, the Jacobian, how Newton's method converges and what is said
 * when it does not, and a pile against the leapfrog at tiny steps. */
#include "tests/support/bed.h"
#include "tests/support/scene.h"

#include "engine/scheme.h"

/* ---- linear solvers -------------------------------------------------------------------------- */

/* A chain of blocks with springs between them and a few farther links. */
static void fill(clast_world *w, sparse_matrix *m, dice *d, size_t rows) {
    size_t pairs = 0;
    sparse_reserve(w, m, rows, 2 * rows);
    for (uint32_t r = 0; r + 1 < rows; r++) {
        m->pair[pairs++] = (sparse_pair){r, r + 1, 0, 0};
        if (r % 3 == 0 && r + 7 < rows) m->pair[pairs++] = (sparse_pair){r, r + 7, 0, 0};
    }
    sparse_lay_out(m, rows, pairs);
    for (size_t r = 0; r < rows; r++)
        for (int i = 0; i < 3; i++) sparse_diagonal(m, r)[4 * i] = roll(d, 0.3, 2);
    for (size_t k = 0; k < pairs; k++) {
        double n[3] = {roll(d, -1, 1), roll(d, -1, 1), roll(d, -1, 1)};
        for (int i = 0; i < 9; i++) {
            double value = n[i / 3] * n[i % 3];
            sparse_diagonal(m, m->pair[k].a)[i] += value;
            sparse_diagonal(m, m->pair[k].b)[i] += value;
            m->block[9 * m->pair[k].upper + (size_t)i] -= value;
            m->block[9 * m->pair[k].lower + (size_t)i] -= value;
        }
    }
}

static void both_solvers_solve(void **state) {
    (void)state;
    enum { ROWS = 60, SIZE = 3 * ROWS };
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    clast_world *w = new_world(&def);
    dice d = {11, 0};
    sparse_matrix m = {0};
    fill(w, &m, &d, 20); /* grows */
    fill(w, &m, &d, ROWS);
    double want[SIZE], right[SIZE], x[SIZE], scratch[SPARSE_SCRATCH * ROWS];
    for (int i = 0; i < SIZE; i++) want[i] = roll(&d, -1, 1);
    sparse_apply(&m, want, right);
    sparse_solver *solvers[2] = {sparse_gauss_seidel, sparse_conjugate_gradient};
    for (int k = 0; k < 2; k++) {
        memset(x, 0, sizeof x);
        uint64_t n = solvers[k](&m, right, x, scratch, 1e-12);
        double worst = 0;
        for (int i = 0; i < SIZE; i++) worst = fmax(worst, fabs(x[i] - want[i]));
        print_message("%s: %llu iterations, off by %.1e\n",
                      k ? "conjugate gradient" : "Gauss-Seidel", (unsigned long long)n, worst);
        CHECK_BELOW(worst, 1e-10);
        CHECK_BELOW((double)n, k ? 100 : 500);
    }
    sparse_free(&m);
    clast_world_free(w);
}

/* ---- a cluster under pressure ---------------------------------------------------------------- */

enum { BALLS = 5 };

static clast_world *cluster(clast_law law, clast_scheme scheme, double restitution, double step,
                            clast_linear_solver solver) {
    clast_world_def def = bare_def(law);
    def.gravity = vec(0.4, -0.2, -9.81);
    def.scheme = scheme, def.time_step = step, def.linear_solver = solver;
    def.max_residual = 1e9, def.max_displacement = 10;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(restitution, 0);
    two_materials m = add_materials(w, &pair);
    int shapes[2] = {clast_shape_add_sphere(w, "small", 0.0041, m.soft),
                     clast_shape_add_sphere(w, "large", 0.0053, m.hard)};
    int box = clast_part_add(w, &(clast_part_def){.name = "floor"});
    add_plane(w, box, m.hard, vec(0, 0, 0), vec(0.1, 0.05, 1));
    const clast_vec3 at[BALLS] = {{0, 0, 0.0040},
                                  {0.0091, 0.0009, 0.0043},
                                  {0.0037, 0.0080, 0.0032},
                                  {0.0041, 0.0026, 0.0106},
                                  {-0.0046, 0.0080, 0.0046}};
    for (int i = 0; i < BALLS; i++)
        add_body(w, shapes[i % 2], at[i], vec(0.02 * i, -0.03, -0.05), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

/* ---- the Jacobian ---------------------------------------------------------------------------- */

/* m (x - dt^2 b a(x)) of all bodies, by id; scheme without dashpots. */
static void residual_at(clast_world *w, const double *x, double *to) {
    const clast_scheme_info *info = clast_scheme_info_of(w->def.scheme);
    for (uint32_t id = 0; id < BALLS; id++) {
        size_t i = (size_t)w->slot_of_id[id];
        body_place(w, i, vec(x[3 * id], x[3 * id + 1], x[3 * id + 2]));
    }
    trial_try(w, 0.5 * w->dt);
    take_accelerations(w, A_NEXT);
    for (uint32_t id = 0; id < BALLS; id++) {
        size_t i = (size_t)w->slot_of_id[id];
        double mass = w->shapes[w->bodies.shape[i]].mass;
        clast_vec3 a = triple_at(w->integrator, A_NEXT, i);
        clast_vec3 push = times(w->dt * w->dt * info->keep.a_next, a);
        double *r = to + 3 * id;
        r[0] = mass * (x[3 * id] - push.x), r[1] = mass * (x[3 * id + 1] - push.y);
        r[2] = mass * (x[3 * id + 2] - push.z);
    }
}

static void the_jacobian_is_the_derivative(void **state) {
    (void)state;
    enum { SIZE = 3 * BALLS };
    for (int l = 0; l < 2; l++) {
        clast_world *w =
            cluster(l ? CLAST_LAW_LINEAR : CLAST_LAW_HERTZ_MINDLIN, CLAST_SCHEME_NEWMARK_BETA, 1,
                    2e-4, CLAST_SOLVER_CONJUGATE_GRADIENT);
        double x[SIZE], low[SIZE], high[SIZE], column[SIZE], unit[SIZE], largest = 0, worst = 0;
        for (uint32_t id = 0; id < BALLS; id++) {
            body_state b = body_of(w, (int)id);
            x[3 * id] = b.position.x, x[3 * id + 1] = b.position.y, x[3 * id + 2] = b.position.z;
        }
        trial_begin(w);
        residual_at(w, x, low);
        bonds_rank(w);
        bonds_assemble(w, clast_scheme_info_of(CLAST_SCHEME_NEWMARK_BETA));
        print_message("%zu bonds\n", w->integrator->newton.bond_count);
        assert_true(w->integrator->newton.bond_count >= 6);
        for (int k = 0; k < SIZE; k++) {
            const double h = 1e-9;
            double keep = x[k];
            x[k] = keep + h, residual_at(w, x, high);
            x[k] = keep - h, residual_at(w, x, low);
            x[k] = keep;
            memset(unit, 0, sizeof unit);
            unit[k] = 1;
            sparse_apply(&w->integrator->newton.matrix, unit, column);
            for (int i = 0; i < SIZE; i++) {
                largest = fmax(largest, fabs(column[i]));
                worst = fmax(worst, fabs(column[i] - (high[i] - low[i]) / (2 * h)));
            }
        }
        print_message("Jacobian off by %.1e of its largest entry\n", worst / largest);
        CHECK_BELOW(worst, 1e-5 * largest);
        clast_world_free(w);
    }
}

/* With the rows of S12 3.47-3.50, not multiplied by masses, it is not symmetric here. */
static void the_jacobian_is_symmetric(void **state) {
    (void)state;
    clast_world *w = cluster(CLAST_LAW_HERTZ_MINDLIN, CLAST_SCHEME_NEWMARK_BETA, 0.8, 2e-4,
                             CLAST_SOLVER_CONJUGATE_GRADIENT);
    trial_begin(w);
    trial_try(w, 0);
    bonds_rank(w);
    bonds_assemble(w, clast_scheme_info_of(CLAST_SCHEME_NEWMARK_BETA));
    const sparse_matrix *m = &w->integrator->newton.matrix;
    double uneven = 0;
    for (size_t r = 0; r < m->rows; r++)
        for (size_t k = m->first[r]; k < m->first[r + 1]; k++) {
            size_t c = m->column[k], back = m->first[c];
            while (m->column[back] != r) back++;
            double mr = body_of(w, (int)r).mass, mc = body_of(w, (int)c).mass;
            for (size_t i = 0; i < 9; i++) {
                double here = m->block[9 * k + i], there = m->block[9 * back + 3 * (i % 3) + i / 3];
                assert_true(here == there);
                uneven = fmax(uneven, fabs(here / mr - there / mc));
            }
        }
    print_message("not multiplied by masses: uneven by %.2g\n", uneven);
    assert_true(uneven > 0.01);
    clast_world_free(w);
}

/* ---- a pile ---------------------------------------------------------------------------------- */

enum { DISCS = 50 };

/* Discs in a hexagonal packing, pressed into each other and the walls, that swing and stay in
 * touch. */
static clast_world *pile(clast_scheme scheme, double step, double restitution, double friction) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0.7, 0, -3);
    def.motion = CLAST_MOTION_IN_PLANE, def.plane_axis = 1;
    def.scheme = scheme, def.time_step = step;
    def.max_residual = 1e9;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(restitution, friction);
    two_materials m = add_materials(w, &pair);
    const double r = 0.005, d = 2 * r * 0.985, rise = d * sqrt(0.75);
    int disc = clast_shape_add_sphere(w, "disc", r, m.soft);
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    add_plane(w, box, m.soft, vec(0, 0, -0.985 * r), vec(0, 0, 1));
    add_plane(w, box, m.soft, vec(-0.985 * r, 0, 0), vec(1, 0, 0));
    add_plane(w, box, m.soft, vec(4.5 * d + 0.985 * r, 0, 0), vec(-1, 0, 0));
    add_plane(w, box, m.soft, vec(0, 0, 9 * rise + 0.985 * r), vec(0, 0, -1));
    for (int i = 0; i < DISCS; i++) {
        double x = d * (i % 5 + (i / 5 % 2 ? 0.5 : 0)), z = rise * (i / 5);
        add_body(w, disc, vec(x, 0, z), vec(0.002 * (i % 3 - 1), 0, 0.003 * (i % 4 - 1.5)),
                 vec(0, 0, 0));
    }
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

/* ---- convergence ----------------------------------------------------------------------------- */

/* The moves of Newton's method on Hertz contacts: each about the square of the one before. */
static void convergence_is_quadratic(void **state) {
    (void)state;
    clast_world *w = pile(CLAST_SCHEME_NEWMARK_BETA, 2e-4, 1, 0);
    int seen = 0;
    double r = w->smallest_radius;
    for (int i = 0; i < 60; i++) {
        steps(w, 1);
        clast_newton n = clast_world_newton(w);
        assert_true(n.converged);
        for (int k = 1; k + 1 < n.iterations; k++) {
            double before = n.move[k] / r, after = n.move[k + 1] / r;
            if (!(before < 1e-2 && before > 1e-6)) continue;
            CHECK_BELOW(after, 200 * before * before);
            seen++;
        }
    }
    print_message("%d pairs of moves in the range of quadratic convergence, %llu iterations at "
                  "most\n",
                  seen, (unsigned long long)clast_world_counters(w).newton_most);
    assert_true(seen > 10);
    CHECK_BELOW((double)clast_world_counters(w).newton_most, 12);
    clast_world_free(w);
}

static void solvers_agree_in_a_run(void **state) {
    (void)state;
    clast_world *w[2];
    for (int k = 0; k < 2; k++) {
        w[k] = cluster(CLAST_LAW_HERTZ_MINDLIN, CLAST_SCHEME_BACKWARD_EULER, 0.7, 2e-4,
                       k ? CLAST_SOLVER_GAUSS_SEIDEL : CLAST_SOLVER_CONJUGATE_GRADIENT);
        steps(w[k], 200);
        print_message("%llu linear iterations in %llu of Newton's\n",
                      (unsigned long long)clast_world_counters(w[k]).linear_iterations,
                      (unsigned long long)clast_world_counters(w[k]).newton_iterations);
    }
    for (int i = 0; i < BALLS; i++) {
        double apart = norm(minus(body_of(w[0], i).position, body_of(w[1], i).position));
        CHECK_BELOW(apart, 1e-9 * 0.0041);
    }
    clast_world_free(w[0]), clast_world_free(w[1]);
}

/* Where bodies are held back, what they want counts and not what they do: at the end of a step
 * nobody wants to go on but those at a jump of their force. A bed of the linear or a Hertz law with
 * friction and dashpots; in some steps of it bodies were held below the tolerance 10^4 of it from
 * where their equations are fulfilled. */
static void to_be_held_is_not_to_converge(void **state) {
    (void)state;
    const clast_scheme schemes[] = {CLAST_SCHEME_BEEMAN, CLAST_SCHEME_ADAMS_MOULTON,
                                    CLAST_SCHEME_NUMEROV_FORWARD};
    for (int k = 0; k < 3; k++) {
        int scheme = (int)schemes[k], jumps = 0;
        bed_wish wish = {.threads = 1, .law = (clast_law)(scheme % 3), .scheme = schemes[k]};
        wish.motion = scheme % 2 ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D;
        clast_world *w = bed_new(&wish);
        double tolerance = w->def.newton_tolerance * w->smallest_radius, most = 0;
        for (int i = 0; i < 1000; i++) {
            steps(w, 1);
            const newton_store *n = &w->integrator->newton;
            if (n->iterations == 0) continue; /* of a scheme that looks back */
            jumps += n->pinned > 0;
            for (size_t m = 0; n->pinned == 0 && m < n->rows; m++) {
                const double *way = n->move + 3 * m;
                most = fmax(most, norm(vec(way[0], way[1], way[2])));
            }
        }
        print_message("%s: %d of 1000 steps end at a jump, elsewhere nobody wants to go on by more "
                      "than %.2g tolerances; %llu iterations\n",
                      clast_scheme_info_of(schemes[k])->name, jumps, most / tolerance,
                      (unsigned long long)clast_world_counters(w).newton_iterations);
        CHECK_BELOW(most, 20 * tolerance);
        assert_true(jumps < 20);
        clast_world_free(w);
    }
}

static void no_convergence_is_reported(void **state) {
    (void)state;
    for (int report = 0; report < 2; report++) {
        clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
        def.scheme = CLAST_SCHEME_TRAPEZOID, def.time_step = 2e-4;
        def.newton_iterations = 1;
        def.guards = report ? CLAST_GUARD_REPORT : CLAST_GUARD_STOP;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        int pea = clast_shape_add_sphere(w, "pea", 0.005, m.soft);
        add_body(w, pea, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        add_body(w, pea, vec(0, 0, 0.0099), vec(0, 0, 0), vec(0, 0, 0));
        clast_status status = clast_world_run(w, 1e-2);
        clast_counters c = clast_world_counters(w);
        assert_true(c.unconverged > 0);
        assert_int_equal(status, report ? CLAST_OK : CLAST_ERR_GUARD);
        assert_non_null(strstr(clast_world_error(w), "Newton's method has not converged in 1"));
        assert_non_null(strstr(clast_world_error(w), "body 0 (pea)"));
        assert_true(report ? c.guard_trips == c.unconverged : c.unconverged == 1);
        clast_world_free(w);
    }
}

/* ---- stiff in one direction, soft in another ------------------------------------------------- */

/* A ball between two stiff plates in z, all without dashpots, is pressed by a soft spring in x: by
 * another ball, which comes to a wall with a dashpot and ends the step where that begins. */
typedef struct nest {
    clast_world *world;
    double step, stiff, soft; /* s, N/m of both plates, N/m */
    clast_vec3 free;          /* m, of the ball at the end of the step without contacts */
} nest;

enum { HELD_BALL, COMING_BALL };
static const double NEST_RADIUS[2] = {0.005, 0.004}; /* m; the plates do not reach the second */

static nest nest_of(double omega_step, double tolerance, int iterations) {
    const double r = NEST_RADIUS[HELD_BALL], r2 = NEST_RADIUS[COMING_BALL], density = 1130;
    const double mass = density * 4 / 3.0 * 3.14159265358979324 * r * r * r;
    const double speed = 0.02;
    nest n = {.step = 1e-4};
    n.stiff = mass * omega_step * omega_step / (n.step * n.step);
    n.soft = 1.3 * mass / (n.step * n.step);
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.scheme = CLAST_SCHEME_BACKWARD_EULER, def.time_step = n.step;
    def.newton_tolerance = tolerance, def.newton_iterations = iterations, def.max_residual = 1e9;
    clast_world *w = n.world = new_world(&def);
    int ball = clast_material_add(w, &(clast_material_def){"ball", density, 7.3e6, 0.37});
    int coming = clast_material_add(w, &(clast_material_def){"coming", density, 7.3e6, 0.37});
    int steel = clast_material_add(w, &(clast_material_def){"steel", 2610, 61e6, 0.23});
    clast_pair_def plates = {.restitution = 1, .stiffness = 0.5 * n.stiff};
    clast_pair_def spring = {.restitution = 1, .stiffness = n.soft};
    clast_pair_def dashpot = {.restitution = 0.1, .stiffness = 4 * n.stiff};
    int of[3] = {ball, coming, steel};
    for (int i = 0; i < 3; i++) clast_pair_set(w, of[i], of[i], &spring);
    assert_int_equal(clast_pair_set(w, ball, steel, &plates), CLAST_OK);
    assert_int_equal(clast_pair_set(w, ball, coming, &spring), CLAST_OK);
    assert_int_equal(clast_pair_set(w, coming, steel, &dashpot), CLAST_OK);
    int walls = clast_part_add(w, &(clast_part_def){.name = "nest"});
    double between = 0.9999 * (r + r2), gap = 0.5 * speed * n.step;
    add_plane(w, walls, steel, vec(0, 0, -0.99 * r), vec(0, 0, 1));
    add_plane(w, walls, steel, vec(0, 0, 0.99 * r), vec(0, 0, -1));
    add_plane(w, walls, steel, vec(between + r2 + gap, 0, 0), vec(-1, 0, 0));
    clast_vec3 at = vec(0, 0, 1e-5), v = vec(0.011, 0, -0.013);
    n.free = plus(at, times(n.step, v));
    add_body(w, clast_shape_add_sphere(w, "held", r, ball), at, v, vec(0, 0, 0));
    add_body(w, clast_shape_add_sphere(w, "coming", r2, coming), vec(between, 0, 0),
             vec(speed, 0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return n;
}

/* Where the held ball's linear equations end, with the other where it is. */
static void a_soft_direction_is_fulfilled_too(void **state) {
    (void)state;
    for (double omega_step = 5; omega_step <= 20; omega_step += 5) {
        nest n = nest_of(omega_step, 1e-6, 200);
        clast_world *w = n.world;
        steps(w, 1);
        assert_true(clast_world_newton(w).converged);
        assert_true(w->integrator->newton.pinned == 1);
        body_state held = body_of(w, HELD_BALL), coming = body_of(w, COMING_BALL);
        double tolerance = w->def.newton_tolerance * w->smallest_radius, dt2 = n.step * n.step;
        double deep = NEST_RADIUS[0] + NEST_RADIUS[1] - coming.position.x; /* at x = 0 */
        double x = (held.mass * n.free.x - dt2 * n.soft * deep) / (held.mass + dt2 * n.soft);
        double z = held.mass * n.free.z / (held.mass + dt2 * n.stiff);
        print_message("omega dt %g: %d iterations, off by %.2g tolerances along the soft spring, "
                      "%.2g across the plates\n",
                      omega_step, clast_world_newton(w).iterations,
                      (held.position.x - x) / tolerance, (held.position.z - z) / tolerance);
        CHECK_NEAR(held.position.x, x, 20 * tolerance);
        CHECK_NEAR(held.position.z, z, 20 * tolerance);
        clast_world_free(w);
    }
}

/* Whatever iteration is the last. */
static void the_message_names_who_has_to_go(void **state) {
    (void)state;
    int failures = 0;
    for (int iterations = 1; iterations <= 40; iterations++) {
        nest n = nest_of(5, 1e-8, iterations);
        if (clast_world_step(n.world) != CLAST_OK) {
            const char *text = strstr(clast_world_error(n.world), "iterations: ");
            double way = 0, limit = 0;
            assert_non_null(text);
            assert_int_equal(
                sscanf(text, "iterations: %lf m still to go (limit %lf m)", &way, &limit), 2);
            CHECK_BELOW(limit, way);
            failures++;
        }
        clast_world_free(n.world);
    }
    print_message("%d of 40 limits fail\n", failures);
    assert_true(failures > 3 && failures < 40);
}

/* ---- a pile against the leapfrog ------------------------------------------------------------- */

static const double PILE_TIME = 0.016; /* s */

typedef struct places {
    clast_vec3 of[DISCS];
} places;

static places pile_after(clast_scheme scheme, double step, double friction) {
    clast_world *w = pile(scheme, step, 0.8, friction);
    places p;
    run_to(w, PILE_TIME);
    assert_true(fabs(clast_world_time(w) - PILE_TIME) < 1e-9);
    assert_true(clast_world_counters(w).unconverged == 0);
    for (int i = 0; i < DISCS; i++) p.of[i] = body_of(w, i).position;
    clast_world_free(w);
    return p;
}

/* With dashpots the leapfrog is of first order: from two steps to one of second, and small. */
static places pile_truth(double step, double friction) {
    places p = pile_after(CLAST_SCHEME_LEAPFROG, step, friction);
    places fine = pile_after(CLAST_SCHEME_LEAPFROG, step / 2, friction);
    for (int i = 0; i < DISCS; i++) p.of[i] = minus(times(2, fine.of[i]), p.of[i]);
    return p;
}

/* Of a radius, the disc that is farthest off. */
static double pile_error(double step, double friction, const places *truth) {
    places p = pile_after(CLAST_SCHEME_NEWMARK_BETA, step, friction);
    double worst = 0;
    for (int i = 0; i < DISCS; i++) worst = fmax(worst, norm(minus(p.of[i], truth->of[i])) / 0.005);
    return worst;
}

static void a_pile_is_that_of_the_leapfrog(void **state) {
    (void)state;
    for (int rough = 0; rough < 2; rough++) {
        double friction = rough ? 0.6 : 0, error[4];
        places truth = pile_truth(1e-6, friction);
        for (int i = 0; i < 4; i++) error[i] = pile_error(1e-4 / (1 << i), friction, &truth);
        print_message("pile, friction %.1f: off by %.1e to %.1e of a radius, orders %.2f, %.2f, "
                      "%.2f\n",
                      friction, error[0], error[3], order_of(error[0], error[1], 2),
                      order_of(error[1], error[2], 2), order_of(error[2], error[3], 2));
        CHECK_NEAR(order_of(error[2], error[3], 2), 2, 0.1);
    }
}

TEST_MAIN(cmocka_unit_test(both_solvers_solve), cmocka_unit_test(the_jacobian_is_the_derivative),
          cmocka_unit_test(the_jacobian_is_symmetric), cmocka_unit_test(convergence_is_quadratic),
          cmocka_unit_test(solvers_agree_in_a_run), cmocka_unit_test(to_be_held_is_not_to_converge),
          cmocka_unit_test(no_convergence_is_reported),
          cmocka_unit_test(a_soft_direction_is_fulfilled_too),
          cmocka_unit_test(the_message_names_who_has_to_go),
          cmocka_unit_test(a_pile_is_that_of_the_leapfrog))
