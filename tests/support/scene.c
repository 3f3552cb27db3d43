#include "tests/support/scene.h"

clast_world_def bare_def(clast_law law) {
    clast_world_def d = clast_world_def_default();
    d.gravity = vec(0, 0, 0);
    d.law = law;
    d.threads = 1;
    d.max_overlap = 0.5;
    d.max_displacement = 0.5;
    d.impact_speed = 1;
    return d;
}

clast_world *new_world(const clast_world_def *def) {
    clast_world *w = clast_world_new(def);
    if (!w) fail_msg("%s", clast_world_new_error());
    return w;
}

clast_pair_def pair_of(double restitution, double friction) {
    return (clast_pair_def){.restitution = restitution, .friction = friction, .stiffness = 31700};
}

two_materials add_materials(clast_world *w, const clast_pair_def *pair) {
    two_materials m = {
        clast_material_add(w, &(clast_material_def){"soft", 1130, 7.3e6, 0.37}),
        clast_material_add(w, &(clast_material_def){"hard", 2610, 61e6, 0.23}),
    };
    assert_int_equal(clast_pair_set(w, m.soft, m.soft, pair), CLAST_OK);
    assert_int_equal(clast_pair_set(w, m.soft, m.hard, pair), CLAST_OK);
    assert_int_equal(clast_pair_set(w, m.hard, m.hard, pair), CLAST_OK);
    return m;
}

int add_body(clast_world *w, int shape, clast_vec3 position, clast_vec3 velocity, clast_vec3 spin) {
    int id = clast_body_add(w, &(clast_body_def){.shape = shape, .position = position,
                                                 .velocity = velocity, .spin = spin});
    if (id < 0) fail_msg("%s", clast_world_error(w));
    return id;
}

int add_plane(clast_world *w, int part, int material, clast_vec3 point, clast_vec3 normal) {
    int wall = clast_wall_add(w, part, &(clast_wall_def){"plane", CLAST_WALL_PLANE, material,
                                                         .point = point, .normal = normal});
    if (wall < 0) fail_msg("%s", clast_world_error(w));
    return wall;
}

void steps(clast_world *w, uint64_t count) {
    for (uint64_t i = 0; i < count; i++)
        if (clast_world_step(w)) fail_msg("%s", clast_world_error(w));
}

void run_to(clast_world *w, double time) {
    if (clast_world_run(w, time)) fail_msg("%s", clast_world_error(w));
}

body_state body_of(clast_world *w, int id) {
    clast_bodies b = clast_world_bodies(w);
    for (size_t i = 0; i < b.count; i++)
        if (b.id[i] == (uint32_t)id)
            return (body_state){true, vec(b.x[i], b.y[i], b.z[i]), vec(b.vx[i], b.vy[i], b.vz[i]),
                                vec(b.wx[i], b.wy[i], b.wz[i]),
                                {b.qw[i], b.qx[i], b.qy[i], b.qz[i]}, b.mass[i], b.shape[i]};
    return (body_state){.present = false};
}

double motion_energy(clast_world *w) {
    clast_energy e = clast_world_energy(w);
    return e.kinetic + e.rotational;
}

double elastic_energy(clast_world *w) { return clast_world_energy(w).elastic; }

size_t contact_count(clast_world *w) { return clast_world_contacts(w, NULL, 0); }

static int add_shape(clast_world *w, const clast_shape_def *d) {
    int shape = clast_shape_add(w, d);
    if (shape < 0) fail_msg("%s", clast_world_error(w));
    return shape;
}

int add_rod(clast_world *w, int material, double r) {
    clast_vec3 centre[2] = {{-1.02 * r, 0, 0}, {1.02 * r, 0, 0}};
    double radius[2] = {r, r};
    return add_shape(w,
                     &(clast_shape_def){"rod", material, 2, centre, radius, 0, {0, 0, 0}, 0, NULL});
}

int add_triangle(clast_world *w, int material, double r) {
    double h = 1.05 * r;
    clast_vec3 centre[3] = {{-h, 0, -h / sqrt(3)}, {h, 0, -h / sqrt(3)}, {0, 0, 2 * h / sqrt(3)}};
    double radius[3] = {r, r, r};
    return add_shape(
        w, &(clast_shape_def){"triangle", material, 3, centre, radius, 0, {0, 0, 0}, 0, NULL});
}

/* Overlapping spheres of different sizes that stand for a solid with three different moments. */
int add_uneven_rod(clast_world *w, int material, double r) {
    clast_vec3 centre[3] = {{-1.3 * r, 0, 0.1 * r}, {0, 0.2 * r, 0}, {0.9 * r, 0, -0.15 * r}};
    double radius[3] = {0.6 * r, r, 0.8 * r}, m = 1700 * 6.1 * r * r * r;
    clast_vec3 inertia = {0.41 * m * r * r, 0.93 * m * r * r, 1.07 * m * r * r};
    return add_shape(
        w, &(clast_shape_def){"uneven", material, 3, centre, radius, m, inertia, 0, NULL});
}

clast_vec3 vec(double x, double y, double z) { return (clast_vec3){x, y, z}; }
clast_vec3 plus(clast_vec3 a, clast_vec3 b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
clast_vec3 minus(clast_vec3 a, clast_vec3 b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
clast_vec3 times(double s, clast_vec3 a) { return vec(s * a.x, s * a.y, s * a.z); }
double dot(clast_vec3 a, clast_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double norm(clast_vec3 a) { return sqrt(dot(a, a)); }

clast_vec3 cross(clast_vec3 a, clast_vec3 b) {
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

clast_quat any_orientation(dice *d) {
    for (;;) {
        clast_quat q = {roll(d, -1, 1), roll(d, -1, 1), roll(d, -1, 1), roll(d, -1, 1)};
        double n2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, n = sqrt(n2);
        if (n2 < 1 && n2 > 0.01) return (clast_quat){q.w / n, q.x / n, q.y / n, q.z / n};
    }
}
