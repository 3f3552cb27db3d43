/* shape.c - templates of bodies: element spheres, mass, moments of inertia. */
#include "engine/world.h"

/* Mass and inertia of spheres that do not overlap; {0} moments when they do. */
static bool spheres_overlap(const clast_shape_def *d) {
    for (int i = 0; i < d->spheres; i++)
        for (int j = i + 1; j < d->spheres; j++) {
            double reach = d->radius[i] + d->radius[j];
            vec3 gap = v3_sub(d->centre[i], d->centre[j]);
            if (v3_dot(gap, gap) < reach * reach * (1 - 1e-9)) return true;
        }
    return false;
}

static double sphere_mass(double density, double r) {
    return density * (4.0 / 3.0 * 3.14159265358979323846) * (r * r * r);
}

static double mass_of(const clast_shape_def *d, double density) {
    double mass = 0;
    for (int i = 0; i < d->spheres; i++) mass += sphere_mass(density, d->radius[i]);
    return mass;
}

/* Parallel axes, scaled to the mass that the shape ends up with. */
static vec3 inertia_of(const clast_shape_def *d, double density, double mass) {
    vec3 sum = {0, 0, 0};
    double solid = 0;
    for (int i = 0; i < d->spheres; i++) {
        double m = sphere_mass(density, d->radius[i]), own = 0.4 * d->radius[i] * d->radius[i];
        vec3 c = v3_mul(d->centre[i], d->centre[i]);
        sum = v3_add(sum, v3_scale(m, v3(own + c.y + c.z, own + c.x + c.z, own + c.x + c.y)));
        solid += m;
    }
    return v3_scale(mass / solid, sum);
}

static double cube(double r) {
    return r * r * r;
}

static double size_of(const clast_shape_def *d) {
    double size = 0;
    for (int i = 0; i < d->spheres; i++) size = fmax(size, v3_norm(d->centre[i]) + d->radius[i]);
    return size;
}

/* The centre of mass of the spheres is the origin. */
static bool is_centred(const clast_shape_def *d) {
    vec3 moment = {0, 0, 0};
    double volume = 0;
    for (int i = 0; i < d->spheres; i++) {
        moment = v3_add(moment, v3_scale(cube(d->radius[i]), d->centre[i]));
        volume += cube(d->radius[i]);
    }
    return v3_norm(moment) <= 1e-6 * volume * size_of(d);
}

/* The products of inertia of the spheres vanish. */
static bool is_aligned(const clast_shape_def *d) {
    double xy = 0, yz = 0, zx = 0, all = 0;
    for (int i = 0; i < d->spheres; i++) {
        vec3 c = d->centre[i];
        double m = cube(d->radius[i]);
        xy += m * c.x * c.y, yz += m * c.y * c.z, zx += m * c.z * c.x, all += m;
    }
    double limit = 1e-6 * all * size_of(d) * size_of(d);
    return fabs(xy) <= limit && fabs(yz) <= limit && fabs(zx) <= limit;
}

static const char *fault_of(const clast_world *w, const clast_shape_def *d) {
    if (d->spheres < 1) return "needs at least one sphere";
    if (d->material < 0 || d->material >= w->material_count) return "has no such material";
    for (int i = 0; i < d->spheres; i++) {
        if (!(d->radius[i] > 0)) return "has a sphere whose radius is not above zero";
        if (!isfinite(d->centre[i].x + d->centre[i].y + d->centre[i].z + d->radius[i]))
            return "has a sphere that is not finite";
    }
    if (!(d->mass >= 0)) return "has a negative mass";
    if (!isfinite(d->mass + d->inertia.x + d->inertia.y + d->inertia.z))
        return "has a mass or a moment of inertia that is not finite";
    vec3 m = d->inertia;
    bool given = m.x != 0 || m.y != 0 || m.z != 0;
    if (given && !(m.x > 0 && m.y > 0 && m.z > 0))
        return "has a moment of inertia that is not above zero";
    double slack = 1e-9 * (m.x + m.y + m.z); /* a flat disc is the limit, to rounding */
    double largest = fmax(m.x, fmax(m.y, m.z));
    bool possible = 2 * largest <= m.x + m.y + m.z + slack;
    if (given && !possible)
        return "has moments of inertia that no body can have (triangle inequality)";
    if ((!given || d->mass == 0) && spheres_overlap(d))
        return "has overlapping spheres: give its mass and inertia";
    if (!given && !is_centred(d))
        return "has its centre of mass off the origin: move its spheres, or give mass and inertia";
    if (!given && !is_aligned(d))
        return "has principal axes other than x, y, z: turn its spheres, or give mass and inertia";
    return NULL;
}

int clast_shape_add(clast_world *w, const clast_shape_def *d) {
    CLAST_ASSERT(w && d && !w->prepared && d->centre && d->radius);
    CLAST_ASSERT(d->outline_points >= 0 && (d->outline || d->outline_points == 0));
    const char *fault = fault_of(w, d);
    if (fault)
        return world_fail(w, CLAST_ERR_ARGUMENT, "shape %s %s", d->name ? d->name : "?", fault), -1;
    double density = w->materials[d->material].density;
    double mass = d->mass > 0 ? d->mass : mass_of(d, density);
    vec3 inertia = d->inertia.x != 0 ? d->inertia : inertia_of(d, density, mass);
    int n = w->shape_count;
    w->shapes = memory_grow(w, w->shapes, (size_t)n, (size_t)n + 1, sizeof *w->shapes);
    shape *s = &w->shapes[n];
    *s = (shape){.name = memory_text(w, d->name),
                 .material = d->material,
                 .spheres = d->spheres,
                 .mass = mass,
                 .inertia = inertia,
                 .outline_points = d->outline_points,
                 .round_inertia = inertia.x == inertia.y && inertia.y == inertia.z};
    s->inverse_mass = 1 / mass;
    s->inverse_inertia = v3(1 / inertia.x, 1 / inertia.y, 1 / inertia.z);
    s->centre = memory_copy(w, d->centre, (size_t)d->spheres, sizeof *s->centre);
    s->radius = memory_copy(w, d->radius, (size_t)d->spheres, sizeof *s->radius);
    s->outline = memory_copy(w, d->outline, 2 * (size_t)d->outline_points, sizeof *s->outline);
    for (int i = 0; i < d->spheres; i++) {
        double arm = v3_norm(s->centre[i]);
        if (arm > s->arm) s->arm = arm;
        if (arm + s->radius[i] > s->bound) s->bound = arm + s->radius[i];
    }
    w->shape_count++;
    return n;
}

int clast_shape_add_sphere(clast_world *w, const char *name, double radius, int of_material) {
    vec3 centre = {0, 0, 0};
    return clast_shape_add(w, &(clast_shape_def){.name = name,
                                                 .material = of_material,
                                                 .spheres = 1,
                                                 .centre = &centre,
                                                 .radius = &radius});
}
