/* cmd_check.c - reads a scene, says everything that is wrong with it, or what it holds. */
#include "experiments/clast/commands.h"
#include "experiments/clast/options.h"
#include "experiments/scene/rebound.h"
#include "experiments/scene/scene.h"
#include "experiments/scene/schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const char HELP[] =
    "usage: clast check SCENE [--set NAME=VALUE]...\n"
    "       clast check --keys\n"
    "\n"
    "Reads the scene, places its bodies and checks them against each other. Prints all faults, "
    "each\n"
    "with its line, or a summary of what the scene holds.\n"
    "\n"
    "  --set NAME=VALUE   replaces an entry of the section parameters; may come several times\n"
    "  --keys             prints the reference of all keys of a scene as Markdown\n"
    "\n"
    "example: clast check experiments/button-hopper/discharge.yaml --set orifice=5cm\n"
    "exit code: 0 no fault (warnings at most), 3 faults, 4 the file cannot be read, 2 usage\n";

typedef struct arguments {
    const char *path;
    option_list set;
    bool keys;
} arguments;

/* False, with a message on standard error, when the command line makes no sense. */
static bool read_arguments(int argc, char **argv, arguments *a) {
    const option options[] = {
        {"--set", OPTION_LIST, &a->set, NULL},
        {"--keys", OPTION_FLAG, &a->keys, NULL},
    };
    int found =
        options_read("check", argc, argv, options, sizeof options / sizeof *options, &a->path, 1);
    if (found == 0 && !a->keys)
        fprintf(stderr, "clast check: which scene? See clast check --help\n");
    return found == 1 || (found == 0 && a->keys);
}

static void print_shapes(const scene *s) {
    clast_bodies b = clast_world_bodies(s->world);
    for (int i = 0; i < clast_world_shape_count(s->world); i++) {
        clast_shape_def shape = clast_world_shape(s->world, i);
        size_t count = 0;
        for (size_t k = 0; k < b.count; k++) count += b.shape[k] == i;
        printf(
            "  %s: %zu bodies, %d sphere%s of %s, mass %.4g g, inertia [%.4g, %.4g, %.4g] kg m2\n",
            shape.name, count, shape.spheres, shape.spheres == 1 ? "" : "s",
            s->materials[shape.material].name, 1e3 * shape.mass, shape.inertia.x, shape.inertia.y,
            shape.inertia.z);
    }
}

static void print_wall(const scene *s, int i) {
    const clast_world *w = s->world;
    clast_wall_def wall = clast_world_wall(w, i);
    printf("  %s: %s of %s, part %s, at [%.4g, %.4g, %.4g] m, normal [%.4g, %.4g, %.4g]\n",
           wall.name, wall.kind == CLAST_WALL_PLANE ? "plane" : "plate",
           s->materials[wall.material].name, clast_world_part(w, clast_world_wall_part(w, i)).name,
           wall.point.x, wall.point.y, wall.point.z, wall.normal.x, wall.normal.y, wall.normal.z);
}

/* All flat pieces of a mesh in one line. */
static void print_mesh(const scene *s, const scene_mesh *m) {
    double low[3], high[3];
    for (size_t i = 0; i < 3 * m->vertex_count; i++) {
        double x = m->vertex[i];
        low[i % 3] = i < 3 || x < low[i % 3] ? x : low[i % 3];
        high[i % 3] = i < 3 || x > high[i % 3] ? x : high[i % 3];
    }
    clast_wall_def wall = clast_world_wall(s->world, m->wall);
    printf("  %s: %zu triangles in %d pieces of %s, part %s, from [%.4g, %.4g, %.4g] to [%.4g, "
           "%.4g, %.4g] m\n",
           m->name, m->triangle_count, m->walls, s->materials[wall.material].name,
           clast_world_part(s->world, clast_world_wall_part(s->world, m->wall)).name, low[0],
           low[1], low[2], high[0], high[1], high[2]);
}

static void print_walls(const scene *s) {
    const clast_world *w = s->world;
    printf("walls: %d in %d part%s\n", clast_world_wall_count(w), clast_world_part_count(w),
           clast_world_part_count(w) == 1 ? "" : "s");
    const scene_mesh *m = s->meshes, *end = s->meshes + s->mesh_count;
    for (int i = 0; i < clast_world_wall_count(w);) {
        if (m < end && m->wall == i) {
            print_mesh(s, m);
            i += m++->walls;
        } else {
            print_wall(s, i++);
        }
    }
    if (s->mesh_reports[0]) printf("meshes:\n%s", s->mesh_reports);
}

static void print_parameters(const clast_pair_def *pair) {
    int count = CLAST_LAW_PARAMETERS;
    while (count > 0 && pair->parameter[count - 1] == 0) count--;
    printf("parameters [");
    for (int i = 0; i < count; i++) printf("%s%g", i ? ", " : "", pair->parameter[i]);
    printf("]");
}

static void print_rebound(clast_law law, const clast_pair_def *pair) {
    if (pair->rolling_friction > 0) printf("rolling friction %g, ", pair->rolling_friction);
    if (law == CLAST_LAW_USER) {
        print_parameters(pair);
        return;
    }
    if (clast_law_info_of(law)->dissipation && pair->dissipation > 0) {
        printf("dissipation %g s", pair->dissipation);
        return;
    }
    printf("restitution %g", pair->restitution);
    if (clast_law_info_of(law)->dissipation && pair->reference_speed > 0)
        printf(" at %g m/s", pair->reference_speed);
    else if (!clast_law_info_of(law)->yields && !clast_law_info_of(law)->dissipation)
        printf(", damping ratio %.5f", clast_damping_ratio(law, pair->restitution));
}

static const char *stiffness_of(clast_law law) {
    if (law == CLAST_LAW_USER) return "Forces are those of the law's own function.";
    return clast_law_info_of(law)->stiffness
               ? "Stiffness is that of the pair."
               : "Its stiffness follows from both materials: 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2.";
}

static void print_pairs(const scene *s) {
    clast_law law = clast_world_definition(s->world)->law;
    clast_plan plan = clast_world_plan(s->world);
    printf("pairs: measured in one head-on collision at %.3g m/s and this scene's step, %.3g s\n",
           plan.impact_speed, plan.time_step);
    for (int i = 0; i < s->pair_count; i++) {
        const scene_pair *p = &s->pairs[i];
        double measured = scene_rebound(s, p);
        printf("  %s / %s: friction %g, ", s->materials[p->a].name, s->materials[p->b].name,
               p->def.friction);
        print_rebound(law, &p->def);
        printf(", measured ");
        if (measured >= 0)
            printf("%.5f\n", measured);
        else
            printf("nothing: they do not part at this step\n");
    }
    printf("mixing: none; every pair is stated. %s\n", stiffness_of(law));
}

static void print_summary(const scene *s) {
    printf("%s: %s\n", s->path, s->title);
    printf("bodies: %zu, element spheres: %zu\n", clast_world_bodies(s->world).count,
           clast_world_spheres(s->world).count);
    print_shapes(s);
    if (s->clumps[0]) printf("clumps:\n%s", s->clumps);
    print_walls(s);
    print_pairs(s);
    printf("ends: at %g s", s->ending.latest);
    if (s->ending.rest_for > 0)
        printf(", or when no body has been faster than %g m/s for %g s", s->ending.rest_speed,
               s->ending.rest_for);
    printf("\nmeasures: %d\n", s->measure_count);
}

static int check(const arguments *a) {
    if (access(a->path, R_OK)) {
        fprintf(stderr, "%s: cannot be opened\n", a->path);
        return CLAST_EXIT_FILE;
    }
    char *faults = NULL;
    scene_options options = {.set = a->set.items, .set_count = a->set.count};
    scene *s = scene_load(a->path, &options, &faults);
    if (faults) fputs(faults, stderr);
    if (s) print_summary(s);
    int code = s ? CLAST_EXIT_OK : CLAST_EXIT_BAD_SCENE;
    scene_free(s);
    free(faults);
    return code;
}

static int print_keys(void) {
    char *reference = schema_reference();
    fputs(reference, stdout);
    free(reference);
    return CLAST_EXIT_OK;
}

int cmd_check(int argc, char **argv) {
    if (options_ask_help(argc, argv)) {
        fputs(HELP, stdout);
        return CLAST_EXIT_OK;
    }
    arguments a = {0};
    if (!read_arguments(argc, argv, &a)) return CLAST_EXIT_USAGE;
    return a.keys ? print_keys() : check(&a);
}
