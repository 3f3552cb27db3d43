/* motion_plane.c - the in-plane counterpart of motion.c and of spheres_place(): two coordinates u
 * and v, one angle about the axis a. A third of the work of the general path, with the same
 * expressions. */
#include "engine/numbers.h"
#include "engine/world.h"

typedef struct plane {
    int a, u, v; /* (u, v, a) is right-handed */
    double *x[3], *vel[3], *q[3], *l[3], *w[3];
} plane;

static plane plane_of(const clast_world *w) {
    const body_store *b = &w->bodies;
    int a = w->def.plane_axis;
    return (plane){.a = a,
                   .u = (a + 1) % 3,
                   .v = (a + 2) % 3,
                   .x = {b->x, b->y, b->z},
                   .vel = {b->vx, b->vy, b->vz},
                   .q = {b->qx, b->qy, b->qz},
                   .l = {b->lx, b->ly, b->lz},
                   .w = {b->wx, b->wy, b->wz}};
}

typedef struct load {
    double u, v, turn; /* N, N, N m */
} load;

static double component(const vec3 *a, int axis) { return (&a->x)[axis]; }

/* The components of body_load() that matter. */
static load load_of(const clast_world *w, const plane *p, size_t slot) {
    const pair_list *l = &w->list;
    load sum = {0, 0, 0};
    for (size_t i = l->incidence_first[slot]; i < l->incidence_first[slot + 1]; i++) {
        const pair_force *f = &l->forces[l->incidences[i].pair];
        if (f->touching == 0) continue;
        bool first = l->incidences[i].side > 0;
        double sign = first ? 1 : -1;
        sum.u += sign * component(&f->force, p->u);
        sum.v += sign * component(&f->force, p->v);
        sum.turn += component(first ? &f->torque_a : &f->torque_b, p->a);
    }
    return sum;
}

void plane_advance(clast_world *w, size_t i, body_tally *t) {
    body_store *b = &w->bodies;
    const shape *s = &w->shapes[b->shape[i]];
    plane p = plane_of(w);
    load f = load_of(w, &p, i);
    double dt = w->dt, sine, cosine;
    double vu = p.vel[p.u][i] + dt * (s->inverse_mass * f.u + v3_at(w->def.gravity, p.u));
    double vv = p.vel[p.v][i] + dt * (s->inverse_mass * f.v + v3_at(w->def.gravity, p.v));
    double l = p.l[p.a][i] + dt * f.turn;
    double inverse = v3_at(s->inverse_inertia, p.a), spin = inverse * l;
    double middle_u = 0.5 * (p.vel[p.u][i] + vu), middle_v = 0.5 * (p.vel[p.v][i] + vv);
    double middle_spin = inverse * (0.5 * (p.l[p.a][i] + l));
    sum_add(&t->contact, &w->ledger.scale,
            dt * ((f.u * middle_u + f.v * middle_v) + f.turn * middle_spin));
    p.vel[p.u][i] = vu, p.vel[p.v][i] = vv;
    p.l[p.a][i] = l, p.w[p.a][i] = spin;
    p.x[p.u][i] += dt * vu, p.x[p.v][i] += dt * vv;
    number_sincos_small(0.5 * dt * spin, &sine, &cosine);
    double qw = cosine * b->qw[i] - sine * p.q[p.a][i], qa = cosine * p.q[p.a][i] + sine * b->qw[i];
    double unit = 1.5 - 0.5 * (qw * qw + qa * qa);
    b->qw[i] = unit * qw, p.q[p.a][i] = unit * qa;
}

void plane_place_spheres(clast_world *w, size_t body_begin, size_t body_end) {
    sphere_store *s = &w->spheres;
    plane p = plane_of(w);
    double *const to[3] = {s->x, s->y, s->z};
    for (size_t i = body_begin; i < body_end; i++) {
        const shape *sh = &w->shapes[w->bodies.shape[i]];
        double qw = w->bodies.qw[i], qa = p.q[p.a][i];
        double cosine = 1 - 2 * (qa * qa), sine = 2 * (qw * qa);
        double xu = p.x[p.u][i], xv = p.x[p.v][i], xa = p.x[p.a][i];
        double *restrict tu = to[p.u] + s->first[i], *restrict tv = to[p.v] + s->first[i],
               *restrict ta = to[p.a] + s->first[i];
        const double *restrict ou = sh->offset[p.u], *restrict ov = sh->offset[p.v],
                     *restrict oa = sh->offset[p.a];
        for (int k = 0; k < sh->spheres; k++) {
            tu[k] = xu + (cosine * ou[k] - sine * ov[k]);
            tv[k] = xv + (sine * ou[k] + cosine * ov[k]);
            ta[k] = xa + oa[k];
        }
    }
}
