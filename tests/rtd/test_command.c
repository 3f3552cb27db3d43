/* test_command.c - `clast rtd` on folders written here. argv[1] is the program. */
#include "tests/support/check.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiments/clast/commands.h"
#include "experiments/rtd/rtd.h"
#include "experiments/run/folder.h"

static const char *program;
static char *folder;

static void put(const char *name, const char *text) {
    char *path = path_in(folder, name);
    assert_int_equal(file_write_text(path, text), 0);
    free(path);
}

/* 200 bodies of two sizes, one every second, that stay 50 s; two more of a first bed; one left by
 * the side. */
static void put_run(void) {
    char *feeds = calloc(20000, 1), *outlets = calloc(20000, 1);
    assert_true(feeds && outlets);
    strcpy(feeds, "id,time_s,feed,shape,mass_kg,diameter_m\n");
    strcpy(outlets, "id,time_s,outlet,shape,mass_kg,diameter_m\n"
                    "0,3,end,stone,0.001,0.01\n1,7,end,stone,0.001,0.01\n");
    for (int i = 0; i < 200; i++) {
        const char *what = i % 2 ? "stone,0.001,0.01" : "pebble,0.0005,0.008";
        sprintf(feeds + strlen(feeds), "%d,%d,hopper,%s\n", i + 2, i + 1, what);
        if (i != 60)
            sprintf(outlets + strlen(outlets), "%d,%d,end,%s\n", i + 2, i + 51, what);
        else
            sprintf(outlets + strlen(outlets), "%d,%d,side,%s\n", i + 2, i + 11, what);
    }
    put("feeds.csv", feeds);
    put("outlets.csv", outlets);
    put("series.csv", "time_s,step\n0,0\n400,400000\n");
    free(feeds);
    free(outlets);
}

static int clast(const char *arguments) {
    char *command =
        text_format("%s %s >%s/said 2>%s/complained", program, arguments, folder, folder);
    int status = system(command);
    free(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static bool holds(const char *name, const char *what) {
    char *path = path_in(folder, name), text[20000] = "";
    FILE *f = fopen(path, "r");
    if (f) text[fread(text, 1, sizeof text - 1, f)] = '\0', fclose(f);
    free(path);
    return strstr(text, what) != NULL;
}

static void expect(const char *options, int code, const char *why) {
    char *arguments = text_format("rtd %s", options);
    int got = clast(arguments);
    free(arguments);
    if (got != code) fail_msg("clast rtd %s: exit code %d, want %d", options, got, code);
    if (why && !holds("complained", why)) fail_msg("clast rtd %s: no word of '%s'", options, why);
}

static void expect_of_run(const char *options, int code, const char *why) {
    char *all = text_format("%s %s", folder, options);
    expect(all, code, why);
    free(all);
}

static int start(void **state) {
    (void)state;
    folder = text_format("rtd-command-%d", (int)getpid());
    return folder_make(folder);
}

static int finish(void **state) {
    (void)state;
    char *command = text_format("rm -r %s", folder);
    int status = system(command);
    free(command);
    free(folder);
    return status;
}

static void a_run_is_analysed(void **state) {
    (void)state;
    put_run();
    char *out =
        text_format("--outlet end --from 20s --until 150s --sampling 10s --out %s/out", folder);
    expect_of_run(out, CLAST_EXIT_OK, NULL);
    free(out);
    assert_true(holds("said", "mean residence time"));
    assert_true(holds("said", "seed 1"));
    assert_true(holds("out/rtd.csv", "\"mean residence time\",s,50,"));
    assert_true(holds("out/rtd.csv", "tracers,,130,")); /* of 131, one left by the side */
    assert_true(holds("out/curve.csv", "50,60,0.1,"));
    assert_true(holds("out/tracers.csv", "id,entry_s,residence_s,left,"));
    expect_of_run("--from 20s --outlet side", CLAST_EXIT_RUN_FAILED, "expected at least 20");
}

/* 66 stones and 64 pebbles in 130 s that stay 50 s each, on 100 cm2 at 1000 kg/m3 (S12 4.1). */
static void a_bed_has_a_height(void **state) {
    (void)state;
    put_run();
    char *out = text_format("--outlet end --from 20s --until 150s --resamples 2 --out %s/out "
                            "--footprint 100cm2 --bulk-density 1g/cm3",
                            folder);
    expect_of_run(out, CLAST_EXIT_OK, NULL);
    free(out);
    char *height = text_format("bed height from the residence time,m,%.9g,",
                               (66 * 1e-3 + 64 * 5e-4) / 130 * 50 / 10);
    assert_true(holds("out/rtd.csv", height));
    assert_true(holds("said", "bed height from the hold-up"));
    free(height);
    expect_of_run("--footprint 2cm2", CLAST_EXIT_USAGE, "found --footprint alone, expected");
    expect_of_run("--footprint 2cm --bulk-density 3kg/m3", CLAST_EXIT_USAGE, "expected an area");
    expect_of_run("--from 20s --resamples 2", CLAST_EXIT_OK, NULL);
    assert_false(holds("said", "bed height"));
}

static void the_first_bed_counts_as_hold_up_alone(void **state) {
    (void)state;
    put_run();
    char why[RTD_ERROR_MAX];
    passages *p = passages_read(folder, &(rtd_options){0}, why);
    if (!p) fail_msg("%s", why);
    assert_int_equal(p->count, 200);
    assert_int_equal(p->bed_count, 2);
    CHECK_NEAR(holdup_at(p, 0.5), 2e-3, 1e-15);
    CHECK_NEAR(holdup_at(p, 5), 1e-3 + 3 * 5e-4 + 2 * 1e-3, 1e-15);
    CHECK_NEAR(holdup_at(p, 300), 0, 1e-15);
    passages_free(p);
}

/* 0.15 kg came, 0.152 kg left with the first bed of 0.002 kg. */
static void put_series(const char *last) {
    char *text =
        text_format("time_s,step,fed_kg,out_kg,inside_kg\n0,0,0,0,0.002\n400,1,%s\n", last);
    put("series.csv", text);
    free(text);
}

static void mass_is_balanced(void **state) {
    (void)state;
    put_run();
    char *out = text_format("--from 20s --until 150s --resamples 2 --out %s/out", folder);
    expect_of_run(out, CLAST_EXIT_OK, NULL);
    assert_true(holds("said", "not known: series.csv has no inside_kg"));
    put_series("0.15,0.152,0");
    expect_of_run(out, CLAST_EXIT_OK, NULL);
    assert_false(holds("complained", "mass"));
    assert_true(holds("out/rtd.csv", "mass in less out less inside,kg,"));
    put_series("0.15,0.152,0.0002"); /* less than half a pebble: rounding */
    expect_of_run(out, CLAST_EXIT_OK, NULL);
    put_series("0.15,0.1515,0"); /* the run itself lost a pebble */
    expect_of_run(out, CLAST_EXIT_RUN_FAILED, "mass is lost: found 0.0005 kg");
    assert_true(holds("said", "0.0005 kg"));
    assert_true(holds("out/rtd.csv", "less inside,kg,0.0005"));
    put_series("0.15,0.1515,0.0005"); /* the run has one inside that by the tables left */
    expect_of_run(out, CLAST_EXIT_RUN_FAILED, "mass is lost: found -0.0005 kg");
    free(out);
}

static void add_outlet(const char *row) {
    char *path = path_in(folder, "outlets.csv");
    FILE *f = fopen(path, "a");
    assert_non_null(f);
    fputs(row, f);
    fclose(f);
    free(path);
}

/* Who left the domain has left, but by no outlet: that is told. */
static void strays_are_told(void **state) {
    (void)state;
    put_run();
    assert_false(holds("complained", "left the domain"));
    add_outlet("202,251,domain,stone,0.001,0.01\n");
    char *out = text_format("--from 20s --until 150s --resamples 2 --out %s/out", folder);
    expect_of_run(out, CLAST_EXIT_OK, "warning: 1 bodies left the domain, by no outlet");
    assert_true(holds("out/rtd.csv", "\"left the domain, by no outlet\",,1,"));
    free(out);
    expect_of_run("--outlet end --from 20s --until 150s --resamples 2", CLAST_EXIT_OK, NULL);
    assert_false(holds("complained", "left the domain"));
}

/* Who is still inside may yet leave by the side. */
static void one_outlet_of_several_needs_all_to_have_left(void **state) {
    (void)state;
    put_run();
    put("series.csv", "time_s,step\n0,0\n150,150000\n"); /* fed after 100 s: inside */
    expect_of_run("--outlet end --from 20s --until 120s", CLAST_EXIT_RUN_FAILED,
                  "found 20 still inside and 1 that left by another outlet");
    expect_of_run("--outlet end --from 20s --until 99s --resamples 2", CLAST_EXIT_OK, NULL);
    expect_of_run("--outlet end --from 70s --until 120s --resamples 2", CLAST_EXIT_OK, NULL);
    expect_of_run("--from 20s --until 120s --resamples 2", CLAST_EXIT_OK, NULL);
}

static void usage_is_told(void **state) {
    (void)state;
    put_run();
    expect("--help", CLAST_EXIT_OK, NULL);
    assert_true(holds("said", "example: clast rtd"));
    expect("", CLAST_EXIT_USAGE, "which run?");
    expect_of_run("--sampling 3kg", CLAST_EXIT_USAGE, "--sampling 3kg: expected a time");
    expect_of_run("--sampling -3min", CLAST_EXIT_USAGE, "expected a time above zero");
    expect_of_run("--bins 3", CLAST_EXIT_USAGE, "unknown option --bins");
}

/* The longest stay is 50 s. */
static void the_sampling_has_a_limit(void **state) {
    (void)state;
    put_run();
    char why[RTD_ERROR_MAX] = "";
    passages *p = passages_read(folder, &(rtd_options){0}, why);
    if (!p) fail_msg("%s", why);
    assert_true(rtd_sampling_fits(p, 0, why) && rtd_sampling_fits(p, 51e-5, why));
    assert_false(rtd_sampling_fits(p, 49e-5, why));
    assert_null(rtd_new(p, &(rtd_options){.sampling = 49e-5}, why));
    passages_free(p);
    expect_of_run("--sampling 1ns", CLAST_EXIT_USAGE, "--sampling: found 5e+10 intervals");
    assert_true(holds("complained", "expected at most 100000: a sampling of 0.0005 s"));
}

static void bad_folders_are_told(void **state) {
    (void)state;
    put_run();
    expect("no-such-folder", CLAST_EXIT_FILE, "no-such-folder/series.csv: cannot be opened");
    expect_of_run("--feed chute", CLAST_EXIT_FILE, "no record of feed 'chute'");
    expect_of_run("--outlet door", CLAST_EXIT_FILE, "no record of outlet 'door'");
    put("outlets.csv", "id,time_s,outlet,shape,mass_kg,diameter_m\n2,0.5,end,stone,0.001,0.01\n");
    expect_of_run("", CLAST_EXIT_FILE, "body 2 left at 0.5 s and was fed at 1 s");
    put("outlets.csv", "id,time_s,outlet,shape,mass_kg,diameter_m\n2,soon,end,stone,1,0.01\n");
    expect_of_run("", CLAST_EXIT_FILE, "outlets.csv:2: found no record");
    put("outlets.csv", "id,time_s,shape\n");
    expect_of_run("", CLAST_EXIT_FILE, "outlets.csv:1: found no such columns");
    char *path = path_in(folder, "feeds.csv");
    assert_int_equal(remove(path), 0);
    free(path);
    expect_of_run("", CLAST_EXIT_FILE, "feeds.csv: cannot be opened");
    assert_true(holds("complained", "has the scene feeds?"));
}

int main(int argc, char **argv) {
    if (argc < 2) return 2;
    program = argv[1];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_is_analysed),
        cmocka_unit_test(a_bed_has_a_height),
        cmocka_unit_test(the_first_bed_counts_as_hold_up_alone),
        cmocka_unit_test(mass_is_balanced),
        cmocka_unit_test(strays_are_told),
        cmocka_unit_test(one_outlet_of_several_needs_all_to_have_left),
        cmocka_unit_test(usage_is_told),
        cmocka_unit_test(the_sampling_has_a_limit),
        cmocka_unit_test(bad_folders_are_told)};
    return cmocka_run_group_tests(tests, start, finish);
}
