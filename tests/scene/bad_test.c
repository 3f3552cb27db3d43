/* bad_test.c - every scene under bad/ has exactly the faults that its comments expect.
 *
 * "# expect: TEXT" behind a line stands for a fault in that line; "# expect in FILE:LINE: TEXT"
 * names the line itself. "..." at the end leaves the rest open (numbers that the engine works out).
 */
#include "tests/scene/testing.h"

#include "experiments/scene/scene.h"

#include <dirent.h>

static const char FOLDER[] = CLAST_SCENES "/bad/";

typedef struct lines {
    char *line[200];
    int count;
} lines;

static void lines_add(lines *l, const char *format, const char *a, int line, const char *b) {
    assert_true(l->count < 200);
    l->line[l->count] = malloc(2000);
    snprintf(l->line[l->count++], 2000, format, a, line, b);
}

static void lines_free(lines *l) {
    for (int i = 0; i < l->count; i++) free(l->line[i]);
}

/* Cuts `text` at its line ends and calls for each; the folder is taken out of every line. */
static void each_line(char *text, lines *out, const char *name,
                      void (*use)(lines *out, const char *name, int number, char *line)) {
    int number = 0;
    for (char *line = text; line && *line;) {
        char *end = strchr(line, '\n');
        if (end) *end = '\0';
        use(out, name, ++number, line);
        line = end ? end + 1 : NULL;
    }
}

static void take_expected(lines *out, const char *name, int number, char *line) {
    char *in = strstr(line, "# expect in "), *here = strstr(line, "# expect: ");
    if (in)
        lines_add(out, "%s%.0d%s", in + strlen("# expect in "), 0, "");
    else if (here)
        lines_add(out, "%s:%d: %s", name, number, here + strlen("# expect: "));
}

static void take_found(lines *out, const char *name, int number, char *line) {
    (void)name, (void)number;
    for (char *at = strstr(line, FOLDER); at; at = strstr(line, FOLDER))
        memmove(at, at + strlen(FOLDER), strlen(at + strlen(FOLDER)) + 1);
    lines_add(out, "%s%.0d%s", line, 0, "");
}

static bool matches(const char *found, const char *expected) {
    size_t length = strlen(expected);
    if (length > 3 && !strcmp(expected + length - 3, "..."))
        return !strncmp(found, expected, length - 3);
    return !strcmp(found, expected);
}

static int unmatched(const lines *these, const lines *those, bool these_are_found,
                     const char *complaint) {
    int count = 0;
    for (int i = 0; i < these->count; i++) {
        bool known = false;
        for (int j = 0; j < those->count; j++)
            known = known || (these_are_found ? matches(these->line[i], those->line[j])
                                              : matches(those->line[j], these->line[i]));
        if (!known) print_message("%s: %s\n", complaint, these->line[i]);
        count += !known;
    }
    return count;
}

static int check_file(const char *name) {
    char path[1000];
    snprintf(path, sizeof path, "%s%s", FOLDER, name);
    char *source = read_all(path, NULL), *text = NULL;
    lines expected = {0}, found = {0};
    each_line(source, &expected, name, take_expected);
    assert_true(expected.count > 0);
    scene *s = scene_load(path, NULL, &text);
    bool warnings_alone = true;
    for (int i = 0; i < expected.count; i++)
        warnings_alone = warnings_alone && strstr(expected.line[i], ": warning: ");
    assert_int_equal(s != NULL, warnings_alone);
    scene_free(s);
    if (text) each_line(text, &found, name, take_found);
    int wrong = unmatched(&found, &expected, true, "not expected") +
                unmatched(&expected, &found, false, "did not come") +
                (found.count != expected.count);
    lines_free(&expected);
    lines_free(&found);
    free(source);
    free(text);
    return wrong;
}

static void every_bad_scene_has_its_faults(void **state) {
    (void)state;
    DIR *folder = opendir(FOLDER);
    assert_non_null(folder);
    int files = 0, wrong = 0;
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        const char *dot = strrchr(entry->d_name, '.');
        if (!dot || strcmp(dot, ".yaml")) continue;
        wrong += check_file(entry->d_name);
        files++;
    }
    closedir(folder);
    print_message("%d bad scenes\n", files);
    assert_true(files >= 50);
    assert_int_equal(wrong, 0);
}

static void a_missing_scene_is_a_fault(void **state) {
    (void)state;
    char *faults = NULL;
    assert_null(scene_load("no/such/scene.yaml", NULL, &faults));
    assert_string_equal(faults,
                        "no/such/scene.yaml: cannot be opened: No such file or directory\n");
    free(faults);
    assert_null(scene_load(CLAST_SCENES, NULL, &faults));
    assert_non_null(strstr(faults, "cannot be read"));
    free(faults);
}

static void faults_come_sorted_by_line(void **state) {
    (void)state;
    char *faults = NULL;
    assert_null(scene_load(CLAST_SCENES "/bad/choices.yaml", NULL, &faults));
    int last = 0, count = 0;
    for (char *at = strstr(faults, ".yaml:"); at; at = strstr(at + 1, ".yaml:"), count++) {
        int line = atoi(at + 6);
        assert_true(line >= last);
        last = line;
    }
    assert_true(count >= 4);
    free(faults);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_bad_scene_has_its_faults),
        cmocka_unit_test(a_missing_scene_is_a_fault),
        cmocka_unit_test(faults_come_sorted_by_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
