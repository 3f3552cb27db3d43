/* exchange.c - settled states in the form that LAMMPS and LIGGGHTS read, and dumps in the form that
 * they write. A peer's one-layer scene lies in its xy plane, so there our z is its y. */
#include "tests/bench/exchange.h"

#include "tests/bench/recipe.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* One element sphere in the peers' frame. */
typedef struct atom {
    int id, body; /* from 1, from 0 */
    double x[3], v[3], spin[3];
} atom;

typedef struct atoms {
    size_t count;
    atom *all;           /* by id */
    double radius, mass; /* of each */
    bool flat;           /* one layer: height is y */
} atoms;

static FILE *open_out(const char *out, const char *name, const char *tail) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s%s", out, name, tail);
    mkdir(out, 0777);
    FILE *f = fopen(path, "w");
    if (!f) {
        perror(path);
        exit(1);
    }
    return f;
}

/* ---- from a world ---------------------------------------------------------------------------- */

static void about(clast_world *w, atoms *a) {
    clast_shape_def s = clast_world_shape(w, 0);
    a->radius = s.radius[0];
    a->mass = s.mass / s.spheres;
    a->flat = clast_world_definition(w)->motion == CLAST_MOTION_IN_PLANE;
}

static void to_peers(double out[3], clast_vec3 v, bool flat) {
    out[0] = v.x, out[1] = flat ? v.z : v.y, out[2] = flat ? -v.y : v.z;
}

static atom atom_of(const clast_bodies *b, const clast_spheres *s, size_t i, int sphere,
                    int spheres, bool flat) {
    size_t k = (size_t)s->body[i];
    clast_vec3 spin = {b->wx[k], b->wy[k], b->wz[k]};
    clast_vec3 arm = {s->x[i] - b->x[k], s->y[i] - b->y[k], s->z[i] - b->z[k]};
    clast_vec3 v = {b->vx[k] + spin.y * arm.z - spin.z * arm.y,
                    b->vy[k] + spin.z * arm.x - spin.x * arm.z,
                    b->vz[k] + spin.x * arm.y - spin.y * arm.x};
    atom a = {.id = (int)b->id[k] * spheres + sphere + 1, .body = (int)b->id[k]};
    to_peers(a.x, (clast_vec3){s->x[i], s->y[i], s->z[i]}, flat);
    to_peers(a.v, v, flat);
    to_peers(a.spin, spin, flat);
    return a;
}

static int by_id(const void *a, const void *b) {
    return ((const atom *)a)->id - ((const atom *)b)->id;
}

static atoms atoms_of(clast_world *w, int spheres) {
    clast_bodies b = clast_world_bodies(w);
    clast_spheres s = clast_world_spheres(w);
    atoms a = {.count = s.count, .all = calloc(s.count + 1, sizeof *a.all)};
    if (!a.all) abort();
    about(w, &a);
    int sphere = 0;
    for (size_t i = 0; i < s.count; i++) {
        sphere = i > 0 && s.body[i] == s.body[i - 1] ? sphere + 1 : 0;
        a.all[i] = atom_of(&b, &s, i, sphere, spheres, a.flat);
    }
    qsort(a.all, a.count, sizeof *a.all, by_id);
    return a;
}

/* ---- the settled state for the peers -----------------------------------------------------------
 */

static void write_box(FILE *f, const clast_world_def *d, bool flat) {
    fprintf(f, "%.17g %.17g xlo xhi\n", d->domain_min.x, d->domain_max.x);
    if (flat)
        fprintf(f, "%.17g %.17g ylo yhi\n-0.1 0.1 zlo zhi\n", d->domain_min.z, d->domain_max.z);
    else
        fprintf(f, "%.17g %.17g ylo yhi\n%.17g %.17g zlo zhi\n", d->domain_min.y, d->domain_max.y,
                d->domain_min.z, d->domain_max.z);
}

static void write_data(FILE *f, clast_world *w, const atoms *a, int spheres, double density) {
    fprintf(f, "settled by clast\n\n%zu atoms\n2 atom types\n\n", a->count);
    write_box(f, clast_world_definition(w), a->flat);
    fprintf(f, "\nAtoms\n\n");
    for (size_t i = 0; i < a->count; i++)
        fprintf(f, "%d 1 %.17g %.17g %.17g %.17g %.17g\n", a->all[i].id, 2 * a->radius, density,
                a->all[i].x[0], a->all[i].x[1], a->all[i].x[2]);
    fprintf(f, "\nVelocities\n\n");
    for (size_t i = 0; i < a->count; i++) {
        const atom *t = &a->all[i];
        fprintf(f, "%d %.9g %.9g %.9g %.9g %.9g %.9g\n", t->id, t->v[0], t->v[1], t->v[2],
                t->spin[0], t->spin[1], t->spin[2]);
    }
    if (spheres == 1) return;
    fprintf(f, "\nMolecules\n\n");
    for (size_t i = 0; i < a->count; i++) fprintf(f, "%d %d\n", a->all[i].id, a->all[i].body + 1);
}

/* LAMMPS' damping tsuji takes a restitution and makes of it a dashpot of a(e) sqrt(m 4/3 E* sqrt(R
 * d)), a polynomial. Ours is 2 b sqrt(m 2 E* sqrt(R d)), so the polynomial must give sqrt(6) b. */
static double tsuji(double e) {
    return 1.2728 +
           e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
}

static double tsuji_restitution(double damping_ratio) {
    double low = -0.2, high = 1;
    for (int i = 0; i < 200; i++) {
        double middle = 0.5 * (low + high);
        if (tsuji(middle) > sqrt(6) * damping_ratio)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* LIGGGHTS works the dashpot out from e by the closed form: 2 sqrt(5/6) b' sqrt(m k_n) with
 * b' = -ln e / sqrt(ln2 e + pi2); we give it the e that makes our dashpot. */
static double liggghts_restitution(double damping_ratio) {
    double b = damping_ratio / sqrt(5.0 / 6.0);
    return exp(-3.14159265358979323846 * b / sqrt(1 - b * b));
}

static void put(FILE *f, const char *name, double value) {
    fprintf(f, "variable %s equal %.17g\n", name, value);
}

/* The stiffness of grains of (E, nu) against others of (E2, nu2): 4/3 E* and 8 G*. */
static void put_stiffness(FILE *f, const char *kn, const char *kt, const char *xt, double young,
                          double poisson, double young2, double poisson2) {
    double e_star = 1 / ((1 - poisson * poisson) / young + (1 - poisson2 * poisson2) / young2);
    double g_star = 1 / (2 * (2 - poisson) * (1 + poisson) / young +
                         2 * (2 - poisson2) * (1 + poisson2) / young2);
    put(f, kn, 4.0 / 3.0 * e_star), put(f, kt, 8 * g_star);
    put(f, xt, sqrt(4 * g_star / e_star)); /* tangential over normal dashpot */
}

static void put_law(FILE *f, const bench_law *l) {
    put(f, "density", l->density), put(f, "young", l->young), put(f, "poisson", l->poisson);
    put(f, "youngwall", l->wall_young), put(f, "poissonwall", l->wall_poisson);
    put(f, "mu", l->friction), put(f, "muwall", l->wall_friction);
    put_stiffness(f, "kn", "kt", "xt", l->young, l->poisson, l->young, l->poisson);
    put_stiffness(f, "knwall", "ktwall", "xtwall", l->young, l->poisson, l->wall_young,
                  l->wall_poisson);
    double b = clast_damping_ratio(CLAST_LAW_HERTZ_MINDLIN, l->restitution);
    double bw = clast_damping_ratio(CLAST_LAW_HERTZ_MINDLIN, l->wall_restitution);
    put(f, "etsuji", tsuji_restitution(b)), put(f, "etsujiwall", tsuji_restitution(bw));
    put(f, "eliggghts", liggghts_restitution(b));
    put(f, "eliggghtswall", liggghts_restitution(bw));
    put(f, "dampingratio", b), put(f, "dampingratiowall", bw);
}

/* gran/hertz/history damps by a sqrt(R d) m g, a dashpot that no restitution belongs to: g is such
 * that it equals ours at a contact that carries ten bodies. */
static void put_simple_damping(FILE *f, const bench_law *l, double mass, double radius) {
    double kn = 2.0 / 3.0 * l->young / (1 - l->poisson * l->poisson), reduced = 0.5 * radius;
    double overlap = pow(10 * mass * 9.81 / (kn * sqrt(reduced)), 2.0 / 3.0);
    double a = sqrt(reduced * overlap);
    double b = clast_damping_ratio(CLAST_LAW_HERTZ_MINDLIN, l->restitution);
    double dashpot = 2 * b * sqrt(1.5 * kn * a * 0.5 * mass), g = dashpot / (a * 0.5 * mass);
    put(f, "gamman", g), put(f, "gammat", 0.9 * g);
}

/* A chain of touching spheres: mass, and moments about and across its axis. */
static void put_chain(FILE *f, int spheres, double mass, double radius) {
    double along = 0.4 * mass * radius * radius * spheres, across = along;
    for (int k = 0; k < spheres; k++) {
        double arm = radius * (2 * k - spheres + 1);
        across += mass * arm * arm;
    }
    put(f, "bodymass", spheres * mass), put(f, "inertiaalong", along);
    put(f, "inertiaacross", across);
}

/* One chain along x, as LIGGGHTS reads it: x y z r. */
static void write_clump(FILE *f, int spheres, double radius) {
    for (int k = 0; k < spheres; k++)
        fprintf(f, "%.17g 0 0 %.17g\n", radius * (2 * k - spheres + 1), radius);
}

/* In the peers' frame: gravity, and the speed of the floor along x. */
static void put_surroundings(FILE *f, clast_world *w) {
    const clast_world_def *d = clast_world_definition(w);
    double g[3];
    to_peers(g, d->gravity, d->motion == CLAST_MOTION_IN_PLANE);
    put(f, "gx", g[0]), put(f, "gy", g[1]), put(f, "gz", g[2]);
    put(f, "belt", clast_world_wall(w, 0).belt_velocity.x);
}

static void write_peer_walls(const bench_scene *scene, const char *out) {
    char stem[4096];
    snprintf(stem, sizeof stem, "%s/%s", out, scene->name);
    FILE *f = open_out(out, scene->name, ".walls");
    fprintf(f, "# walls that liggghts.in cannot build by itself\n");
    if (scene->recipe->peer_walls) scene->recipe->peer_walls(f, stem);
    fclose(f);
}

int bench_export(const bench_scene *scene, const char *states, const char *out) {
    bench_wish wish = {.threads = 1, .fresh = true};
    clast_world *w = bench_scene_open(scene, &wish, states);
    atoms a = atoms_of(w, scene->spheres);
    bench_law law = scene->recipe->law();
    FILE *f = open_out(out, scene->name, ".data");
    write_data(f, w, &a, scene->spheres, law.density);
    fclose(f);
    f = open_out(out, scene->name, ".vars");
    put(f, "step", scene->dt), put(f, "radius", a.radius), put(f, "mass", a.mass);
    fprintf(f, "variable spheres equal %d\n", scene->spheres);
    put_law(f, &law);
    put_chain(f, scene->spheres, a.mass, a.radius);
    put_simple_damping(f, &law, a.mass * scene->spheres, a.radius);
    double half[2];
    scene->recipe->half_size(scene, half);
    put(f, "halfx", half[0]), put(f, "halfy", half[1]);
    put_surroundings(f, w);
    fclose(f);
    if (scene->spheres > 1) {
        f = open_out(out, scene->name, ".clump");
        write_clump(f, scene->spheres, a.radius);
        fclose(f);
    }
    write_peer_walls(scene, out);
    free(a.all);
    clast_world_free(w);
    return 0;
}

int bench_list(void) {
    for (int i = 0; i < bench_scene_count; i++) {
        const bench_scene *s = &bench_scenes[i];
        bench_wish wish = {.threads = 1};
        clast_world *w = s->recipe->world(s, &wish, BENCH_RUNNING);
        if (s->use != BENCH_USE_SCALING)
            printf("%s %zu %d %g %" PRIu64 " %" PRIu64 " %.9g %s\n", s->name, s->bodies, s->spheres,
                   s->dt, s->steps, s->warm, clast_world_shape(w, 0).radius[0], s->recipe->kind);
        clast_world_free(w);
    }
    return 0;
}

/* ---- dumps -------------------------------------------------------------------------------------
 */

static void write_dump(const atoms *a, const bench_scene *scene, uint64_t step, const char *out) {
    char tail[64];
    snprintf(tail, sizeof tail, "-clast-%" PRIu64 ".dump", step);
    FILE *f = open_out(out, scene->name, tail);
    fprintf(f, "ITEM: TIMESTEP\n%" PRIu64 "\nITEM: NUMBER OF ATOMS\n%zu\n", step, a->count);
    fprintf(f, "ITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\n");
    fprintf(f, "ITEM: ATOMS id x y z vx vy vz omegax omegay omegaz\n");
    for (size_t i = 0; i < a->count; i++) {
        const atom *t = &a->all[i];
        fprintf(f, "%d %.12g %.12g %.12g %.9g %.9g %.9g %.9g %.9g %.9g\n", t->id, t->x[0], t->x[1],
                t->x[2], t->v[0], t->v[1], t->v[2], t->spin[0], t->spin[1], t->spin[2]);
    }
    fclose(f);
}

int bench_physics(const bench_scene *scene, const char *const *steps, int count, const char *states,
                  const char *out) {
    bench_wish wish = {.threads = 2, .fresh = true};
    clast_world *w = bench_scene_open(scene, &wish, states);
    for (int i = 0; i < count; i++) {
        uint64_t until = strtoull(steps[i], NULL, 10);
        while (clast_world_steps(w) < until) bench_steps(w, 1);
        atoms a = atoms_of(w, scene->spheres);
        write_dump(&a, scene, until, out);
        free(a.all);
    }
    clast_world_free(w);
    return 0;
}

/* ---- judging a dump ----------------------------------------------------------------------------
 */

/* The number after ITEM: NUMBER OF ATOMS; the file then stands at the first atom. */
static size_t read_header(FILE *f) {
    char line[512];
    size_t count = 0;
    while (fgets(line, sizeof line, f)) {
        if (strncmp(line, "ITEM: NUMBER", 12) == 0 && fscanf(f, "%zu", &count) != 1) return 0;
        if (strncmp(line, "ITEM: ATOMS", 11) == 0) return count;
    }
    return 0;
}

static bool read_atom(FILE *f, atom *a) {
    return fscanf(f, "%d %lf %lf %lf %lf %lf %lf %lf %lf %lf", &a->id, &a->x[0], &a->x[1], &a->x[2],
                  &a->v[0], &a->v[1], &a->v[2], &a->spin[0], &a->spin[1], &a->spin[2]) == 10;
}

static atoms read_dump(const char *path, int spheres) {
    atoms a = {0};
    FILE *f = fopen(path, "r");
    if (!f) {
        perror(path);
        exit(1);
    }
    size_t count = read_header(f);
    a.all = calloc(count + 1, sizeof *a.all);
    if (!a.all) abort();
    while (a.count < count && read_atom(f, &a.all[a.count])) {
        a.all[a.count].body = (a.all[a.count].id - 1) / spheres;
        a.count++;
    }
    fclose(f);
    if (a.count == count && count > 0) return a;
    fprintf(stderr, "%s: not a whole dump\n", path);
    exit(1);
}

static int by_x(const void *a, const void *b) {
    double x = ((const atom *)a)->x[0], y = ((const atom *)b)->x[0];
    return x < y ? -1 : x > y;
}

static bool touch(const atom *a, const atom *b, double diameter) {
    double d2 = 0;
    for (int k = 0; k < 3; k++) d2 += (a->x[k] - b->x[k]) * (a->x[k] - b->x[k]);
    return a->body != b->body && d2 < diameter * diameter;
}

/* Pairs of spheres of different bodies that touch; leaves the atoms sorted by x. */
static size_t count_contacts(atoms *a) {
    double diameter = 2 * a->radius;
    size_t contacts = 0;
    qsort(a->all, a->count, sizeof *a->all, by_x);
    for (size_t i = 0; i < a->count; i++)
        for (size_t j = i + 1; j < a->count && a->all[j].x[0] - a->all[i].x[0] < diameter; j++)
            contacts += touch(&a->all[i], &a->all[j], diameter);
    return contacts;
}

static double square(const double v[3]) {
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* m, below which 99 % of the centres are. */
static double height_of(const atoms *a) {
    double *z = calloc(a->count, sizeof *z);
    if (!z) abort();
    for (size_t i = 0; i < a->count; i++) z[i] = a->all[i].x[a->flat ? 1 : 2];
    qsort(z, a->count, sizeof *z, by_value);
    double height = z[(size_t)(0.99 * (double)(a->count - 1))];
    free(z);
    return height;
}

int bench_judge(const bench_scene *scene, const char *dump) {
    bench_wish wish = {.threads = 1};
    clast_world *w = scene->recipe->world(scene, &wish, BENCH_RUNNING);
    atoms a = read_dump(dump, scene->spheres);
    about(w, &a);
    double kinetic = 0, rotational = 0, middle = 0;
    size_t below = 0, contacts = count_contacts(&a);
    for (size_t i = 0; i < a.count; i++) {
        kinetic += 0.5 * a.mass * square(a.all[i].v);
        rotational += 0.2 * a.mass * a.radius * a.radius * square(a.all[i].spin);
        middle += a.all[i].x[a.flat ? 1 : 2] / (double)a.count;
        below += a.all[i].x[a.flat ? 1 : 2] < 0;
    }
    printf("spheres %zu contacts_per_sphere %.5f kinetic_J %.6e spin_J %.6e mean_height_m %.6f "
           "height_m %.6f below %zu\n",
           a.count, (double)contacts / (double)a.count, kinetic, rotational, middle, height_of(&a),
           below);
    free(a.all);
    clast_world_free(w);
    return 0;
}
