#include "shapes/mass.h"

#include <gsl/gsl_eigen.h>
#include <string.h>

#include "shapes/check.h"

void shape_second_add(double second[3][3], double s, shape_vec a, shape_vec b) {
    const double u[3] = {a.x, a.y, a.z}, v[3] = {b.x, b.y, b.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) second[i][j] += 0.5 * s * (u[i] * v[j] + v[i] * u[j]);
}

static double largest_moment(const shape_mass *mass) {
    return fmax(mass->inertia[0][0], fmax(mass->inertia[1][1], mass->inertia[2][2]));
}

shape_mass shape_mass_of(const shape_moments *m, double doubtful, double reach) {
    SHAPE_ASSERT(m && m->volume > 0 && doubtful >= 0);
    shape_mass mass = {.volume = m->volume};
    shape_vec arm = sv_scale(1 / m->volume, m->first);
    mass.centre = sv_add(m->about, arm);
    double central[3][3], trace = 0;
    memcpy(central, m->second, sizeof central);
    shape_second_add(central, -m->volume, arm, arm);
    for (int i = 0; i < 3; i++) trace += central[i][i];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) mass.inertia[i][j] = (i == j ? trace : 0) - central[i][j];
    mass.volume_bound = doubtful / m->volume;
    /* what is doubtful adds at most doubtful * reach^2 to an entry of `second`, twice that to an
     * entry of the inertia, and as much again by moving the centre */
    mass.inertia_bound = 4 * doubtful * reach * reach / largest_moment(&mass);
    return mass;
}

/* ---- principal axes -------------------------------------------------------------------------- */

/* Largest product of inertia, of the largest moment. */
static double skewness(const shape_mass *mass) {
    const double(*i)[3] = mass->inertia;
    return fmax(fabs(i[0][1]), fmax(fabs(i[1][2]), fabs(i[2][0]))) / largest_moment(mass);
}

static void solve(const shape_mass *mass, double axis[3][3], double moment[3]) {
    double tensor[9], values[3], vectors[9];
    for (int k = 0; k < 9; k++) tensor[k] = mass->inertia[k / 3][k % 3];
    gsl_matrix_view a = gsl_matrix_view_array(tensor, 3, 3);
    gsl_matrix_view v = gsl_matrix_view_array(vectors, 3, 3);
    gsl_vector_view w = gsl_vector_view_array(values, 3);
    gsl_eigen_symmv_workspace *work = gsl_eigen_symmv_alloc(3);
    SHAPE_ASSERT(work);
    gsl_eigen_symmv(&a.matrix, &w.vector, &v.matrix, work);
    gsl_eigen_symmv_free(work);
    for (int k = 0; k < 3; k++) {
        moment[k] = values[k];
        for (int i = 0; i < 3; i++) axis[k][i] = vectors[3 * i + k];
    }
}

/* The order of the axes that lies nearest to x, y, z. */
static const int *nearest_order(double axis[3][3]) {
    static const int ORDERS[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                     {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    int best = 0;
    double most = -1;
    for (int o = 0; o < 6; o++) {
        double sum = 0;
        for (int k = 0; k < 3; k++) sum += fabs(axis[ORDERS[o][k]][k]);
        if (sum > most + 1e-9) most = sum, best = o;
    }
    return ORDERS[best];
}

static double determinant(double m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Returns the most that a moment was changed by, of the largest. */
static double make_equal(double moment[3], double share) {
    double largest = fmax(moment[0], fmax(moment[1], moment[2])), most = 0;
    for (int i = 0; i < 3; i++)
        for (int j = i + 1; j < 3; j++) {
            double apart = fabs(moment[i] - moment[j]) / largest;
            if (apart <= share) moment[j] = moment[i], most = fmax(most, apart);
        }
    return most;
}

static void turn_to_axes(const shape_mass *mass, shape_frame *frame) {
    double axis[3][3], moment[3];
    solve(mass, axis, moment);
    const int *order = nearest_order(axis);
    for (int k = 0; k < 3; k++) {
        frame->moment[k] = moment[order[k]];
        double sign = axis[order[k]][k] < 0 ? -1 : 1;
        for (int i = 0; i < 3; i++) frame->axis[k][i] = sign * axis[order[k]][i];
    }
    if (determinant(frame->axis) < 0)
        for (int i = 0; i < 3; i++) frame->axis[2][i] = -frame->axis[2][i];
}

shape_frame shape_principal(const shape_mass *mass) {
    SHAPE_ASSERT(mass && mass->volume > 0);
    const double rounding = 1e-14; /* of the eigenvalues */
    double share = fmax(1e-9, 2 * mass->inertia_bound), skew = skewness(mass);
    shape_frame frame = {.axis = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int k = 0; k < 3; k++) frame.moment[k] = mass->inertia[k][k];
    if (skew > share) turn_to_axes(mass, &frame), skew = rounding;
    double equalled = make_equal(frame.moment, share);
    /* turned by axes that are off, an entry is off by up to three entries of the tensor */
    frame.bound = 3 * mass->inertia_bound + fmax(skew, equalled);
    return frame;
}

shape_vec shape_point_to_frame(const shape_frame *frame, shape_vec centre, shape_vec point) {
    shape_vec d = sv_sub(point, centre);
    const double(*a)[3] = frame->axis;
    return sv(a[0][0] * d.x + a[0][1] * d.y + a[0][2] * d.z,
              a[1][0] * d.x + a[1][1] * d.y + a[1][2] * d.z,
              a[2][0] * d.x + a[2][1] * d.y + a[2][2] * d.z);
}

void shape_to_frame(const shape_frame *frame, shape_vec centre, shape_sphere *spheres, int count) {
    SHAPE_ASSERT(frame && (spheres || count == 0));
    for (int i = 0; i < count; i++)
        spheres[i].centre = shape_point_to_frame(frame, centre, spheres[i].centre);
}
