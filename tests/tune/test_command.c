/* `clast tune` as a user meets it. argv[1] is the program; argv[2] the folder of this file. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "experiments/clast/commands.h"
#include "experiments/run/folder.h"
#include "experiments/run/run.h"
#include "tests/run/fixture.h"

static const char *program, *sources;
static char *folder, *scene_path, *output_path, *error_path;

static int clast(const char *arguments) {
    char *command = text_format("%s %s >%s 2>%s", program, arguments, output_path, error_path);
    int status = system(command);
    free(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* malloc'ed. */
static char *contents(const char *path) {
    size_t length;
    char *text = slurp(path, &length);
    assert_non_null(text);
    return text;
}

static bool said(const char *path, const char *what) {
    char *text = contents(path);
    bool found = strstr(text, what) != NULL;
    free(text);
    return found;
}

static int tune(const char *out, const char *options) {
    char *arguments =
        text_format("tune %s --out %s/%s --jobs 2 %s", scene_path, folder, out, options);
    int code = clast(arguments);
    free(arguments);
    return code;
}

static void expect(const char *out, const char *options, int code, const char *why) {
    int got = tune(out, options);
    char *text = contents(error_path);
    if (got != code || (why && !strstr(text, why)))
        fail_msg("clast tune %s: exit code %d, want %d: %s", options, got, code, text);
    free(text);
}

static void mistakes_are_told(void **state) {
    (void)state;
    assert_int_equal(clast("tune --help"), CLAST_EXIT_OK);
    assert_true(said(output_path, "example:"));
    expect("no", "--tolerance 2%", CLAST_EXIT_USAGE, "--observable");
    expect("no", "--observable out.kg", CLAST_EXIT_USAGE, "--tolerance");
    const char *const wrong[] = {"2", "0%", "-2%", "70%", "much", "nan"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char *options = text_format("--observable out.kg --tolerance %s", wrong[i]);
        expect("no", options, CLAST_EXIT_USAGE, "such as 2%");
        free(options);
    }
    expect("no", "--observable out.mass --tolerance 2%", CLAST_EXIT_USAGE, "\n  out.kg\n");
    expect("no", "--observable out.kg --tolerance 2% --seeds 2", CLAST_EXIT_USAGE, "at least 3");
    expect("no", "--observable out.kg --tolerance 2% --vary young", CLAST_EXIT_USAGE, "NAME=A");
    expect("no", "--observable out.kg --tolerance 2% --set 'step=1 ms'", CLAST_EXIT_BAD_SCENE,
           "critical step");
    char *itself = text_format("--observable out.kg --tolerance 2%% --write %s", scene_path);
    expect("no", itself, CLAST_EXIT_USAGE, "is the scene itself");
    free(itself);
}

static void replicates_must_differ_and_have_the_observable(void **state) {
    (void)state;
    expect("alike", "--observable out.kg:final --tolerance 5% --vary 'end=0.1 s,0.1 s,0.1 s'",
           CLAST_EXIT_RUN_FAILED, "--vary");
    expect("zero", "--observable out.kg:final --tolerance 5% --set 'end=1 ms'",
           CLAST_EXIT_RUN_FAILED, "is zero");
    expect("stops", "--observable out.kg:final --tolerance 5% --set 'young=40 kPa'",
           CLAST_EXIT_RUN_FAILED, "run failed at step");
}

/* The number behind a word of what was printed. */
static double number_behind(const char *word) {
    char *text = contents(output_path);
    const char *at = strstr(text, word);
    double value = at ? strtod(at + strlen(word), NULL) : (double)NAN;
    free(text);
    return value;
}

static uint64_t hash_of_pilot(const char *out, const char *name) {
    char *pattern = text_format("%s/%s/runs/%s-000-*/run.h5", folder, out, name);
    glob_t found;
    assert_int_equal(glob(pattern, 0, NULL, &found), 0);
    assert_int_equal(found.gl_pathc, 1);
    uint64_t hash = 0;
    *strrchr(found.gl_pathv[0], '/') = '\0';
    assert_true(run_is_finished(found.gl_pathv[0], &hash));
    globfree(&found);
    free(pattern);
    return hash;
}

/* "chosen: step x 24, mixed" as its pilots are named: "step24-mixed". */
static void read_chosen(char name[80]) {
    char *text = contents(output_path), *chosen = strstr(text, "chosen: step x ");
    if (!chosen) fail_msg("no larger step was found:\n%s", text);
    chosen += strlen("chosen: step x ");
    chosen[strcspn(chosen, "\n")] = '\0';
    bool mixed = strstr(chosen, ", mixed") != NULL;
    assert_null(strstr(chosen, "stiffness"));
    snprintf(name, 80, "step%g%s", strtod(chosen, NULL), mixed ? "-mixed" : "");
    free(text);
}

static char *table(void) {
    char *text = contents(output_path), *start = strstr(text, "differences are paired");
    assert_non_null(start);
    char *copy = text_format("%s", start);
    free(text);
    return copy;
}

/* The step is far below every limit, so a larger one must be found. The scene that is written must
 * be the one that was tried: bit by bit the run of its first pilot. */
static void a_larger_step_is_found(void **state) {
    (void)state;
    static const char OPTIONS[] = "--observable out.kg:final --tolerance 20% --seeds 3";
    expect("found", OPTIONS, CLAST_EXIT_OK, NULL);
    char name[80], *tuned = text_format("%s/found/tuned.yaml", folder), *first = table();
    read_chosen(name);
    assert_true(number_behind("a factor of ") > 1.5);
    assert_true(said(tuned, "# clast tune: out.kg:final of "));
    assert_true(said(tuned, "# the step is what clast tune should find"));
    assert_true(said(tuned, "step: $step * "));
    char *check = text_format("check %s", tuned);
    assert_int_equal(clast(check), CLAST_EXIT_OK);
    char *run = text_format("run %s --out %s/again --quiet", tuned, folder);
    assert_int_equal(clast(run), CLAST_EXIT_OK);
    char *last = contents(output_path);
    assert_true(strtoull(last + strlen("hash: "), NULL, 16) == hash_of_pilot("found", name));
    expect("found", OPTIONS, CLAST_EXIT_OK, NULL); /* what was run is not run again */
    char *second = table();
    assert_string_equal(first, second); /* even its processor time is the old one */
    free(tuned), free(check), free(run), free(last), free(first), free(second);
}

/* Collisions at other steps end elsewhere; in a hundred-thousandth nothing can be kept. */
static void the_tolerance_is_respected(void **state) {
    (void)state;
    expect("tight",
           "--observable left.kg:mean --tolerance 0.001% --seeds 3 --set 'step=30 us' "
           "--vary 'end=0.2 s,0.21 s,0.22 s,0.23 s'",
           CLAST_EXIT_OK, NULL);
    assert_true(said(output_path, "chosen: the scene as it stands"));
    assert_true(said(output_path, "stopped")); /* the softest of them */
    assert_true(said(output_path, "not confirmed") == false);
    char *tuned = text_format("%s/tight/tuned.yaml", folder);
    assert_true(said(tuned, "# nothing cheaper was shown"));
    assert_true(said(tuned, "step: 30 us "));
    assert_true(said(tuned, "end: 0.3 s")); /* --vary is for the pilots alone */
    free(tuned);
}

/* The scene that was found stands up to all replicates at once; what is asked for too closely does
 * not, and what is no scene is told. After a_larger_step_is_found(). */
static void a_scene_is_verified(void **state) {
    (void)state;
    static const char BASE[] = "--observable out.kg:final --seeds 12 --verify %s/found/%s "
                               "--tolerance %s";
    char *good = text_format(BASE, folder, "tuned.yaml", "20%");
    expect("found", good, CLAST_EXIT_OK, NULL);
    assert_true(said(output_path, "verified: the interval lies within 20 %"));
    assert_true(number_behind("a factor of ") > 1.5);
    char *close = text_format(BASE, folder, "tuned.yaml", "0.001%");
    expect("found", close, CLAST_EXIT_RUN_FAILED, NULL);
    assert_false(said(output_path, "verified:"));
    char *gone = text_format(BASE, folder, "no.yaml", "20%");
    expect("found", gone, CLAST_EXIT_FILE, "no.yaml");
    free(good), free(close), free(gone);
}

static int begin(void **state) {
    (void)state;
    folder = test_folder("tune");
    scene_path = path_in(sources, "bounce.yaml");
    output_path = path_in(folder, "stdout");
    error_path = path_in(folder, "stderr");
    return 0;
}

static int end(void **state) {
    (void)state;
    remove_folder(folder);
    free(folder), free(scene_path), free(output_path), free(error_path);
    return 0;
}

int main(int argc, char **argv) {
    if (argc != 3) return 2;
    program = argv[1];
    sources = argv[2];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mistakes_are_told),
        cmocka_unit_test(replicates_must_differ_and_have_the_observable),
        cmocka_unit_test(a_larger_step_is_found),
        cmocka_unit_test(a_scene_is_verified),
        cmocka_unit_test(the_tolerance_is_respected),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
