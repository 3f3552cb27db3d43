/* flow_test.c - parts that move, feeds and outlets: every key of flow.yaml is found again in the
 * world, and what is wrong is told. */
#include "tests/scene/testing.h"

#include "experiments/scene/scene.h"

static const char FLOW[] = CLAST_SCENES "/flow.yaml";
#define CHANGED CLAST_SCENE_SCRATCH "/changed-flow.yaml"
#define TABLE   CLAST_SCENE_SCRATCH "/motion.csv"
#define TURN    6.283185307179586

static scene *load(void) {
    char *faults = NULL;
    scene *s = scene_load(FLOW, &(scene_options){0}, &faults);
    if (!s || faults) fail_msg("%s", faults ? faults : "no scene, no faults");
    return s;
}

static void near(double got, double want) {
    if (!(fabs(got - want) <= 1e-14 * (1 + fabs(want))))
        fail_msg("got %.17g, expected %.17g", got, want);
}

static void near_vec(clast_vec3 got, double x, double y, double z) {
    near(got.x, x), near(got.y, y), near(got.z, z);
}

static void motions_are_read(void **state) {
    (void)state;
    scene *s = load();
    clast_part_def bar = clast_world_part(s->world, 0), sieve = clast_world_part(s->world, 1);
    clast_part_def arm = clast_world_part(s->world, 2);
    near_vec(bar.stroke.travel, 0.03, 0, 0);
    near(bar.stroke.speed, 0.0035), near(bar.stroke.pause, 2), near(bar.stroke.phase, 0.25);
    near_vec(sieve.oscillation.amplitude, 0, 0, 0.002);
    near(sieve.oscillation.frequency, 12), near(sieve.oscillation.phase, 0.5);
    near_vec(sieve.rotation.point, 0, 0, 1), near_vec(sieve.rotation.axis, 0, 2, 0);
    near(sieve.rotation.speed, TURN / 2), near(sieve.rotation.swing, TURN / 72);
    near(sieve.rotation.frequency, 2), near(sieve.rotation.phase, 0.1);
    assert_int_equal(arm.table.rows, 3);
    near(arm.table.time[1], 0.5), near(arm.table.angle[1], 0.2), near(arm.move_from, 1);
    near_vec(arm.table.offset[2], 0.01, 0.02, 0);
    scene_free(s);
}

static void feeds_and_outlets_are_read(void **state) {
    (void)state;
    scene *s = load();
    assert_int_equal(clast_world_feed_count(s->world), 2);
    clast_feed_def f = clast_world_feed(s->world, 0), drops = clast_world_feed(s->world, 1);
    assert_string_equal(f.name, "hopper");
    near(f.mass_rate, 20.0 / 3600), near(f.number_rate, 0);
    near_vec(f.region_min, -0.1, -0.2, 0.3), near_vec(f.region_max, 0.1, 0.2, 0.4);
    near_vec(f.velocity, 0, 0, -0.2), near_vec(f.spin, 1, 0, 0);
    near(f.from, 0.5), near(f.until, 40);
    assert_true(!f.turned && f.attempts == 12 && f.full == CLAST_FULL_STOP);
    near(f.orientation.w, sqrt(0.5)), near(f.orientation.y, sqrt(0.5));
    assert_true(drops.turned && drops.attempts == 100 && drops.full == CLAST_FULL_WAIT);
    near(drops.number_rate, 2), near(drops.mass_rate, 0), near(drops.until, 0);
    clast_outlet_def end = clast_world_outlet(s->world, 0), bin = clast_world_outlet(s->world, 1);
    assert_true(end.kind == CLAST_OUTLET_PLANE && bin.kind == CLAST_OUTLET_BOX);
    near_vec(end.normal, 0, 0, -1), near_vec(end.point, 0, 0, -0.5);
    near_vec(bin.min, 4, -1, -1), near_vec(bin.max, 5, 1, 1);
    const bool *periodic = clast_world_definition(s->world)->periodic;
    assert_true(!periodic[0] && periodic[1] && !periodic[2]);
    scene_free(s);
}

/* Classes of size share a number evenly; shares of mass become shares of number. */
static void shares_are_of_mass(void **state) {
    (void)state;
    scene *s = load();
    clast_feed_def f = clast_world_feed(s->world, 0);
    assert_int_equal(f.shapes, 5);
    double peas = 0, rods = 0;
    for (int i = 0; i < f.shapes; i++) {
        clast_shape_def d = clast_world_shape(s->world, f.shape[i]);
        double *of = d.spheres == 1 ? &peas : &rods;
        *of += f.share[i] * d.mass;
    }
    near(peas / (peas + rods), 0.7);
    scene_free(s);
}

static void a_scene_may_begin_empty(void **state) {
    (void)state;
    scene *s = load();
    assert_int_equal(clast_world_counters(s->world).bodies, 0);
    if (clast_world_run(s->world, 0.51)) fail_msg("%s", clast_world_error(s->world));
    clast_flow drops = clast_world_feed_flow(s->world, 1);
    assert_int_equal(drops.bodies, 2);
    assert_int_equal(clast_world_feed_flow(s->world, 0).bodies, 1);
    scene_free(s);
}

/* ---- faults ---------------------------------------------------------------------------------- */

static void expect_fault(const char *path, const char *want) {
    char *faults = NULL;
    scene *s = scene_load(path, &(scene_options){0}, &faults);
    if (s || !faults || !strstr(faults, want))
        fail_msg("expected '%s', got '%s'", want, faults ? faults : "no fault");
    free(faults);
}

/* flow.yaml with one piece of text in the place of another. */
static void expect(const char *old, const char *new, const char *want) {
    char *text = read_all(FLOW, NULL), *at = strstr(text, old);
    if (!at) fail_msg("flow.yaml has no '%s'", old);
    char *changed = malloc(strlen(text) + strlen(new) + 1);
    assert_non_null(changed);
    sprintf(changed, "%.*s%s%s", (int)(at - text), text, new, at + strlen(old));
    write_all(CHANGED, changed, strlen(changed));
    expect_fault(CHANGED, want);
    free(text), free(changed);
}

static void put_table(const char *text) {
    write_all(TABLE, text, strlen(text));
}

static void faults_of_motion_are_told(void **state) {
    (void)state;
    put_table("time,x,y,z,angle\n0,0,0,0,0\n");
    expect(", frequency: 2 /s", "", "parts.sieve.rotation.frequency: missing");
    expect("swing: 5 deg, ", "", "parts.sieve.rotation.swing: missing");
    expect("travel: [30 mm, 0, 0]", "travel: [0, 0, 0]", "stroke.travel: found [0, 0, 0]");
    expect("phase: 0.25", "phase: 1", "parts.bar.stroke.phase: found '1'");
    expect(", rotation: {axis: [0, 0, 1]}", "", "parts.arm.rotation: missing, expected the axis");
}

static void faults_of_tables_have_a_line(void **state) {
    (void)state;
    put_table("time,x,y\n");
    expect("", "", "motion.csv:1: found 'time,x,y', expected the heading");
    put_table("time,x,y,z\n0,0,0,0\n1,0,zero,0\n");
    expect("", "", "motion.csv:3: found '1,0,zero,0', expected 4 numbers");
    put_table("time,x,y,z\n\n0,0,0,0\n0,1,0,0\n");
    expect("", "", "motion.csv:4: found the time 0 behind 0");
    put_table("time,x,y,z\n");
    expect("", "", "motion.csv:1: found no row");
}

static void faults_of_feeds_are_told(void **state) {
    (void)state;
    put_table("time,x,y,z,angle\n0,0,0,0,0\n");
    expect("rate: 20 kg/h", "rate: 20 kg",
           "feeds.hopper.rate: found '20 kg' (mass), expected a mass "
           "per time in kg/s");
    expect("    rate: 20 kg/h\n", "", "feeds.hopper.rate: missing");
    expect("rate: 20 kg/h", "rate: 20 kg/h\n    number_rate: 3 /s", "found beside rate");
    expect("until: 40 s", "until: 0.1 s", "feeds.hopper.until: found 0.1 s");
    expect("mass: 70 %", "mass: 60 %", "add up to 90 %");
    expect("max: [3 m, 0, 0]", "max: [30 m, 0, 0]", "feeds.drops: feed drops has a region that");
    expect("normal: [0, 0, -3]", "normal: [0, 0, 0]", "outlets.end: outlet end has no normal");
    expect("min: [4 m, -1 m, -1 m]", "min: [6 m, -1 m, -1 m]", "outlet bin is an empty box");
    expect("full: stop", "full: never", "feeds.hopper.full: found 'never'");
    expect("time: {end: 1 s}", "time: {end: 1 s, scheme: gear4}", "feeds need the leapfrog");
    expect("time: {end: 1 s}", "time: {end: 1 s}\nmeasures: {m: {discharged: {level: 0 m}}}",
           "measures.m.discharged: found in a scene with feeds");
    expect("time: {end: 1 s}", "time: {end: 1 s}\nmeasures: {out: {coordination: {}}}",
           "measures.out: found the name 'out'");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motions_are_read),          cmocka_unit_test(feeds_and_outlets_are_read),
        cmocka_unit_test(shares_are_of_mass),        cmocka_unit_test(a_scene_may_begin_empty),
        cmocka_unit_test(faults_of_motion_are_told), cmocka_unit_test(faults_of_tables_have_a_line),
        cmocka_unit_test(faults_of_feeds_are_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
