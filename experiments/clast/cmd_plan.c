/* cmd_plan.c - what a run would do and cost: kernel, step and its limits, time, and what fewer
 * spheres or a larger step would save. Every saving named here was measured or follows from the
 * plan. */
#include "experiments/clast/commands.h"
#include "experiments/clast/options.h"
#include "experiments/scene-needs/needs.h"
#include "experiments/scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static const char HELP[] =
    "usage: clast plan SCENE [--set NAME=VALUE]... [--threads N]\n"
    "                  [--spheres-per-thread N] [--steps N]\n"
    "\n"
    "Says which kernel the engine picked, the time step with each of its limits, how many steps "
    "and\n"
    "how long a run takes, and what could be dropped at what saving. Times N steps (default 200) "
    "of\n"
    "the scene as it starts, after as many to warm up; nothing is written. At the end stands what "
    "the\n"
    "features that the scene uses were worth where that was measured (experiments/scene-needs).\n"
    "\n"
    "  --set NAME=VALUE   replaces an entry of the section parameters; may come several times\n"
    "  --threads N        as in clast run\n"
    "  --spheres-per-thread N  likewise\n"
    "  --steps N          how many steps to time\n"
    "\n"
    "example: clast plan experiments/button-hopper/discharge.yaml --set orifice=5cm --threads 2\n"
    "exit code: 0, 1 a guard tripped while timing, 2 usage, 3 faults in the scene, 4 no such "
    "file\n";

typedef struct arguments {
    const char *path;
    option_list set;
    scene_options options;
    int steps;
} arguments;

/* False, with a message on standard error, when the command line makes no sense. */
static bool read_arguments(int argc, char **argv, arguments *a) {
    const option options[] = {
        {"--set", OPTION_LIST, &a->set, NULL},
        {"--threads", OPTION_COUNT, &a->options.threads, NULL},
        {"--spheres-per-thread", OPTION_COUNT, &a->options.spheres_per_thread, NULL},
        {"--steps", OPTION_COUNT, &a->steps, NULL},
    };
    int found =
        options_read("plan", argc, argv, options, sizeof options / sizeof *options, &a->path, 1);
    if (found == 0) fprintf(stderr, "clast plan: which scene? See clast plan --help\n");
    a->options.set = a->set.items;
    a->options.set_count = a->set.count;
    return found == 1;
}

/* ---- timing ---------------------------------------------------------------------------------- */

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Seconds a step: the fastest of five parts, for other work on the machine only ever adds. Negative
 * when a guard stopped the run. */
static double time_steps(clast_world *w, int steps) {
    double best = INFINITY;
    for (int i = 0; i < steps; i++)
        if (clast_world_step(w)) return -1;
    for (int part = 0; part < 5; part++) {
        int count = steps / 5 > 0 ? steps / 5 : 1;
        double start = now();
        for (int i = 0; i < count; i++)
            if (clast_world_step(w)) return -1;
        double each = (now() - start) / count;
        best = each < best ? each : best;
    }
    return best;
}

static void print_duration(double seconds) {
    if (seconds < 120)
        printf("%.3g s", seconds);
    else if (seconds < 7200)
        printf("%.3g min", seconds / 60);
    else
        printf("%.3g h", seconds / 3600);
}

/* ---- the step -------------------------------------------------------------------------------- */

static void print_limit(const char *name, double limit, const char *from, bool rules) {
    printf("  %-20s %10.4g s  %s%s\n", name, limit, from, rules ? "  <- rules" : "");
}

static void print_step(const clast_plan *p, const clast_world_def *def, bool given) {
    char text[100];
    double rayleigh = def->rayleigh_fraction * p->rayleigh_step;
    double contact = p->contact_time / def->contact_resolution;
    bool linear = clast_law_info_of(def->law)->linear, by_contact = linear || contact <= rayleigh;
    bool held = !given && p->time_step < (1 - 1e-9) * (by_contact ? contact : rayleigh);
    bool others = !given && !held;
    printf("step: %.6g s, %s\n", p->time_step,
           given ? "as the scene says" : "the smallest of its limits");
    snprintf(text, sizeof text, "%g of the Rayleigh step, %.4g s", def->rayleigh_fraction,
             p->rayleigh_step);
    if (!linear) print_limit("Rayleigh", rayleigh, text, others && !by_contact);
    snprintf(text, sizeof text, "shortest contact, %.4g s at %.3g m/s, in %g steps",
             p->contact_time, p->impact_speed, def->contact_resolution);
    print_limit("contact resolution", contact, text, others && by_contact);
    snprintf(text, sizeof text, "2/omega, where a contact becomes unstable; the step is %.2g of it",
             p->time_step / p->critical_step);
    print_limit("critical", p->critical_step, text, held);
    printf("  so the shortest contact takes %.1f steps\n", p->resolution);
}

/* How many bodies a scene with feeds will hold is what its run finds out. */
static void print_feeds(const clast_world *w) {
    for (int i = 0; i < clast_world_feed_count(w); i++) {
        clast_feed_def d = clast_world_feed(w, i);
        bool mass = d.mass_rate > 0;
        printf(
            "feed: %s, %.6g %s; the hold-up is not known before the run, so no cost below counts "
            "what will have come\n",
            d.name, mass ? 3600 * d.mass_rate : d.number_rate, mass ? "kg/h" : "bodies/s");
    }
}

static void print_cost(const scene *s, double each, int steps) {
    double dt = clast_world_time_step(s->world), count = ceil(s->ending.latest / dt);
    size_t spheres = clast_world_spheres(s->world).count;
    clast_counters c = clast_world_counters(s->world);
    printf("steps: %.0f to %g s\n", count, s->ending.latest);
    printf("cost: %.4g us a step (%.3g million sphere-steps/s), measured over %d steps from the "
           "start\n",
           1e6 * each, (double)spheres / each / 1e6, steps);
    printf("  %zu bodies, %zu spheres, %zu pairs listed, %zu contacts now, %.3g MB\n", c.bodies,
           spheres, c.pairs, c.contacts, (double)c.bytes / 1e6);
    printf("  the whole run: ");
    print_duration(count * each);
    printf(" if it stays as crowded as it starts; frames and pictures come on top\n");
    if (c.contacts < c.bodies)
        printf("  (most bodies are in flight as yet: a settled bed costs more; plan from a settled "
               "one with "
               "bodies: from)\n");
}

/* ---- what could be dropped ------------------------------------------------------------------ */

/* Rayleigh's limit often leaves contacts resolved far better than asked. */
static int suggest_step(const clast_plan *p, const clast_world_def *def) {
    double longest = p->contact_time / def->contact_resolution, critical = 0.5 * p->critical_step;
    double cap = p->rayleigh_step; /* information must not cross a sphere in less than a step */
    double step = longest < critical ? longest : critical;
    bool linear = clast_law_info_of(def->law)->linear;
    if (!linear && step > cap) step = cap;
    if (step < 1.1 * p->time_step) return 0;
    printf("  steps: contacts are resolved by %.0f, %g are asked; a step of %.3g s still does that "
           "and "
           "saves %.0f %%\n",
           p->resolution, def->contact_resolution, step, 100 * (1 - p->time_step / step));
    if (!linear) printf("    (%.2g of the Rayleigh step)\n", step / cap);
    return 1;
}

/* Largest distance from the profile inwards to the nearest sphere, along the ray from its centre:
 * what a fit of an ellipse leaves out. Spheres touch the profile, so it is never negative. */
static double profile_gap(const clast_shape_def *shape) {
    double worst = 0;
    for (int i = 0; i < shape->outline_points; i++) {
        double x = shape->outline[2 * i], z = shape->outline[2 * i + 1], gap = INFINITY;
        for (int k = 0; k < shape->spheres; k++) {
            double dx = x - shape->centre[k].x, dz = z - shape->centre[k].z;
            double away = sqrt(dx * dx + dz * dz) - shape->radius[k];
            gap = away < gap ? away : gap;
        }
        worst = gap > worst ? gap : worst;
    }
    return worst;
}

/* The shape that was fitted: it has an outline and many spheres. */
static int fitted_shape(const clast_world *w) {
    for (int i = 0; i < clast_world_shape_count(w); i++) {
        clast_shape_def shape = clast_world_shape(w, i);
        if (shape.spheres >= 5 && shape.outline_points > 0) return i;
    }
    return -1;
}

static int suggest_fewer_spheres(const arguments *a, const scene *s, double each) {
    int fitted = fitted_shape(s->world), suggested = 0;
    if (fitted < 0) return 0;
    clast_shape_def before = clast_world_shape(s->world, fitted);
    for (int spheres = before.spheres - 2; spheres >= 3 && suggested < 2; spheres -= 2) {
        scene_options fewer = a->options;
        char *faults = NULL;
        fewer.fit_spheres = spheres;
        scene *other = scene_load(a->path, &fewer, &faults);
        free(faults);
        if (!other) break;
        clast_shape_def after = clast_world_shape(other->world, fitted);
        double cost = after.spheres == spheres ? time_steps(other->world, a->steps) : -1;
        if (cost > 0) {
            printf("  %s: %d spheres in place of %d %s %.0f %% of the time (measured); the largest "
                   "gap "
                   "to the\n    profile grows from %.3g to %.3g mm\n",
                   after.name, spheres, before.spheres,
                   cost < 0.95 * each ? "save" : "save hardly anything:",
                   100 * fmax(0, 1 - cost / each), 1e3 * profile_gap(&before),
                   1e3 * profile_gap(&after));
            suggested++;
        }
        scene_free(other);
        if (cost <= 0) break;
    }
    return suggested;
}

/* The two worlds are timed in turn, from the same step on: other work on the machine slows down
 * either. */
static int suggest_mixed(const arguments *a, const scene *s) {
    if (clast_world_definition(s->world)->precision == CLAST_PRECISION_MIXED) return 0;
    scene_options mixed = a->options;
    char *faults = NULL;
    mixed.mixed = true;
    scene *other = scene_load(a->path, &mixed, &faults);
    free(faults);
    if (!other) return 0;
    double full = INFINITY, half = INFINITY;
    time_steps(other->world, a->steps); /* the other has done as much already */
    for (int round = 0; round < 3 && half > 0 && full > 0; round++) {
        half = fmin(half, time_steps(other->world, a->steps));
        full = fmin(full, time_steps(s->world, a->steps));
    }
    scene_free(other);
    if (!(half > 0 && full > 0 && half < 0.95 * full)) return 0;
    printf("  precision: mixed saves %.0f %% of the time (measured); collisions change by some "
           "1e-7 of "
           "the\n    impact speed, a bed at rest creeps by some 1e-5 radii in a million steps\n",
           100 * (1 - half / full));
    return 1;
}

/* Bodies that start in one layer across an axis and are not pushed along it stay there only if
 * every wall they meet is across the layer too; that is for the user to judge, so it is put with an
 * if. */
static int find_layer(const scene *s) {
    const clast_world_def *def = clast_world_definition(s->world);
    clast_bodies b = clast_world_bodies(s->world);
    const double *at[3] = {b.x, b.y, b.z}, *v[3] = {b.vx, b.vy, b.vz};
    const double gravity[3] = {def->gravity.x, def->gravity.y, def->gravity.z};
    if (def->motion == CLAST_MOTION_IN_PLANE || b.count < 2) return -1;
    for (int axis = 0; axis < 3; axis++) {
        bool layer = gravity[axis] == 0;
        for (size_t i = 0; i < b.count && layer; i++)
            layer = at[axis][i] == at[axis][0] && v[axis][i] == 0;
        if (layer) return axis;
    }
    return -1;
}

static int suggest_plane(int axis) {
    if (axis < 0) return 0;
    printf("  the third dimension: all bodies start in one plane across %c and nothing moves them "
           "along "
           "it;\n    motion: in-plane %c would say so, if no wall is oblique to it\n",
           "xyz"[axis], "xyz"[axis]);
    return 1;
}

/* ---- what the scene asks for ----------------------------------------------------------------- */

typedef struct pair_features {
    bool friction, cohesion, rolling, damping;
} pair_features;

static pair_features features_of_pairs(const scene *s) {
    pair_features f = {false, false, false, false};
    bool own = clast_world_definition(s->world)->law == CLAST_LAW_USER;
    for (int i = 0; i < s->pair_count; i++) {
        const clast_pair_def *pair = &s->pairs[i].def;
        f.friction = f.friction || pair->friction > 0;
        f.cohesion = f.cohesion || pair->cohesion > 0;
        f.rolling = f.rolling || pair->rolling_friction > 0;
        f.damping = f.damping || (!own && (pair->restitution < 1 || pair->dissipation > 0));
    }
    return f;
}

static void print_not_modelled(const scene *s) {
    pair_features f = features_of_pairs(s);
    const clast_world_def *def = clast_world_definition(s->world);
    printf("  not asked for, so not modelled:%s%s%s%s%s\n", f.friction ? "" : " friction",
           f.rolling ? "" : " rolling friction", f.cohesion ? "" : " cohesion",
           def->global_damping > 0 ? "" : " global damping",
           def->motion == CLAST_MOTION_IN_PLANE ? " motion out of plane" : "");
}

/* What friction keeps of a contact's past; a law of the user's own keeps what it likes. */
static bool has_history(const clast_world_def *def, bool friction) {
    bool spring = def->tangent == CLAST_TANGENT_SPRING;
    if (def->tangent == CLAST_TANGENT_BY_LAW) spring = clast_law_info_of(def->law)->spring;
    return spring && friction && def->law != CLAST_LAW_USER;
}

static bool has_clumps(const clast_world *w) {
    for (int i = 0; i < clast_world_shape_count(w); i++)
        if (clast_world_shape(w, i).spheres > 1) return true;
    return false;
}

static void print_needs(const scene *s) {
    const clast_world_def *def = clast_world_definition(s->world);
    pair_features f = features_of_pairs(s);
    bool clumps = has_clumps(s->world);
    const bool uses[NEED_FEATURES] = {
        [NEED_HISTORY] = has_history(def, f.friction),
        [NEED_ROTATION] = f.friction || f.rolling || clumps,
        [NEED_FRICTION] = f.friction,
        [NEED_ROLLING] = f.rolling,
        [NEED_DAMPING] = f.damping,
        [NEED_DEPTH] = def->motion == CLAST_MOTION_3D,
        [NEED_HERTZ] = !clast_law_info_of(def->law)->linear,
        [NEED_SPHERES] = clumps,
        [NEED_PRECISION] = def->precision == CLAST_PRECISION_DOUBLE && def->law != CLAST_LAW_USER,
    };
    need_table *t = needs_measured();
    needs_quote(t, uses, stdout);
    needs_free(t);
}

/* ---- the whole ------------------------------------------------------------------------------- */

static void print_law(const scene *s, clast_law law) {
    printf("law: %s", clast_law_info_of(law)->name);
    if (law == CLAST_LAW_MAW) printf(" (stiffness of the impact speed below)");
    if (law == CLAST_LAW_USER) printf(", %s of %s", s->function, s->library);
    printf("\n");
}

static int plan(const arguments *a, const scene *s) {
    clast_plan p = clast_world_plan(s->world);
    const clast_world_def *def = clast_world_definition(s->world);
    printf("%s: %s\n", s->path, s->title);
    print_feeds(s->world);
    print_law(s, def->law);
    printf("kernel: %s\n", p.kernel);
    printf("threads: %d, lanes: %s, skin: %.3g mm\n", p.threads, p.isa, 1e3 * p.skin);
    printf("precision: %s\n", def->precision == CLAST_PRECISION_MIXED
                                  ? "mixed (positions, overlaps and sums double, the rest at "
                                    "contacts single)"
                                  : "double");
    printf("scheme: %s\n", clast_scheme_info_of(def->scheme)->name);
    print_step(&p, def, s->step_given);
    int layer = find_layer(s); /* before the timing moves anything */
    double each = time_steps(s->world, a->steps);
    if (each < 0) {
        fprintf(stderr, "clast plan: %s\n", clast_world_error(s->world));
        return CLAST_EXIT_RUN_FAILED;
    }
    print_cost(s, each, a->steps);
    printf("what could be dropped:\n");
    int fits = suggest_plane(layer) + suggest_step(&p, def) + suggest_mixed(a, s) +
               suggest_fewer_spheres(a, s, each);
    if (fits == 0) printf("  nothing that this plan can vouch for\n");
    print_not_modelled(s);
    print_needs(s);
    return CLAST_EXIT_OK;
}

static int load_and_plan(arguments *a) {
    if (access(a->path, R_OK)) {
        fprintf(stderr, "%s: cannot be opened\n", a->path);
        return CLAST_EXIT_FILE;
    }
    char *faults = NULL;
    scene *s = scene_load(a->path, &a->options, &faults);
    if (faults) fputs(faults, stderr);
    int code = s ? plan(a, s) : CLAST_EXIT_BAD_SCENE;
    scene_free(s);
    free(faults);
    return code;
}

int cmd_plan(int argc, char **argv) {
    if (options_ask_help(argc, argv)) {
        fputs(HELP, stdout);
        return CLAST_EXIT_OK;
    }
    arguments a = {.steps = 200};
    return read_arguments(argc, argv, &a) ? load_and_plan(&a) : CLAST_EXIT_USAGE;
}
