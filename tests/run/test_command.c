/* The command as a user meets it: what it prints, what it writes, and its exit codes. argv[1] is
 * the program; argv[2] the folder of this file. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "experiments/clast/commands.h"
#include "experiments/run/folder.h"
#include "experiments/run/results.h"
#include "tests/run/fixture.h"

static const char *program, *sources;
static char *folder, *scene_path, *output_path, *error_path;

static pid_t start(const char *arguments) {
    char *command = text_format("exec %s %s >%s 2>%s", program, arguments, output_path, error_path);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
    free(command);
    return child;
}

static int finish(pid_t child) {
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

static int clast(const char *arguments) {
    return finish(start(arguments));
}

static bool said(const char *path, const char *what) {
    size_t length;
    char *text = slurp(path, &length);
    bool found = text && strstr(text, what);
    free(text);
    return found;
}

/* The hash on the last line of what was printed. */
static uint64_t printed_hash(void) {
    size_t length;
    char *text = slurp(output_path, &length);
    assert_non_null(text);
    assert_true(length > 8 && text[length - 1] == '\n');
    text[length - 1] = '\0';
    const char *line = strrchr(text, '\n');
    line = line ? line + 1 : text;
    assert_int_equal(strncmp(line, "hash: 0x", 8), 0);
    assert_int_equal(strlen(line), 24);
    uint64_t hash = strtoull(line + 6, NULL, 16);
    free(text);
    return hash;
}

static uint64_t run_to(const char *out, const char *options) {
    char *arguments = text_format("run %s --out %s/%s %s", scene_path, folder, out, options);
    int code = clast(arguments);
    if (code != 0) {
        size_t length;
        char *text = slurp(error_path, &length);
        fail_msg("clast %s: exit code %d: %s", arguments, code, text);
    }
    free(arguments);
    return printed_hash();
}

static void help_and_mistakes(void **state) {
    (void)state;
    assert_int_equal(clast("--help"), CLAST_EXIT_OK);
    assert_true(said(output_path, "exit codes"));
    assert_int_equal(clast("--version"), CLAST_EXIT_OK);
    assert_true(said(output_path, "clast 0."));
    static const char *const COMMANDS[] = {"run", "check", "plan", "render"};
    for (int i = 0; i < 4; i++) {
        char *arguments = text_format("%s --help", COMMANDS[i]);
        assert_int_equal(clast(arguments), CLAST_EXIT_OK);
        assert_true(said(output_path, "example: clast "));
        free(arguments);
    }
    assert_int_equal(clast("rnu"), CLAST_EXIT_USAGE);
    assert_true(said(error_path, "did you mean 'run'?"));
    assert_int_equal(clast("run"), CLAST_EXIT_USAGE);
    assert_int_equal(clast("run a.yaml"), CLAST_EXIT_USAGE);
    assert_true(said(error_path, "--out"));
    assert_int_equal(clast("run a.yaml --out x --thread 2"), CLAST_EXIT_USAGE);
    assert_true(said(error_path, "--thread"));
    assert_int_equal(clast("run a.yaml --out x --threads 0"), CLAST_EXIT_USAGE);
    assert_int_equal(clast("run a.yaml --out x --spheres-per-thread 0"), CLAST_EXIT_USAGE);
    assert_true(said(error_path, "--spheres-per-thread"));
    assert_int_equal(clast("run a.yaml --out x --isa sse9"), CLAST_EXIT_USAGE);
    assert_true(said(error_path, "avx512"));
}

static void bad_scenes_and_folders(void **state) {
    (void)state;
    assert_int_equal(clast("run no-such-scene.yaml --out x"), CLAST_EXIT_FILE);
    assert_true(said(error_path, "No such file"));
    char *bad = path_in(folder, "bad.yaml");
    assert_int_equal(file_write_text(bad, "scene: x\ngravty: [0, 0, 1]\n"), 0);
    char *arguments = text_format("run %s --out %s/x", bad, folder);
    assert_int_equal(clast(arguments), CLAST_EXIT_BAD_SCENE);
    assert_true(said(error_path, "gravty"));
    free(arguments);
    arguments = text_format("run %s --out %s/run", scene_path, bad);
    assert_int_equal(clast(arguments), CLAST_EXIT_FILE);
    assert_true(said(error_path, "Not a directory"));
    free(arguments), free(bad);
}

static void threads_lanes_and_stops_leave_the_hash(void **state) {
    (void)state;
    uint64_t hash = run_to("plain", "");
    assert_true(said(output_path, "steps/s") && said(output_path, ", 1 thread\n"));
    assert_true(run_to("two", "--threads 2 --spheres-per-thread 30 --isa baseline") == hash);
    assert_true(said(output_path, ", 2 threads\n"));
    assert_true(run_to("quiet", "--quiet") == hash);
    assert_false(said(output_path, "steps/s"));
    assert_true(run_to("avx2", "--threads 3 --spheres-per-thread=1 --isa=avx2") == hash);
    assert_true(said(output_path, ", 3 threads\n"));
    assert_true(run_to("half", "--until 0.0777") != hash);
    assert_true(run_to("half", "--resume --threads 4 --spheres-per-thread 1") == hash);
    assert_true(said(output_path, ", 4 threads\n"));
    char *a = text_format("%s/plain/series.csv", folder),
         *b = text_format("%s/half/series.csv", folder);
    size_t n, m;
    char *left = slurp(a, &n), *right = slurp(b, &m);
    assert_int_equal(n, m);
    assert_memory_equal(left, right, n);
    free(a), free(b), free(left), free(right);
    char *again = text_format("run %s --out %s/plain", scene_path, folder);
    assert_int_equal(clast(again), CLAST_EXIT_FILE);
    assert_true(said(error_path, "--force"));
    assert_true(run_to("plain", "--force") == hash);
    free(again);
    again = text_format("run %s --out %s/plain --resume --set friction=0.2", scene_path, folder);
    assert_int_equal(clast(again), CLAST_EXIT_MISMATCH);
    assert_true(said(error_path, "friction"));
    free(again);
}

static void an_interrupt_saves_everything(void **state) {
    (void)state;
    char *arguments = text_format("run %s --out %s/cut --set 'end=1 s'", scene_path, folder);
    char *checkpoint = text_format("%s/cut/" FILE_CHECKPOINT, folder);
    pid_t child = start(arguments);
    struct timespec moment = {0, 20000000};
    while (!path_exists(checkpoint) && waitpid(child, NULL, WNOHANG) == 0) nanosleep(&moment, NULL);
    kill(child, SIGINT);
    int code = finish(child); /* a very fast machine may have come to the end */
    assert_true(code == CLAST_EXIT_INTERRUPTED || code == CLAST_EXIT_OK);
    assert_true(code == CLAST_EXIT_OK || said(error_path, "--resume"));
    printed_hash();
    char why[RESULTS_ERROR_MAX], *out = path_in(folder, "cut");
    results *r = results_open(out, why);
    assert_non_null(r);
    assert_true(results_frames(r) >= 1);
    results_free(r);
    assert_true(run_to("cut", "--resume --set 'end=1 s'") == run_to("uncut", "--set 'end=1 s'"));
    free(arguments), free(checkpoint), free(out);
}

/* Without a way to draw, the command says so; with one, there is a picture for each frame asked
 * for. */
static void frames_become_pictures(void **state) {
    (void)state;
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1); /* Mesa keeps memory until the program ends */
    char *arguments = text_format("render %s/plain --out %s/pictures --frames 1:3:2 --size 200x160 "
                                  "--preset draft --colour body",
                                  folder, folder);
    int code = clast(arguments);
    if (code != CLAST_EXIT_OK) {
        assert_int_equal(code, CLAST_EXIT_FILE);
        assert_true(said(error_path, "clast render: "));
        skip();
    }
    char *first = text_format("%s/pictures/frame-000000.png", folder);
    char *second = text_format("%s/pictures/frame-000001.png", folder);
    char *third = text_format("%s/pictures/frame-000002.png", folder);
    assert_true(path_exists(first) && path_exists(second) && !path_exists(third));
    free(arguments), free(first), free(second), free(third);
    arguments = text_format("render %s/plain --out %s/pictures --frames 3:1", folder, folder);
    assert_int_equal(clast(arguments), CLAST_EXIT_USAGE);
    free(arguments);
    arguments = text_format("render %s/none --out %s/pictures", folder, folder);
    assert_int_equal(clast(arguments), CLAST_EXIT_FILE);
    free(arguments);
}

static int begin(void **state) {
    (void)state;
    folder = test_folder("command");
    scene_path = path_in(sources, "box.yaml");
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
        cmocka_unit_test(help_and_mistakes),
        cmocka_unit_test(bad_scenes_and_folders),
        cmocka_unit_test(threads_lanes_and_stops_leave_the_hash),
        cmocka_unit_test(an_interrupt_saves_everything),
        cmocka_unit_test(frames_become_pictures),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
