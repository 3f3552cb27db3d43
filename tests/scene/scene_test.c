/* scene_test.c - a scene with every key set, read back; defaults; --set; the reference in the
 * README. */
#include "tests/scene/testing.h"

#include <unistd.h>

#include "experiments/scene/build.h"
#include "experiments/scene/rebound.h"
#include "experiments/scene/scene.h"
#include "experiments/scene/schema.h"

static const char GOOD[] = CLAST_SCENES "/good.yaml";
static const char SMALL[] = CLAST_SCENES "/small.yaml";

static scene *load(const char *path, const char *const *set, int count) {
    char *faults = NULL;
    scene_options options = {.set = set, .set_count = count};
    scene *s = scene_load(path, &options, &faults);
    if (!s || faults) fail_msg("%s", faults ? faults : "no scene, no faults");
    return s;
}

static void same(clast_vec3 v, double x, double y, double z) {
    if (v.x != x || v.y != y || v.z != z)
        fail_msg("got %.17g %.17g %.17g, expected %.17g %.17g %.17g", v.x, v.y, v.z, x, y, z);
}

#define SAME(a, b) assert_memory_equal(&(double){(a)}, &(double){(b)}, sizeof(double))

/* The stages of scene_load() up to the draft, for what a world does not give back. */
typedef struct opened {
    scene_arena arena;
    scene_faults faults;
    scene_parameters parameters;
    scene_draft draft;
} opened;

static void open_draft(opened *o, const char *path) {
    char *text = read_all(path, NULL);
    *o = (opened){.faults = {.arena = &o->arena, .file = path},
                  .draft = {.def = clast_world_def_default()}};
    const tree_node *root = scene_tree_load(&o->arena, &o->faults, text, strlen(text));
    assert_non_null(root);
    o->parameters = scene_parameters_read(&o->arena, &o->faults, root);
    scene_reader reader = {.arena = &o->arena,
                           .faults = &o->faults,
                           .parameters = &o->parameters,
                           .root = root,
                           .folder = CLAST_SCENES "/"};
    scene_read(&reader, &o->draft);
    scene_check(&reader, &o->draft);
    assert_int_equal(o->faults.count, 0);
    free(text);
}

enum { KEYS_MAX = 400 };

typedef struct key_set {
    const scene_key *keys[KEYS_MAX];
    int count;
} key_set;

static bool holds(const key_set *set, const scene_key *key) {
    for (int i = 0; i < set->count; i++)
        if (set->keys[i] == key) return true;
    return false;
}

static void note(key_set *set, const scene_key *key) {
    if (holds(set, key)) return;
    assert_true(set->count < KEYS_MAX);
    set->keys[set->count++] = key;
}

/* Filling solids and meshes with spheres takes a while: tests/shapes/scene_test.c does it once.
 * Walls of triangles are in walls_test.c, motions of parts, feeds and outlets in flow_test.c. */
static bool is_tested_elsewhere(const scene_key *key) {
    static const char *const KEYS[] = {
        "solid", "profile", "mesh",     "unit",         "fill",   "mass_from",
        "bar",   "tube",    "bend",     "axes",         "weld",   "scale",
        "at",    "copies",  "rotation", "smooth_angle", "stroke", "oscillation",
        "table", "feeds",   "outlets",  "periodic"};
    for (size_t i = 0; i < sizeof KEYS / sizeof *KEYS; i++)
        if (!strcmp(key->name, KEYS[i])) return true;
    return false;
}

/* All keys of the tables, or, with a node, those that the scene sets. */
static void walk(const key_section *section, const tree_node *node, bool used_only, key_set *set) {
    for (int i = 0; i < section->count; i++) {
        const scene_key *key = &section->keys[i];
        const tree_node *value = tree_get(node, key->name);
        if ((used_only && !value) || is_tested_elsewhere(key)) continue;
        bool seen = holds(set, key);
        note(set, key);
        bool items = key->kind == KEY_NAMED || key->kind == KEY_LIST;
        if (!key->section || (seen && !used_only)) continue;
        if (!items || !used_only) walk(key->section, value, used_only, set);
        for (const tree_node *entry = items && value ? value->first : NULL; entry;
             entry = entry->next)
            walk(key->section, entry, used_only, set);
    }
}

/* A key that is added to the tables must be added to good.yaml, and so to these tests. */
static void the_good_scene_has_every_key(void **state) {
    (void)state;
    /* needs a checkpoint: bodies_are_inherited; another law: a_viscoelastic_scene,
     * a_law_of_ones_own
     */
    static const char *const ELSEWHERE[] = {"from",    "dissipation", "reference_speed",
                                            "library", "function",    "parameters"};
    static key_set all, used;
    opened o;
    open_draft(&o, GOOD);
    const material_item *first = o.draft.materials.items;
    walk(&SCHEMA_SCENE, NULL, false, &all);
    walk(&SCHEMA_SCENE, first->item.node->parent->parent, true, &used);
    int missing = 0;
    for (int i = 0; i < all.count; i++) {
        bool elsewhere = false;
        for (int k = 0; k < 6; k++) elsewhere |= !strcmp(all.keys[i]->name, ELSEWHERE[k]);
        if (holds(&used, all.keys[i]) || elsewhere) continue;
        print_message("good.yaml does not set '%s' (%s)\n", all.keys[i]->name,
                      all.keys[i]->meaning);
        missing++;
    }
    assert_true(all.count > 100);
    assert_int_equal(missing, 0);
    scene_arena_free(&o.arena);
}

static void materials_and_pairs_are_read(void **state) {
    (void)state;
    opened o;
    open_draft(&o, GOOD);
    const material_item *m = o.draft.materials.items;
    assert_int_equal(o.draft.materials.count, 2);
    assert_string_equal(m[0].item.name, "plastic");
    SAME(m[0].def.density, 1256);
    SAME(m[0].def.young, 3.5e9);
    SAME(m[0].def.poisson, 0.31);
    SAME(m[1].def.poisson, 0.22);
    const pair_item *p = o.draft.pairs.items;
    assert_int_equal(o.draft.pairs.count, 3);
    assert_true(p[1].between[0] == 0 && p[1].between[1] == 1);
    SAME(p[0].def.restitution, 0.72);
    SAME(p[0].def.friction, 0.2);
    SAME(p[0].def.stiffness, 11000);
    SAME(p[0].def.tangential_ratio, 0); /* left to the engine */
    SAME(p[1].def.cohesion, 0.002);
    SAME(p[2].def.tangential_ratio, 0.4);
    SAME(p[2].def.tangential_restitution, 0.5);
    SAME(p[2].def.rolling_friction, 0.02);
    SAME(p[1].def.rolling_friction, 0);
    scene_arena_free(&o.arena);
}

static void a_viscoelastic_scene(void **state) {
    (void)state;
    scene *s = load(CLAST_SCENES "/viscoelastic.yaml", NULL, 0);
    assert_int_equal(clast_world_definition(s->world)->law, CLAST_LAW_HERTZ_BRILLIANTOV);
    assert_int_equal(clast_world_definition(s->world)->tangent, CLAST_TANGENT_SPRING);
    SAME(s->pairs[0].def.reference_speed, 0.5);
    SAME(s->pairs[0].def.dissipation, 0);
    SAME(s->pairs[1].def.dissipation, 0.2e-6);
    assert_non_null(strstr(clast_world_plan(s->world).kernel, "rolling friction"));
    scene_free(s);
}

/* ---- a contact law of one's own -------------------------------------------------------------- */

static const char USER[] = CLAST_SCENES "/user.yaml";

static void a_law_of_ones_own(void **state) {
    (void)state;
    static const char *const SET[] = {"library=" USER_LAW};
    scene *s = load(USER, SET, 1);
    assert_int_equal(clast_world_definition(s->world)->law, CLAST_LAW_USER);
    assert_string_equal(s->library, USER_LAW);
    assert_string_equal(s->function, "quadratic_dashpot");
    const double *first = s->pairs[0].def.parameter, *second = s->pairs[1].def.parameter;
    SAME(first[0], 20000);
    SAME(first[1], 0.5);
    SAME(first[2], 0.7);
    SAME(first[3], 0);
    SAME(second[0], 40000);
    SAME(second[1], 1);
    SAME(second[2], 0);
    SAME(s->pairs[1].def.cohesion, 1e-3);
    assert_int_equal(clast_world_run(s->world, 0.05), CLAST_OK);
    scene_free(s);
}

/* m v' = -k d - q |v| v between the two masses, to the end of the contact: the rebound that the
 * check of a pair has to find. */
static double rebound_of(double k, double q, double mass, double speed) {
    double d = 0, v = speed, dt = 1e-4 * sqrt(mass / k);
    do {
        double force = fmax(0, k * d + q * fabs(v) * v); /* never a pull */
        v -= force / mass * dt;
        d += v * dt;
    } while (d > 0);
    return -v / speed;
}

/* Its pairs rebound as an integration of the law by hand says, to what the step of the scene costs:
 * a dashpot feels a velocity that is half a step old, which is 0.006 at 80 steps per contact
 * (engine/README.md), of first order, and these are 30. */
static void a_pair_rebounds_by_a_law_of_ones_own(void **state) {
    (void)state;
    static const char *const SET[] = {"library=" USER_LAW};
    scene *s = load(USER, SET, 1);
    double mass = 0.5 * clast_world_shape(s->world, 0).mass;
    for (int i = 0; i < 2; i++) {
        const double *p = s->pairs[i].def.parameter;
        double want = rebound_of(p[0], p[1], mass, clast_world_plan(s->world).impact_speed);
        double found = scene_rebound(s, &s->pairs[i]);
        print_message("pair %d rebounds with %.4f, by hand %.4f\n", i, found, want);
        assert_true(want > 0.2 && want < 0.95);
        assert_true(fabs(found - want) < 0.016);
    }
    scene_free(s);
}

static void refuses(const char *const *set, int count, const char *expected) {
    char *faults = NULL;
    scene_options options = {.set = set, .set_count = count};
    assert_null(scene_load(USER, &options, &faults));
    if (!strstr(faults, expected)) fail_msg("%s does not say '%s'", faults, expected);
    free(faults);
}

static void laws_that_cannot_be_used_are_faults(void **state) {
    (void)state;
    static const char *const NAMELESS[] = {"library=" USER_LAW, "law=cubic_dashpot"};
    static const char *const TOMORROW[] = {"library=" USER_LAW_LINEAR, "law=of_tomorrow"};
    refuses(NAMELESS, 2,
            "user.yaml:8: contact.function: contact law " USER_LAW ": has no 'cubic_dashpot'\n");
    refuses(TOMORROW, 2,
            "user.yaml:8: contact.function: contact law " USER_LAW_LINEAR
            ": 'of_tomorrow' is of version 2, expected 1\n");
    refuses(NULL, 0,
            "user.yaml:8: contact.library: found '" CLAST_SCENES
            "/user_law_example.so', which cannot be opened");
}

/* Without a slash, the system would look for a library of that name among its own. */
static void a_law_beside_the_scene_is_found(void **state) {
    (void)state;
    char *text = read_all(USER, NULL), before[4096];
    size_t length;
    char *library = read_all(USER_LAW, &length);
    write_all(CLAST_SCENE_SCRATCH "/user_law_example.so", library, length);
    write_all(CLAST_SCENE_SCRATCH "/own.yaml", text, strlen(text));
    scene_free(load(CLAST_SCENE_SCRATCH "/own.yaml", NULL, 0));
    assert_non_null(getcwd(before, sizeof before));
    assert_int_equal(chdir(CLAST_SCENE_SCRATCH), 0);
    scene *s = load("own.yaml", NULL, 0);
    assert_true(scene_rebound(s, &s->pairs[0]) > 0);
    assert_int_equal(chdir(before), 0);
    scene_free(s);
    free(library);
    free(text);
}

static void generators_are_read(void **state) {
    (void)state;
    opened o;
    open_draft(&o, GOOD);
    const body_item *b = o.draft.bodies.items;
    assert_int_equal(o.draft.bodies.count, 10);
    const generator *grid = &b[2].grid, *random = &b[5].random;
    assert_int_equal(grid->shape, 0);
    assert_int_equal(grid->count, 7);
    same(grid->region_min, -0.1, 0, 0);
    same(grid->spacing, 0.02, 0.02, 0.018);
    SAME(grid->jitter, 0.1);
    SAME(grid->turn.angle, -10 * 0.017453292519943295);
    same(grid->velocity, 0, 0, -0.01);
    same(grid->spin, 0, 1, 0);
    assert_int_equal(b[3].hexagonal.count, 0);
    assert_int_equal(b[3].hexagonal.orientation, ORIENT_RANDOM_IN_PLANE);
    SAME(b[3].hexagonal.spacing.x, 0.009);
    assert_int_equal(random->count, 11);
    assert_int_equal(random->attempts, 500);
    SAME(random->gap, 0.0005);
    assert_int_equal(random->orientation, ORIENT_FIXED);
    SAME(random->turn.angle, 60 * 0.017453292519943295);
    same(random->turn.axis, 0, 1, 0);
    same(random->velocity, 0.002, 0, 0);
    same(random->spin, 0, 3, 0);
    assert_int_equal(b[4].hexagonal.count, 3);
    SAME(b[3].hexagonal.jitter, 0.2);
    same(b[3].hexagonal.spin, 0, 2, 0);
    const mixture_item *by_number = b[6].grid.mixture.items,
                       *by_mass = b[7].hexagonal.mixture.items;
    assert_int_equal(b[6].grid.mixture.count, 2);
    assert_int_equal(by_number[1].shape, 4);
    SAME(by_number[1].number, 0.6);
    SAME(by_number[1].mass, 0);
    assert_int_equal(by_mass[1].shape, 6);
    SAME(by_mass[1].mass, 0.6);
    scene_arena_free(&o.arena);
}

static void the_world_is_defined(void **state) {
    (void)state;
    scene *s = load(GOOD, NULL, 0);
    const clast_world_def *d = clast_world_definition(s->world);
    same(d->gravity, 0.5, 0, -9.79);
    assert_int_equal(d->law, CLAST_LAW_LINEAR);
    assert_int_equal(d->tangent, CLAST_TANGENT_VISCOUS);
    assert_int_equal(d->limit, CLAST_LIMIT_SPRING);
    assert_int_equal(d->unloading, CLAST_UNLOAD_AS_PRINTED);
    assert_int_equal(d->motion, CLAST_MOTION_IN_PLANE);
    assert_int_equal(d->plane_axis, 1);
    SAME(d->global_damping, 0.3);
    SAME(d->rayleigh_fraction, 0.3);
    SAME(d->contact_resolution, 25);
    SAME(d->impact_speed, 2);
    assert_int_equal(d->scheme, CLAST_SCHEME_BDF4);
    SAME(d->newton_tolerance, 1e-9);
    assert_int_equal(d->newton_iterations, 20);
    assert_int_equal(d->linear_solver, CLAST_SOLVER_GAUSS_SEIDEL);
    same(d->domain_min, -3, -1, -1);
    same(d->domain_max, 3, 1, 4);
    assert_int_equal(d->outside, CLAST_OUTSIDE_REMOVE);
    assert_int_equal(d->guards, CLAST_GUARD_REPORT);
    SAME(d->max_overlap, 0.06);
    SAME(d->max_displacement, 0.2);
    SAME(d->max_residual, 0.07);
    assert_int_equal(d->threads, 1);
    assert_int_equal(d->spheres_per_thread, 77);
    assert_int_equal(d->isa, CLAST_ISA_BASELINE);
    SAME(d->skin, 0.001);
    assert_int_equal(d->precision, CLAST_PRECISION_MIXED);
    assert_int_equal(d->seed, 77);
    SAME(clast_world_time_step(s->world), 4.5e-6);
    scene_free(s);
}

static void sizes_are_read(void **state) {
    (void)state;
    opened o;
    open_draft(&o, GOOD);
    const shape_item *shape = o.draft.shapes.items;
    SAME(shape[3].size.uniform[1], 1.1);
    assert_int_equal(shape[3].size.classes, 3);
    SAME(shape[4].size.normal[1], 0.1);
    SAME(shape[4].size.between[0], 0.9);
    SAME(shape[5].size.log_normal[1], 1.1);
    assert_non_null(strstr(shape[6].size.table, "grading-mass.csv"));
    assert_int_equal(shape[0].size.classes, 20);
    scene_arena_free(&o.arena);
}

static void shapes_and_walls_are_built(void **state) {
    (void)state;
    scene *s = load(GOOD, NULL, 0);
    clast_shape_def button = clast_world_shape(s->world, 0), rod = clast_world_shape(s->world, 2);
    assert_string_equal(button.name, "button");
    assert_int_equal(button.spheres, 7);
    SAME(button.mass, 0.000332);
    same(button.inertia, 2.3e-9, 6.3e-9, 4e-9);
    assert_int_equal(button.outline_points, 4);
    SAME(button.outline[3], 0.0053);
    assert_int_equal(rod.spheres, 2);
    SAME(rod.centre[0].x, -0.002);
    clast_shape_def row = clast_world_shape(s->world, 7);
    assert_string_equal(row.name, "row");
    assert_int_equal(row.spheres, 4);
    for (int i = 0; i < 4; i++) same(row.centre[i], 0.004 * (2 * i - 3), 0, 0);
    SAME(row.radius[3], 0.004);
    assert_int_equal(clast_world_part_count(s->world), 3);
    clast_part_def gate = clast_world_part(s->world, 1);
    same(gate.velocity, 0, 0, -0.02);
    SAME(gate.move_from, 0.1);
    SAME(gate.move_until, 0.2);
    SAME(gate.removed_at, 1);
    assert_int_equal(clast_world_wall_count(s->world), 3);
    clast_wall_def flap = clast_world_wall(s->world, 1);
    assert_int_equal(clast_world_wall_part(s->world, 1), 1);
    assert_int_equal(clast_world_wall_part(s->world, 2), 2);
    assert_int_equal(flap.kind, CLAST_WALL_PLATE);
    same(flap.point, 0.05, 0, 0.3);
    SAME(flap.half_side[0], (0.15 - 0.1) / 4);
    SAME(flap.half_side[1], 0.5);
    same(flap.belt_velocity, 0.25, 0, 0);
    assert_int_equal(clast_world_wall(s->world, 0).kind, CLAST_WALL_PLANE);
    scene_free(s);
}

/* Columns are in storage order: look a body up by its id. */
static size_t slot_of(const clast_bodies *b, uint32_t id) {
    for (size_t i = 0; i < b->count; i++)
        if (b->id[i] == id) return i;
    fail_msg("no body %u", id);
    return 0;
}

static void bodies_are_placed(void **state) {
    (void)state;
    scene *s = load(GOOD, NULL, 0);
    clast_bodies b = clast_world_bodies(s->world);
    size_t ball = slot_of(&b, 0), rod = slot_of(&b, 1), last = slot_of(&b, (uint32_t)b.count - 1);
    SAME(b.z[ball], 1.5);
    assert_true(fabs(b.qw[ball] - cos(15 * 0.017453292519943295)) < 1e-15);
    assert_true(fabs(b.vx[ball] - 1) < 1e-4 &&
                fabs(b.wy[ball] - 120 * 6.283185307179586 / 60) < 1e-4);
    assert_true(fabs(b.qw[rod] - 0.6) < 1e-15 && fabs(b.qy[rod] - 0.8) < 1e-15);
    assert_int_equal(b.shape[last], 2);
    SAME(b.x[last], 0.6);
    size_t thrown = slot_of(&b, (uint32_t)b.count - 2);
    SAME(b.x[thrown], 0.5);
    assert_true(fabs(b.vz[thrown] + 0.25) < 1e-4);
    scene_free(s);
}

static void measures_are_read(void **state) {
    (void)state;
    scene *s = load(GOOD, NULL, 0);
    const measure *m = s->measures;
    assert_int_equal(s->measure_count, 7);
    assert_string_equal(m[0].name, "out");
    assert_int_equal(m[0].kind, MEASURE_DISCHARGED);
    SAME(m[0].level, 0.01);
    assert_int_equal(m[1].kind, MEASURE_REMAINING);
    SAME(m[1].level, 0.02);
    assert_int_equal(m[2].kind, MEASURE_SOLID_FRACTION);
    SAME(m[2].level, 0.03);
    SAME(m[2].x_min, -0.075);
    SAME(m[2].x_max, 0.075);
    assert_int_equal(m[2].sections, 12);
    SAME(m[2].body_area, 1.149e-4);
    assert_int_equal(m[3].kind, MEASURE_BAND_VELOCITY);
    SAME(m[3].level, 0.04);
    SAME(m[3].height, 0.09);
    SAME(m[3].thickness, 0.012);
    SAME(m[3].x_max, 0.07);
    assert_int_equal(m[4].kind, MEASURE_COORDINATION);
    assert_int_equal(m[5].kind, MEASURE_PART_LOAD);
    assert_int_equal(m[5].part, 1);
    assert_int_equal(m[6].kind, MEASURE_LOAD_PROFILE);
    assert_int_equal(m[6].part, 1);
    SAME(m[6].level, 0.05);
    SAME(m[6].height, 0.3);
    assert_int_equal(m[6].sections, 6);
    scene_free(s);
}

static void output_and_view_are_read(void **state) {
    (void)state;
    scene *s = load(GOOD, NULL, 0);
    assert_string_equal(s->title, "two grains and a box of buttons");
    SAME(s->ending.latest, 3);
    SAME(s->ending.rest_speed, 0.001);
    SAME(s->ending.rest_for, 0.1);
    SAME(s->output.frame_every, 1 / 50.0);
    SAME(s->output.series_every, 0.002);
    SAME(s->output.checkpoint_every, 0.5);
    assert_true(s->output.contacts);
    const view *v = &s->view;
    assert_string_equal(v->preset, "draft");
    assert_string_equal(v->map, "cividis");
    assert_true(v->width == 640 && v->height == 480);
    assert_int_equal(v->colour, COLOUR_SPEED_BANDS);
    SAME(v->speed_max, 1.5);
    same(v->look_from, 0.1, -1, 0.2);
    same(v->up, 0, 0.1, 1);
    same(v->box_min, -0.08, -0.01, 0);
    same(v->box_max, 0.08, 0.01, 1.6);
    assert_true(v->perspective && !v->walls && !v->planes);
    SAME(v->frames_per_second, 30);
    scene_free(s);
}

static void what_is_left_out_has_its_default(void **state) {
    (void)state;
    scene *s = load(SMALL, NULL, 0);
    const clast_world_def *d = clast_world_definition(s->world);
    clast_world_def engine = clast_world_def_default();
    same(d->gravity, 0, 0, -9.81);
    assert_int_equal(d->law, engine.law);
    SAME(d->rayleigh_fraction, engine.rayleigh_fraction);
    SAME(d->contact_resolution, engine.contact_resolution);
    same(d->domain_min, engine.domain_min.x, engine.domain_min.y, engine.domain_min.z);
    same(d->domain_max, engine.domain_max.x, engine.domain_max.y, engine.domain_max.z);
    SAME(d->max_overlap, engine.max_overlap);
    SAME(d->max_displacement, engine.max_displacement);
    SAME(d->max_residual, engine.max_residual);
    assert_int_equal(d->precision, CLAST_PRECISION_DOUBLE);
    assert_int_equal(d->seed, 1);
    SAME(s->output.frame_every, 0.04);
    SAME(s->output.series_every, 0.01);
    SAME(s->output.checkpoint_every, 0);
    SAME(s->ending.rest_for, 0);
    assert_true(s->view.width == 1280 && s->view.height == 720 && s->view.walls && s->view.planes);
    assert_false(s->view.perspective);
    assert_string_equal(s->view.preset, "final");
    assert_int_equal(s->measure_count, 0);
    scene_free(s);
}

static void set_replaces_parameters(void **state) {
    (void)state;
    static const char *const SET[] = {"orifice=5cm", "friction=0.5", "kind=\"bag's\": #1"};
    scene *s = load(GOOD, SET, 3);
    SAME(clast_world_wall(s->world, 1).half_side[0], (0.15 - 0.05) / 4);
    assert_string_equal(s->title, "two grains and a \"bag's\": #1 of buttons");
    assert_non_null(strstr(s->text, "\n  orifice: 5cm\n"));
    /* The text that goes into a result must make the same scene again. */
    char path[] = CLAST_SCENE_SCRATCH "/again.yaml";
    write_all(path, s->text, strlen(s->text));
    char *csv = read_all(CLAST_SCENES "/start.csv", NULL);
    write_all(CLAST_SCENE_SCRATCH "/start.csv", csv, strlen(csv));
    char *grading = read_all(CLAST_SCENES "/grading-mass.csv", NULL);
    write_all(CLAST_SCENE_SCRATCH "/grading-mass.csv", grading, strlen(grading));
    scene *again = load(path, NULL, 0);
    assert_string_equal(s->title, again->title);
    assert_true(clast_world_hash(s->world) == clast_world_hash(again->world));
    scene_free(again);
    scene_free(s);
    free(csv), free(grading);
}

static void set_faults(const char *set, const char *expected) {
    char *faults = NULL;
    scene_options options = {.set = &set, .set_count = 1};
    scene *s = scene_load(GOOD, &options, &faults);
    assert_null(s);
    if (!strstr(faults, expected)) fail_msg("%s: %s", set, faults);
    free(faults);
}

static void set_is_checked(void **state) {
    (void)state;
    set_faults("orifise=5cm", "--set: found 'orifise=5cm': unknown parameter 'orifise', "
                              "did you mean 'orifice'?");
    set_faults("orifice", "--set: found 'orifice', expected name=value");
    set_faults("orifice=", "expected name=value");
    set_faults("orifice=5", "--set orifice: found '5', expected a length with its unit, as in "
                            "'10 cm' of line 5");
    set_faults("orifice=5 s", "--set orifice: found '5 s', expected a length");
    set_faults("orifice=5 cmm", "--set orifice: found '5 cmm': unknown unit 'cmm'");
    set_faults("friction=rough", "parameters.friction: found 'rough'");
}

static void options_win_over_the_scene(void **state) {
    (void)state;
    char *faults = NULL;
    scene_options options = {.threads = 2, .spheres_per_thread = 9, .isa = CLAST_ISA_BASELINE};
    scene *s = scene_load(SMALL, &options, &faults);
    assert_non_null(s);
    assert_int_equal(clast_world_definition(s->world)->threads, 2);
    assert_int_equal(clast_world_definition(s->world)->spheres_per_thread, 9);
    assert_int_equal(clast_world_definition(s->world)->isa, CLAST_ISA_BASELINE);
    scene_free(s);
    free(faults);
}

/* A precision is a choice of the scene; a state of the other one may be the start, not the middle.
 */
static void precisions_do_not_mix(void **state) {
    (void)state;
    static const char PATH[] = CLAST_SCENE_SCRATCH "/mixed.yaml";
    static const char CHECKPOINT[] = CLAST_SCENE_SCRATCH "/checkpoint.h5";
    scene *full = load(SMALL, NULL, 0);
    assert_null(strstr(clast_world_plan(full->world).kernel, "mixed"));
    assert_int_equal(clast_world_run(full->world, 0.01), CLAST_OK);
    assert_int_equal(clast_checkpoint_save(full->world, CHECKPOINT, NULL), CLAST_OK);
    char *small = read_all(SMALL, NULL), text[3000];
    snprintf(text, sizeof text, "%sprecision: mixed\n", small);
    write_all(PATH, text, strlen(text));
    scene *mixed = load(PATH, NULL, 0);
    assert_non_null(strstr(clast_world_plan(mixed->world).kernel, "mixed precision"));
    assert_int_equal(clast_checkpoint_load(mixed->world, CHECKPOINT, NULL), CLAST_ERR_MISMATCH);
    assert_non_null(strstr(clast_world_error(mixed->world), "precision"));
    scene_free(mixed);
    char *bodies = strstr(text, "bodies:");
    snprintf(bodies, sizeof text - (size_t)(bodies - text), "%s",
             "bodies:\n  - {from: " CLAST_SCENE_SCRATCH "}\ntime: {end: 1 s}\nprecision: mixed\n");
    write_all(PATH, text, strlen(text));
    mixed = load(PATH, NULL, 0);
    assert_int_equal(clast_world_run(mixed->world, 0.01), CLAST_OK);
    scene_free(mixed);
    scene_free(full);
    free(small);
}

/* README.md embeds the output of `clast check --keys`: the tables cannot drift from the code. */
static void the_readme_has_the_reference(void **state) {
    (void)state;
    char *readme = read_all(CLAST_SCENE_README, NULL), *reference = schema_reference();
    if (!strstr(readme, reference))
        fail_msg("%s lacks the present output of `clast check --keys`", CLAST_SCENE_README);
    free(reference);
    free(readme);
}

static void settled_text(char *text, size_t room, const char *bodies) {
    char *small = read_all(SMALL, NULL);
    *strstr(small, "bodies:") = '\0';
    snprintf(text, room, "%sbodies:\n%stime: {end: 1 s}\n", small, bodies);
    free(small);
}

/* Bodies of an earlier run keep their ids and motion, and later entries keep clear of them. */
static void bodies_are_inherited(void **state) {
    (void)state;
    static const char FOLDER[] = CLAST_SCENE_SCRATCH, PATH[] = CLAST_SCENE_SCRATCH "/from.yaml";
    char text[3000], bodies[1000];
    scene *first = load(SMALL, NULL, 0);
    assert_int_equal(clast_world_run(first->world, 0.01), CLAST_OK);
    assert_int_equal(
        clast_checkpoint_save(first->world, CLAST_SCENE_SCRATCH "/checkpoint.h5", NULL), CLAST_OK);
    snprintf(bodies, sizeof bodies,
             "  - {from: %s}\n"
             "  - {random: {shape: ball, count: 30, region: {min: [-4 cm, -4 cm, 5 cm], "
             "max: [4 cm, 4 cm, 15 cm]}}}\n",
             FOLDER);
    settled_text(text, sizeof text, bodies);
    write_all(PATH, text, strlen(text));
    scene *second = load(PATH, NULL, 0);
    clast_bodies old = clast_world_bodies(first->world), new = clast_world_bodies(second->world);
    size_t slot = slot_of(&new, 0);
    assert_int_equal(new.count, 31);
    SAME(new.z[slot], old.z[0]);
    assert_true(new.vz[slot] < -0.09);
    for (size_t i = 0; i < new.count; i++) {
        double dx = new.x[i] - new.x[slot], dy = new.y[i] - new.y[slot],
               dz = new.z[i] - new.z[slot];
        assert_true(i == slot || dx * dx + dy * dy + dz * dz >= 0.01 * 0.01);
    }
    scene_free(first);
    scene_free(second);
}

static void another_shape_cannot_be_inherited(void **state) {
    (void)state;
    char text[3000], *faults = NULL;
    settled_text(text, sizeof text, "  - {from: checkpoint.h5}\n");
    memcpy(strstr(text, "radius: 5 mm"), "radius: 6 mm", 12);
    write_all(CLAST_SCENE_SCRATCH "/other.yaml", text, strlen(text));
    assert_null(scene_load(CLAST_SCENE_SCRATCH "/other.yaml", NULL, &faults));
    assert_non_null(strstr(faults, "other.yaml:12: bodies[0].from: "));
    free(faults);
}

/* The first block of the README is a scene that works. */
static void the_example_of_the_readme_is_a_scene(void **state) {
    (void)state;
    char *readme = read_all(CLAST_SCENE_README, NULL), *start = strstr(readme, "```yaml\n");
    assert_non_null(start);
    start += strlen("```yaml\n");
    char *end = strstr(start, "```"), path[] = CLAST_SCENE_SCRATCH "/readme.yaml";
    assert_non_null(end);
    write_all(path, start, (size_t)(end - start));
    scene *s = load(path, NULL, 0);
    assert_int_equal(clast_world_bodies(s->world).count, 200);
    assert_int_equal(s->material_count, 1);
    assert_string_equal(s->materials[0].name, "plastic");
    assert_true(s->pair_count == 1 && s->pairs[0].def.restitution == 0.72);
    scene_free(s);
    free(readme);
}

/* Measured at the scene's own step, so to about the error that 30 steps per contact make. */
static void a_pair_rebounds_as_it_was_asked(void **state) {
    (void)state;
    scene *s = load(SMALL, NULL, 0);
    double e = scene_rebound(s, &s->pairs[0]);
    if (fabs(e - 0.9) > 0.01) fail_msg("measured %g, asked 0.9", e);
    scene_free(s);
}

static void fitted_shapes_can_be_refitted(void **state) {
    (void)state;
    char *faults = NULL;
    scene_options options = {.fit_spheres = 5};
    scene *s = scene_load(GOOD, &options, &faults);
    assert_non_null(s);
    assert_int_equal(clast_world_shape(s->world, 0).spheres, 5);
    assert_int_equal(clast_world_shape(s->world, 2).spheres, 2);
    scene_free(s);
    free(faults);
}

/* The names of the engine's table, in its order. */
static void every_scheme_has_its_name(void **state) {
    (void)state;
    const char *path = CLAST_SCENE_SCRATCH "/scheme.yaml";
    char text[1000];
    char *small = read_all(SMALL, NULL), *time = strstr(small, "time: {");
    assert_non_null(time);
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        int length = snprintf(text, sizeof text, "%.*stime: {scheme: %s, %s", (int)(time - small),
                              small, clast_scheme_info_of((clast_scheme)k)->name, time + 7);
        write_all(path, text, (size_t)length);
        scene *s = load(path, NULL, 0);
        assert_int_equal(clast_world_definition(s->world)->scheme, k);
        scene_free(s);
    }
    unlink(path);
    free(small);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_good_scene_has_every_key),
        cmocka_unit_test(materials_and_pairs_are_read),
        cmocka_unit_test(a_viscoelastic_scene),
        cmocka_unit_test(a_law_of_ones_own),
        cmocka_unit_test(a_pair_rebounds_by_a_law_of_ones_own),
        cmocka_unit_test(laws_that_cannot_be_used_are_faults),
        cmocka_unit_test(a_law_beside_the_scene_is_found),
        cmocka_unit_test(generators_are_read),
        cmocka_unit_test(the_world_is_defined),
        cmocka_unit_test(sizes_are_read),
        cmocka_unit_test(shapes_and_walls_are_built),
        cmocka_unit_test(bodies_are_placed),
        cmocka_unit_test(measures_are_read),
        cmocka_unit_test(output_and_view_are_read),
        cmocka_unit_test(what_is_left_out_has_its_default),
        cmocka_unit_test(set_replaces_parameters),
        cmocka_unit_test(set_is_checked),
        cmocka_unit_test(options_win_over_the_scene),
        cmocka_unit_test(precisions_do_not_mix),
        cmocka_unit_test(the_readme_has_the_reference),
        cmocka_unit_test(bodies_are_inherited),
        cmocka_unit_test(another_shape_cannot_be_inherited),
        cmocka_unit_test(the_example_of_the_readme_is_a_scene),
        cmocka_unit_test(a_pair_rebounds_as_it_was_asked),
        cmocka_unit_test(fitted_shapes_can_be_refitted),
        cmocka_unit_test(every_scheme_has_its_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
