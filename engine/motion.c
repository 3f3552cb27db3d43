/* motion.c - gathers the contact forces of each body and moves it: leapfrog, second order.
 *
 *     v(n+1/2) = v(n-1/2) + a(n) dt        x(n+1) = x(n) + v(n+1/2) dt
 *
 * Rotation keeps the angular momentum L in the world frame (exactly constant without torque) and
 * turns the body by the symmetric splitting of Dullweber, Leimkuhler and McLachlan (J. Chem. Phys.
 * 107, 1997, 5840): rotations about the principal axes x, y, z, y, x. Bodies with three equal
 * moments and bodies in a plane need one rotation only. */
#include "engine/numbers.h"
#include "engine/parallel.h"
#include "engine/world.h"

/* Force and torque of all contacts, in the order of the partners' ids; pairs that do not touch add
 * nothing. Gravity is not in it. */
void body_load(const clast_world *w, size_t slot, vec3 *force, vec3 *torque) {
    const pair_list *l = &w->list;
    vec3 f = {0, 0, 0}, t = {0, 0, 0};
    for (size_t i = l->incidence_first[slot]; i < l->incidence_first[slot + 1]; i++) {
        const pair_force *p = &l->forces[l->incidences[i].pair];
        if (p->touching == 0) continue;
        if (l->incidences[i].side > 0) f = v3_add(f, p->force), t = v3_add(t, p->torque_a);
        else f = v3_sub(f, p->force), t = v3_add(t, p->torque_b);
    }
    *force = f;
    *torque = t;
}

/* ---- rotation -------------------------------------------------------------------------------- */

static quat turned(quat q, vec3 axis_angle) {
    double angle = v3_norm(axis_angle), s, c;
    if (angle == 0) return q;
    number_sincos_small(0.5 * angle, &s, &c);
    double k = s / angle;
    return q_renormalise(q_mul((quat){c, k * axis_angle.x, k * axis_angle.y, k * axis_angle.z}, q));
}

static quat turned_in_plane(const clast_world *w, quat q, vec3 spin) {
    double s, c;
    number_sincos_small(0.5 * w->dt * v3_at(spin, w->def.plane_axis), &s, &c);
    vec3 turn = v3_axis(w->def.plane_axis, s);
    return q_renormalise(q_mul((quat){c, turn.x, turn.y, turn.z}, q));
}

/* Rotates the body by `angle` about its own principal axis; its local momentum turns the other way.
 */
static void turn_about(int axis, double angle, quat *q, vec3 *local) {
    double s, c;
    number_sincos_small(0.5 * angle, &s, &c);
    *q = q_mul(*q, (quat){c, axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0});
    double cs = c * c - s * s, sn = 2 * s * c;
    vec3 l = *local;
    if (axis == 0) *local = v3(l.x, cs * l.y + sn * l.z, cs * l.z - sn * l.y);
    else if (axis == 1) *local = v3(cs * l.x - sn * l.z, l.y, cs * l.z + sn * l.x);
    else *local = v3(cs * l.x + sn * l.y, cs * l.y - sn * l.x, l.z);
}

static quat turned_asymmetric(quat q, vec3 momentum, vec3 inverse, double dt) {
    mat3 r = q_matrix(q);
    vec3 l = m3_apply_transposed(&r, momentum);
    turn_about(0, 0.5 * dt * (l.x * inverse.x), &q, &l);
    turn_about(1, 0.5 * dt * (l.y * inverse.y), &q, &l);
    turn_about(2, dt * (l.z * inverse.z), &q, &l);
    turn_about(1, 0.5 * dt * (l.y * inverse.y), &q, &l);
    turn_about(0, 0.5 * dt * (l.x * inverse.x), &q, &l);
    return q_renormalise(q);
}

static quat orientation_after(const clast_world *w, const shape *s, quat q, vec3 momentum,
                              vec3 spin) {
    if (w->def.motion == CLAST_MOTION_IN_PLANE) return turned_in_plane(w, q, spin);
    if (s->round_inertia) return turned(q, v3_scale(w->dt, spin));
    return turned_asymmetric(q, momentum, s->inverse_inertia, w->dt);
}

/* ---- one body -------------------------------------------------------------------------------- */

typedef struct kick {
    vec3 velocity, momentum; /* after */
    double global_loss;      /* J */
    double contact_work;     /* J, of the contact forces in this kick: exact */
    double contact_arrived;  /* J, the half of it that belongs to the way up to now */
} kick;

static vec3 in_plane(const clast_world *w, vec3 a) {
    int axis = w->def.plane_axis;
    return v3_sub(a, v3_axis(axis, v3_at(a, axis)));
}

/* A00 1.82-1.83 with the errata of FACTS 1; f = 0 gives the plain kick. */
static kick kicked(const clast_world *w, size_t i) {
    const body_store *b = &w->bodies;
    const shape *s = &w->shapes[b->shape[i]];
    vec3 force, torque, v = v3(b->vx[i], b->vy[i], b->vz[i]), l = v3(b->lx[i], b->ly[i], b->lz[i]);
    body_load(w, i, &force, &torque);
    vec3 a = v3_add(v3_scale(s->inverse_mass, force), w->def.gravity);
    if (w->def.motion == CLAST_MOTION_IN_PLANE) {
        a = in_plane(w, a);
        torque = v3_sub(torque, in_plane(w, torque));
    }
    double f = 0.5 * w->def.global_damping * w->dt;
    kick k = {v3_add(v, v3_scale(w->dt, a)), v3_add(l, v3_scale(w->dt, torque)), 0, 0, 0};
    if (f != 0) {
        k.velocity = v3_scale(1 / (1 + f), v3_add(v3_scale(1 - f, v), v3_scale(w->dt, a)));
        k.momentum = v3_scale(1 / (1 + f), v3_add(v3_scale(1 - f, l), v3_scale(w->dt, torque)));
    }
    vec3 middle = v3_scale(0.5, v3_add(v, k.velocity)), turn = v3_scale(0.5, v3_add(l, k.momentum));
    vec3 spin = body_spin_of(w, b->shape[i], body_orientation(w, i), turn);
    k.contact_work = w->dt * (v3_dot(force, middle) + v3_dot(torque, spin));
    vec3 spin_before = v3(b->wx[i], b->wy[i], b->wz[i]);
    k.contact_arrived = 0.5 * w->dt * (v3_dot(force, v) + v3_dot(torque, spin_before));
    k.global_loss = 2 * f * (s->mass * v3_dot(middle, middle) + v3_dot(turn, spin));
    return k;
}

static void advance_one(clast_world *w, size_t i, body_tally *t) {
    body_store *b = &w->bodies;
    const shape *s = &w->shapes[b->shape[i]];
    kick k = kicked(w, i);
    vec3 v = k.velocity, l = k.momentum;
    quat q = body_orientation(w, i);
    b->x[i] += w->dt * v.x, b->y[i] += w->dt * v.y, b->z[i] += w->dt * v.z;
    vec3 spin = body_spin_of(w, b->shape[i], q, l);
    q = orientation_after(w, s, q, l, spin);
    if (w->def.motion == CLAST_MOTION_3D && !s->round_inertia)
        spin = body_spin_of(w, b->shape[i], q, l);
    b->qw[i] = q.w, b->qx[i] = q.x, b->qy[i] = q.y, b->qz[i] = q.z;
    b->vx[i] = v.x, b->vy[i] = v.y, b->vz[i] = v.z;
    b->lx[i] = l.x, b->ly[i] = l.y, b->lz[i] = l.z;
    b->wx[i] = spin.x, b->wy[i] = spin.y, b->wz[i] = spin.z;
    sum_add(&t->contact, &w->ledger.scale, k.contact_work);
    sum_add(&t->global, &w->ledger.scale, k.global_loss);
}

/* Upper bounds without square roots: (a + b)^2 <= 2 a^2 + 2 b^2. A bound that is somewhat too large
 * costs a rebuild a little early, which nobody can observe; guards look again before they speak. */
static double bound2(double a2, double b2) { return b2 == 0 ? a2 : 2 * (a2 + b2); }

/* Way of any sphere of the body since the list was built, squared: of the centre, and arm times
 * twice the change of the quaternion. NaN stays NaN. */
static double moved2(const clast_world *w, size_t i) {
    const body_store *b = &w->bodies;
    const built_pose *p = &w->built[i];
    double dx = b->x[i] - p->x, dy = b->y[i] - p->y, dz = b->z[i] - p->z;
    double ew = b->qw[i] - p->qw, ex = b->qx[i] - p->qx, ey = b->qy[i] - p->qy,
           ez = b->qz[i] - p->qz;
    double turn2 = ew * ew + ex * ex + ey * ey + ez * ez;
    return bound2(dx * dx + dy * dy + dz * dz, 4 * p->arm * p->arm * turn2);
}

/* Way of any point of the body in one step, squared. */
static double step2(const clast_world *w, size_t i) {
    const body_store *b = &w->bodies;
    double bound = w->shapes[b->shape[i]].bound;
    double v2 = b->vx[i] * b->vx[i] + b->vy[i] * b->vy[i] + b->vz[i] * b->vz[i];
    double s2 = b->wx[i] * b->wx[i] + b->wy[i] * b->wy[i] + b->wz[i] * b->wz[i];
    return w->dt * w->dt * bound2(v2, s2 * bound * bound);
}

/* ---- all bodies ------------------------------------------------------------------------------ */

static void advance_range(void *context, size_t begin, size_t end, int thread) {
    clast_world *w = context;
    body_tally *t = &w->body_tallies[thread];
    double stale2 = 0.25 * w->skin * w->skin;
    bool plane = w->def.motion == CLAST_MOTION_IN_PLANE && w->def.global_damping == 0;
    for (size_t i = begin; i < end; i++) {
        if (plane) plane_advance(w, i, t);
        else advance_one(w, i, t);
        if (!(moved2(w, i) < stale2)) t->stale = true;
        double way2 = step2(w, i);
        if (!(way2 <= t->step2_max)) t->step2_max = way2 == way2 ? way2 : INFINITY;
        if (body_is_outside(w, i)) t->outside = true;
    }
    spheres_place(w, begin, end);
}

/* Gathers f(n), kicks and drifts; afterwards bodies and spheres are at n + 1. */
void bodies_advance(clast_world *w) {
    for (int t = 0; t < w->threads; t++) w->body_tallies[t] = (body_tally){.step2_max = 0};
    parallel_for(w->threads, w->bodies.count, advance_range, w);
    exact_sum global = {0, 0}, contact = {0, 0};
    w->found = (body_tally){.step2_max = 0};
    for (int t = 0; t < w->threads; t++) {
        const body_tally *b = &w->body_tallies[t];
        sum_merge(&global, &b->global);
        sum_merge(&contact, &b->contact);
        w->found.stale |= b->stale;
        w->found.outside |= b->outside;
        if (b->step2_max > w->found.step2_max) w->found.step2_max = b->step2_max;
    }
    w->ledger.global += sum_value(&global);
    w->ledger.work += sum_value(&contact);
    if (w->found.stale) w->list.stale = true;
}

/* Half a step back: from v(0) to v(-1/2), so that the mean of v(-1/2) and v(1/2) is v(0). */
void velocities_start(clast_world *w) {
    body_store *b = &w->bodies;
    double back = 1 + 0.5 * w->def.global_damping * w->dt, half = 0.5 * w->dt;
    for (size_t i = 0; i < b->count; i++) {
        vec3 force, torque;
        body_load(w, i, &force, &torque);
        vec3 a = v3_add(v3_scale(w->shapes[b->shape[i]].inverse_mass, force), w->def.gravity);
        if (w->def.motion == CLAST_MOTION_IN_PLANE) {
            a = in_plane(w, a);
            torque = v3_sub(torque, in_plane(w, torque));
        }
        vec3 v = v3_sub(v3_scale(back, v3(b->vx[i], b->vy[i], b->vz[i])), v3_scale(half, a));
        vec3 l = v3_sub(v3_scale(back, v3(b->lx[i], b->ly[i], b->lz[i])), v3_scale(half, torque));
        b->vx[i] = v.x, b->vy[i] = v.y, b->vz[i] = v.z;
        b->lx[i] = l.x, b->ly[i] = l.y, b->lz[i] = l.z;
        vec3 spin = body_spin_of(w, b->shape[i], body_orientation(w, i), l);
        b->wx[i] = spin.x, b->wy[i] = spin.y, b->wz[i] = spin.z;
    }
}

/* ---- readers --------------------------------------------------------------------------------- */

static void reserve_view(clast_world *w) {
    size_t old = w->view.capacity, now = w->bodies.capacity;
    if (old >= now) return;
    double **columns[] = {&w->view.vx, &w->view.vy, &w->view.vz, &w->view.wx,
                          &w->view.wy, &w->view.wz, &w->view.mass};
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        *columns[i] = memory_grow(w, *columns[i], old, now, sizeof(double));
    w->view.capacity = now;
}

/* Before the first evaluation the columns hold the velocities of the start. */
static void copy_start(clast_world *w) {
    const body_store *b = &w->bodies;
    for (size_t i = 0; i < b->count; i++) {
        w->view.vx[i] = b->vx[i], w->view.vy[i] = b->vy[i], w->view.vz[i] = b->vz[i];
        w->view.wx[i] = b->wx[i], w->view.wy[i] = b->wy[i], w->view.wz[i] = b->wz[i];
        w->view.mass[i] = w->shapes[b->shape[i]].mass;
    }
}

/* Velocities at the time of the positions, without touching the state: the mean of the half steps
 * before and after. Also the kinetic energies, as v-.v+ and L-.w+, which the discrete motion
 * goes by (the mean of squares would be off by the square of the kick). */
void velocities_synchronise(clast_world *w) {
    reserve_view(w);
    if (!w->prepared) {
        copy_start(w);
        return;
    }
    const body_store *b = &w->bodies;
    exact_sum kinetic = {0, 0}, rotational = {0, 0}, global = {0, 0}, work = {0, 0};
    for (size_t i = 0; i < b->count; i++) {
        kick k = kicked(w, i);
        double mass = w->shapes[b->shape[i]].mass;
        vec3 v = v3(b->vx[i], b->vy[i], b->vz[i]), l = v3(b->lx[i], b->ly[i], b->lz[i]);
        vec3 vm = v3_scale(0.5, v3_add(v, k.velocity)), lm = v3_scale(0.5, v3_add(l, k.momentum));
        quat q = body_orientation(w, i);
        vec3 wm = body_spin_of(w, b->shape[i], q, lm);
        vec3 after = body_spin_of(w, b->shape[i], q, k.momentum);
        w->view.vx[i] = vm.x, w->view.vy[i] = vm.y, w->view.vz[i] = vm.z;
        w->view.wx[i] = wm.x, w->view.wy[i] = wm.y, w->view.wz[i] = wm.z;
        w->view.mass[i] = mass;
        sum_add(&kinetic, &w->ledger.scale, 0.5 * mass * v3_dot(v, k.velocity));
        sum_add(&rotational, &w->ledger.scale, 0.5 * v3_dot(l, after));
        sum_add(&global, &w->ledger.scale, 0.5 * k.global_loss);
        sum_add(&work, &w->ledger.scale, k.contact_arrived);
    }
    w->view.kinetic = sum_value(&kinetic);
    w->view.rotational = sum_value(&rotational);
    w->view.half_global = sum_value(&global);
    w->view.work_arrived = sum_value(&work);
}
