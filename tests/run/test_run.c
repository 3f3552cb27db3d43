/* A run that is stopped, killed, or finds the disk full leaves readable results, and goes on to the
 * very bytes of a run that was never stopped. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "engine/hdf5_io.h"
#include "experiments/run/folder.h"
#include "experiments/run/results.h"
#include "experiments/run/run.h"
#include "tests/run/fixture.h"

static char *base;
static uint64_t whole_hash; /* of the run in base/whole, which nothing disturbed */
static double whole_seconds;

static char *folder_of(const char *name) {
    return path_in(base, name);
}

static run_report run_bed(const char *out, bool resume, const bed_options *o) {
    scene *s = bed_scene(o);
    run_report r = run_scene(s, &(run_options){.out = out, .resume = resume, .talk = RUN_SILENT});
    bed_free(s);
    return r;
}

static void assert_same_file(const char *a, const char *b, const char *name) {
    char *pa = path_in(a, name), *pb = path_in(b, name);
    size_t na = 0, nb = 0;
    char *ta = slurp(pa, &na), *tb = slurp(pb, &nb);
    if (!ta || !tb || na != nb || memcmp(ta, tb, na) != 0) fail_msg("%s and %s differ", pa, pb);
    free(pa), free(pb), free(ta), free(tb);
}

/* Everything that a run leaves, but the parts that hold times of day or of wall clocks: there are
 * none. */
static void assert_same_results(const char *folder) {
    char *whole = folder_of("whole");
    assert_same_file(whole, folder, FILE_SERIES);
    assert_same_file(whole, folder, "band.samples.csv");
    assert_same_file(whole, folder, FILE_FEEDS);
    assert_same_file(whole, folder, FILE_OUTLETS);
    assert_same_file(whole, folder, FILE_XDMF);
    char why[RESULTS_ERROR_MAX];
    results *a = results_open(whole, why), *b = results_open(folder, why);
    assert_non_null(a);
    assert_non_null(b);
    assert_int_equal(results_frames(a), results_frames(b));
    for (size_t i = 0; i < results_frames(a); i++) {
        frame *fa = results_frame(a, i), *fb = results_frame(b, i);
        assert_non_null(fa);
        assert_non_null(fb);
        assert_int_equal(fa->bodies, fb->bodies);
        assert_memory_equal(fa->position, fb->position, 3 * fa->bodies * sizeof(double));
        assert_memory_equal(fa->velocity, fb->velocity, 3 * fa->bodies * sizeof(double));
        frame_free(fa), frame_free(fb);
    }
    results_free(a), results_free(b);
    free(whole);
}

/* ---- an undisturbed run ---------------------------------------------------------------------- */

static void a_run_writes_everything(void **state) {
    (void)state;
    char *out = folder_of("whole");
    run_report r = run_bed(out, false, &(bed_options){0});
    if (r.end != RUN_DONE) fail_msg("%s", r.message);
    whole_hash = r.hash;
    whole_seconds = r.seconds;
    const char *const files[] = {FILE_RUN, FILE_XDMF, FILE_SERIES, FILE_CHECKPOINT, FILE_SCENE};
    for (size_t i = 0; i < 5; i++) {
        char *path = path_in(out, files[i]);
        if (!path_exists(path)) fail_msg("no %s", path);
        free(path);
    }
    uint64_t hash;
    assert_true(run_is_finished(out, &hash));
    assert_true(hash == r.hash);
    char why[RESULTS_ERROR_MAX];
    results *results_read = results_open(out, why);
    if (!results_read) fail_msg("%s", why);
    assert_int_equal(results_frames(results_read), 31);
    assert_int_equal(results_rows(results_read), 151);
    const double *t = results_series(results_read, "time_s");
    const double *kg = results_series(results_read, "below_kg");
    const double *left = results_series(results_read, "left_count");
    assert_non_null(t);
    assert_null(results_series(results_read, "no_such_column"));
    for (size_t i = 0; i < 151; i++) assert_true(fabs(t[i] - 0.002 * (double)i) < 1e-5);
    for (size_t i = 1; i < 151; i++) assert_true(kg[i] >= kg[i - 1]);
    assert_float_equal(left[0], 24, 0);
    assert_true(kg[150] > 0);
    frame *f = results_frame(results_read, results_frame_at(results_read, 0.1));
    assert_non_null(f);
    assert_true(fabs(f->time - 0.1) < 1e-4);
    assert_int_equal(f->bodies, 24);
    assert_int_equal(f->spheres, 40);
    assert_non_null(f->contact_a);
    frame_free(f);
    results_free(results_read);
    free(out);
}

/* Every path that run.xdmf names is in run.h5 and holds as many numbers as it says. */
static void paraview_finds_what_it_is_told(void **state) {
    (void)state;
    char *out = folder_of("whole"), *path = path_in(out, FILE_XDMF);
    char *archive = path_in(out, FILE_RUN), why[RESULTS_ERROR_MAX];
    size_t length;
    char *text = slurp(path, &length);
    assert_non_null(text);
    assert_non_null(strstr(text, "a &quot;small&quot; bed &amp; its &lt;plug&gt;"));
    h5_file *f = h5_open(archive);
    int items = 0;
    for (const char *at = text; (at = strstr(at, "<DataItem Dimensions=\"")); items++) {
        at += strlen("<DataItem Dimensions=\"");
        char *end;
        size_t numbers = (size_t)strtoul(at, &end, 10);
        if (*end == ' ') numbers *= (size_t)strtoul(end, &end, 10);
        const char *name = strstr(at, FILE_RUN ":") + strlen(FILE_RUN ":");
        char inside[128];
        snprintf(inside, sizeof inside, "%.*s", (int)strcspn(name, "<"), name);
        if (h5_count(f, inside) != numbers) fail_msg("%s: %s", inside, h5_error(f));
    }
    assert_int_equal(items, 4 * 31);
    h5_free(f);
    char *command = text_format("xmllint --noout %s 2>/dev/null", path);
    int said = system(command);
    assert_true(said == 0 || WEXITSTATUS(said) == 127); /* 127: no xmllint here */
    results *r = results_open(out, why);
    assert_non_null(r);
    results_free(r);
    free(command), free(text), free(path), free(archive), free(out);
}

/* ---- stopped and killed ---------------------------------------------------------------------- */

static pid_t start_run(const char *out, bool resume, const bed_options *o, rlim_t largest_file) {
    pid_t child = fork();
    assert_true(child >= 0);
    if (child > 0) return child;
    if (largest_file > 0) {
        struct rlimit limit = {largest_file, RLIM_INFINITY};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(99);
    }
    run_report r = run_bed(out, resume, o);
    char *path = path_in(out, "message");
    struct rlimit none = {RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &none);
    file_write_text(path, r.message);
    _exit((int)r.end);
}

static int finish(pid_t child) {
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

static void wait_fraction(double fraction) {
    double seconds = fraction * whole_seconds;
    struct timespec t = {(time_t)seconds, (long)(1e9 * (seconds - floor(seconds)))};
    nanosleep(&t, NULL);
}

static void assert_readable(const char *out) {
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(out, why);
    if (!r) return; /* killed before the first row */
    for (size_t i = 0; i < results_frames(r); i++) {
        frame *f = results_frame(r, i);
        if (!f) fail_msg("%s", results_error(r));
        frame_free(f);
    }
    results_free(r);
}

/* Signals at random moments, again and again in the same folder, then to the end. */
static void disturb(const char *name, int signal_number, uint64_t seed) {
    char *out = folder_of(name);
    print_message("%s: seed %llu\n", name, (unsigned long long)seed);
    for (int i = 0; i < 3; i++) {
        pid_t child = start_run(out, i > 0, &(bed_options){0}, 0);
        wait_fraction(0.4 * clast_random(seed, 1, (uint64_t)i));
        kill(child, signal_number);
        int how = finish(child);
        if (signal_number == SIGKILL)
            assert_true(how == -SIGKILL || how == RUN_DONE);
        else
            assert_true(how == RUN_INTERRUPTED || how == RUN_DONE || how == -signal_number);
        assert_readable(out);
    }
    run_report r = run_bed(out, true, &(bed_options){0});
    if (r.end != RUN_DONE) fail_msg("%s", r.message);
    assert_true(r.hash == whole_hash);
    assert_same_results(out);
    free(out);
}

static void a_killed_run_goes_on(void **state) {
    (void)state;
    uint64_t seed = (uint64_t)time(NULL);
    disturb("killed", SIGKILL, seed);
}

static void an_interrupted_run_goes_on(void **state) {
    (void)state;
    uint64_t seed = (uint64_t)time(NULL) + 1;
    disturb("interrupted", SIGINT, seed);
    disturb("terminated", SIGTERM, seed);
}

/* A run to an earlier time that goes on to the full one: its last rows were not due and must go. */
static void a_finished_run_can_be_prolonged(void **state) {
    (void)state;
    char *out = folder_of("prolonged");
    run_report r = run_bed(out, false, &(bed_options){.latest = 0.1234567});
    if (r.end != RUN_DONE) fail_msg("%s", r.message);
    r = run_bed(out, true, &(bed_options){0});
    if (r.end != RUN_DONE) fail_msg("%s", r.message);
    assert_true(r.hash == whole_hash);
    assert_same_results(out);
    r = run_bed(out, true, &(bed_options){0}); /* nothing left to do */
    assert_int_equal(r.end, RUN_DONE);
    assert_same_results(out);
    free(out);
}

/* ---- what must not be mixed up --------------------------------------------------------------- */

static void a_full_folder_is_refused(void **state) {
    (void)state;
    char *out = folder_of("whole");
    run_report r = run_bed(out, false, &(bed_options){0});
    assert_int_equal(r.end, RUN_REFUSED);
    assert_non_null(strstr(r.message, "--force"));
    free(out);
}

static void two_runs_do_not_share_a_folder(void **state) {
    (void)state;
    char *out = folder_of("held");
    int held = folder_hold(out);
    assert_true(held >= 0);
    run_report r = run_bed(out, false, &(bed_options){.latest = 0.02});
    assert_int_equal(r.end, RUN_REFUSED);
    assert_non_null(strstr(r.message, "another run"));
    assert_true(folder_is_empty(out));
    close(held);
    assert_int_equal(run_bed(out, false, &(bed_options){.latest = 0.02}).end, RUN_DONE);
    held = folder_hold(out); /* the run has let go */
    assert_true(held >= 0);
    close(held);
    free(out);
}

static void another_scene_is_a_mismatch(void **state) {
    (void)state;
    char *out = folder_of("whole");
    run_report r = run_bed(out, true, &(bed_options){.friction = 0.1});
    assert_int_equal(r.end, RUN_MISMATCH);
    assert_non_null(strstr(r.message, "friction"));
    assert_readable(out);
    free(out);
}

static void a_cut_checkpoint_is_unreadable(void **state) {
    (void)state;
    char *out = folder_of("cut");
    run_report r = run_bed(out, false, &(bed_options){.latest = 0.02});
    assert_int_equal(r.end, RUN_DONE);
    char *path = path_in(out, FILE_CHECKPOINT);
    assert_int_equal(truncate(path, 3000), 0);
    r = run_bed(out, true, &(bed_options){.latest = 0.04});
    assert_int_equal(r.end, RUN_UNREADABLE);
    assert_non_null(strstr(r.message, FILE_CHECKPOINT));
    assert_readable(out);
    free(path), free(out);
}

/* ---- disks ----------------------------------------------------------------------------------- */

/* Any file may grow to so many bytes: frames, rows, checkpoint or archive hit the limit. */
static void no_room_is_told_and_survived(void **state) {
    (void)state;
    static const rlim_t LIMITS[] = {100, 3000, 20000, 40000, 70000};
    for (size_t i = 0; i < sizeof LIMITS / sizeof *LIMITS; i++) {
        char *name = text_format("full-%zu", i), *out = folder_of(name);
        int how = finish(start_run(out, false, &(bed_options){0}, LIMITS[i]));
        if (how != RUN_WRITE_FAILED)
            fail_msg("limit %lu ended in %d", (unsigned long)LIMITS[i], how);
        char *path = path_in(out, "message");
        size_t length;
        char *message = slurp(path, &length);
        assert_non_null(message);
        print_message("%s\n", message);
        assert_non_null(strstr(message, "File too large"));
        assert_non_null(strstr(message, out));
        remove(path);
        assert_readable(out);
        run_report r = run_bed(out, true, &(bed_options){0});
        if (r.end != RUN_DONE) fail_msg("%s", r.message);
        assert_true(r.hash == whole_hash);
        assert_same_results(out);
        free(message), free(path), free(out), free(name);
    }
}

/* A real full disk, where mounting is allowed. */
static void a_full_disk_is_told(void **state) {
    (void)state;
    char *out = folder_of("tmpfs"),
         *command = text_format("mount -t tmpfs -o size=128k none %s 2>/dev/null", out);
    assert_int_equal(folder_make(out), 0);
    bool mounted = system(command) == 0;
    free(command);
    if (!mounted) {
        free(out);
        skip();
    }
    char *inside = path_in(out, "run");
    run_report r = run_bed(inside, false, &(bed_options){0});
    assert_readable(inside);
    command = text_format("umount %s", out);
    int said = system(command);
    assert_int_equal(said, 0);
    assert_int_equal(r.end, RUN_WRITE_FAILED);
    assert_non_null(strstr(r.message, "No space left on device"));
    free(command), free(inside), free(out);
}

static void a_folder_that_cannot_be_is_told(void **state) {
    (void)state;
    char *file = folder_of("file"), *out = path_in(file, "run");
    assert_int_equal(file_write_text(file, "in the way"), 0);
    run_report r = run_bed(out, false, &(bed_options){.latest = 0.01});
    assert_int_equal(r.end, RUN_WRITE_FAILED);
    assert_non_null(strstr(r.message, out));
    assert_non_null(strstr(r.message, "Not a directory"));
    r = run_bed(file, false, &(bed_options){.latest = 0.01});
    assert_int_equal(r.end, RUN_WRITE_FAILED);
    free(file), free(out);
}

/* ---- other ends ------------------------------------------------------------------------------ */

static void a_failed_run_keeps_the_good_checkpoint(void **state) {
    (void)state;
    char *out = folder_of("failed");
    run_report r = run_bed(out, false, &(bed_options){.max_overlap = 1e-3});
    assert_int_equal(r.end, RUN_GUARD);
    assert_non_null(strstr(r.message, "body "));
    assert_non_null(strstr(r.message, "step "));
    char *failed = path_in(out, FILE_FAILED), *good = path_in(out, FILE_CHECKPOINT);
    h5_file *f = h5_open(failed), *g = h5_open(good);
    assert_true(h5_u64_attribute(f, "/", "step") > h5_u64_attribute(g, "/", "step"));
    assert_int_equal(h5_status(f), CLAST_OK);
    assert_int_equal(h5_status(g), CLAST_OK);
    h5_free(f), h5_free(g);
    assert_readable(out);
    uint64_t hash;
    assert_false(run_is_finished(out, &hash));
    free(failed), free(good), free(out);
}

static run_report run_to_rest(const char *out, bool resume, double latest) {
    scene *s = bed_scene(&(bed_options){.latest = latest});
    s->ending.rest_speed = 10; /* everything is slower */
    s->ending.rest_for = 0.0123;
    run_report r = run_scene(s, &(run_options){.out = out, .resume = resume, .talk = RUN_SILENT});
    bed_free(s);
    return r;
}

/* The time without motion is counted across a stop. */
static void a_run_ends_at_rest(void **state) {
    (void)state;
    char *out = folder_of("rest"), *stopped = folder_of("rest-stopped");
    run_report r = run_to_rest(out, false, 5);
    assert_int_equal(r.end, RUN_DONE);
    assert_true(r.at_rest);
    assert_true(r.time > 0.0122 && r.time < 0.0123 * 1.06);
    run_report first = run_to_rest(stopped, false, 0.008);
    assert_false(first.at_rest);
    run_report second = run_to_rest(stopped, true, 5);
    assert_true(second.at_rest);
    assert_true(second.time == r.time && second.hash == r.hash);
    assert_same_file(out, stopped, FILE_SERIES);
    free(out), free(stopped);
}

static int begin(void **state) {
    (void)state;
    base = test_folder("run");
    return 0;
}

static int end(void **state) {
    (void)state;
    remove_folder(base);
    free(base);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_writes_everything),
        cmocka_unit_test(paraview_finds_what_it_is_told),
        cmocka_unit_test(a_killed_run_goes_on),
        cmocka_unit_test(an_interrupted_run_goes_on),
        cmocka_unit_test(a_finished_run_can_be_prolonged),
        cmocka_unit_test(a_full_folder_is_refused),
        cmocka_unit_test(two_runs_do_not_share_a_folder),
        cmocka_unit_test(another_scene_is_a_mismatch),
        cmocka_unit_test(a_cut_checkpoint_is_unreadable),
        cmocka_unit_test(no_room_is_told_and_survived),
        cmocka_unit_test(a_full_disk_is_told),
        cmocka_unit_test(a_folder_that_cannot_be_is_told),
        cmocka_unit_test(a_failed_run_keeps_the_good_checkpoint),
        cmocka_unit_test(a_run_ends_at_rest),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
