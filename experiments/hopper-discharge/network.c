/* network.c - the fastest vibration of a bed: the spheres are masses, the closed contacts springs.
 *
 * For a small displacement, the force along the normal n of a contact changes by the stiffness k
 * times the approach. Between spheres the normal turns, too: across it the force F pushes them
 * apart by F/d times the displacement, d the distance of the centres. Both are in the Jacobian of
 * the implicit schemes (S12 3.47 to 3.50) as well. Motion is in the plane of x and z. */
#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"

enum { LANCZOS_STEPS = 160 };

typedef struct bond {
    int a, b;             /* places of spheres; b < 0: a wall */
    double nx, nz;        /* unit normal, towards a */
    double along, across; /* N/m */
} bond;

typedef struct bed_springs {
    int spheres, bonds;
    bond *bond;
    double *root; /* 1/sqrt(mass), by place */
} bed_springs;

static void *room(size_t count, size_t size) {
    void *p = calloc(count + 1, size);
    CLAST_ASSERT(p);
    return p;
}

/* ---- springs of a world ---------------------------------------------------------------------- */

static bond bond_of(const clast_contact *c, const clast_bodies *b, const int *place,
                    double stiffness) {
    bond s = {.a = place[c->a], .b = -1, .along = stiffness};
    if (c->b >= CLAST_WALL_ID) {
        s.nx = c->force.x / c->normal_force, s.nz = c->force.z / c->normal_force;
        return s;
    }
    s.b = place[c->b];
    double dx = b->x[s.a] - b->x[s.b], dz = b->z[s.a] - b->z[s.b], d = sqrt(dx * dx + dz * dz);
    s.nx = dx / d, s.nz = dz / d;
    s.across = -c->normal_force / d;
    return s;
}

static bed_springs springs_of(clast_world *w, double stiffness, double *overlap) {
    clast_bodies b = clast_world_bodies(w);
    size_t count = clast_world_contacts(w, NULL, 0);
    clast_contact *contact = room(count, sizeof *contact);
    clast_world_contacts(w, contact, count);
    uint32_t ids = 0;
    for (size_t i = 0; i < b.count; i++) ids = b.id[i] >= ids ? b.id[i] + 1 : ids;
    int *place = room(ids, sizeof *place);
    bed_springs s = {.spheres = (int)b.count,
                     .bond = room(count, sizeof *s.bond),
                     .root = room(b.count, sizeof *s.root)};
    for (size_t i = 0; i < b.count; i++) place[b.id[i]] = (int)i, s.root[i] = 1 / sqrt(b.mass[i]);
    *overlap = 0;
    for (size_t k = 0; k < count; k++) {
        if (!(contact[k].normal_force > 0)) continue;
        s.bond[s.bonds++] = bond_of(&contact[k], &b, place, stiffness);
        *overlap += contact[k].overlap;
    }
    free(place), free(contact);
    return s;
}

static void springs_free(bed_springs *s) {
    free(s->bond), free(s->root);
}

/* ---- the largest eigenvalue ------------------------------------------------------------------ */

/* y = M^-1/2 K M^-1/2 x. */
static void multiply(const bed_springs *s, const double *x, double *y) {
    memset(y, 0, 2 * (size_t)s->spheres * sizeof *y);
    for (int k = 0; k < s->bonds; k++) {
        const bond *o = &s->bond[k];
        double ra = s->root[o->a], ux = ra * x[2 * o->a], uz = ra * x[2 * o->a + 1];
        double rb = o->b < 0 ? 0 : s->root[o->b];
        if (o->b >= 0) ux -= rb * x[2 * o->b], uz -= rb * x[2 * o->b + 1];
        double approach = (o->along - o->across) * (ux * o->nx + uz * o->nz);
        double fx = approach * o->nx + o->across * ux, fz = approach * o->nz + o->across * uz;
        y[2 * o->a] += ra * fx, y[2 * o->a + 1] += ra * fz;
        if (o->b >= 0) y[2 * o->b] -= rb * fx, y[2 * o->b + 1] -= rb * fz;
    }
}

static double dot(const double *a, const double *b, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Of the symmetric matrix with these numbers on and beside its diagonal. */
static double largest_of_three_diagonals(const double *on, const double *beside, int n) {
    gsl_matrix *m = gsl_matrix_calloc((size_t)n, (size_t)n);
    gsl_vector *values = gsl_vector_alloc((size_t)n);
    gsl_eigen_symm_workspace *space = gsl_eigen_symm_alloc((size_t)n);
    CLAST_ASSERT(m && values && space);
    for (int i = 0; i < n; i++) {
        gsl_matrix_set(m, (size_t)i, (size_t)i, on[i]);
        if (i == 0) continue;
        gsl_matrix_set(m, (size_t)i, (size_t)i - 1, beside[i - 1]);
        gsl_matrix_set(m, (size_t)i - 1, (size_t)i, beside[i - 1]);
    }
    CLAST_ASSERT(gsl_eigen_symm(m, values, space) == 0);
    double most = gsl_vector_max(values);
    gsl_matrix_free(m), gsl_vector_free(values), gsl_eigen_symm_free(space);
    return most;
}

static void scale(double *x, double by, int n) {
    for (int i = 0; i < n; i++) x[i] *= by;
}

/* Lanczos' method: the ends of the spectrum come first, and copies of them do no harm. */
static double largest_eigenvalue(const bed_springs *s) {
    int n = 2 * s->spheres, steps = n < LANCZOS_STEPS ? n : LANCZOS_STEPS, done = 0;
    double on[LANCZOS_STEPS], beside[LANCZOS_STEPS], last = 0;
    double *v = room((size_t)n, sizeof *v), *before = room((size_t)n, sizeof *before);
    double *next = room((size_t)n, sizeof *next);
    for (int i = 0; i < n; i++) v[i] = clast_random(1, 0, (uint64_t)i) - 0.5;
    scale(v, 1 / sqrt(dot(v, v, n)), n);
    while (done < steps) {
        multiply(s, v, next);
        on[done] = dot(v, next, n);
        for (int i = 0; i < n; i++) next[i] -= on[done] * v[i] + last * before[i];
        beside[done] = last = sqrt(dot(next, next, n));
        if (!(last > 1e-9 * fabs(on[done++]))) break; /* all of the spectrum that v holds */
        double *spare = before;
        before = v, v = next, next = spare;
        scale(v, 1 / last, n);
    }
    free(v), free(before), free(next);
    return largest_of_three_diagonals(on, beside, done);
}

/* ---- one sphere ------------------------------------------------------------------------------ */

/* Largest eigenvalue of the 2 x 2 blocks on the diagonal. */
static double largest_alone(const bed_springs *s) {
    double *block = room(3 * (size_t)s->spheres, sizeof *block), most = 0;
    for (int k = 0; k < s->bonds; k++) {
        const bond *o = &s->bond[k];
        double along = o->along - o->across;
        const int end[2] = {o->a, o->b};
        for (int e = 0; e < 2; e++) {
            if (end[e] < 0) continue;
            double *m = &block[3 * end[e]], r = s->root[end[e]] * s->root[end[e]];
            m[0] += r * (along * o->nx * o->nx + o->across);
            m[1] += r * along * o->nx * o->nz;
            m[2] += r * (along * o->nz * o->nz + o->across);
        }
    }
    for (int i = 0; i < s->spheres; i++) {
        const double *m = &block[3 * i];
        double half = 0.5 * (m[0] - m[2]);
        most = fmax(most, 0.5 * (m[0] + m[2]) + sqrt(half * half + m[1] * m[1]));
    }
    free(block);
    return most;
}

static double mean_radius(clast_world *w) {
    clast_spheres all = clast_world_spheres(w);
    double sum = 0;
    for (size_t i = 0; i < all.count; i++) sum += all.radius[i];
    return all.count > 0 ? sum / (double)all.count : NAN;
}

network network_of(clast_world *w, double stiffness) {
    CLAST_ASSERT(w && stiffness > 0);
    double overlap;
    bed_springs s = springs_of(w, stiffness, &overlap);
    network n = {.spheres = s.spheres};
    int ends = 0;
    for (int k = 0; k < s.bonds; k++) ends += s.bond[k].b < 0 ? 1 : 2;
    if (s.bonds > 0) {
        n.largest = sqrt(largest_eigenvalue(&s));
        n.alone = sqrt(largest_alone(&s));
        n.coordination = (double)ends / s.spheres;
        n.overlap = overlap / s.bonds / mean_radius(w);
    }
    springs_free(&s);
    return n;
}
