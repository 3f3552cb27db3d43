/* button-hopper: repeats the flow of 200 buttons from a flat-bottomed bin, A00 section 4.3.
 *
 *     button-hopper validate            runs, compares with the published numbers
 *     button-hopper figures             runs, writes data and frames for the figures
 *
 * The size is the option --size, else CLAST_SIZE, else `published`. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "experiments/button-hopper/hopper.h"
#include "experiments/study/output.h"

static const char USAGE[] =
    "usage: button-hopper validate|figures [--size quick|brief|published|full] [--jobs N]\n"
    "Repeats A00 section 4.3: 200 buttons, five orifices. Runs are kept below the build folder and "
    "not\n"
    "repeated. CLAST_SIZE and CLAST_JOBS set the same.\n"
    "example: button-hopper validate --size quick\n";

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void open_study(hopper_study *s, const char *size_name) {
    s->size = hopper_size_named(size_name);
    if (!s->size) {
        fprintf(stderr, "there is no size '%s': expected quick, brief, published or full\n",
                size_name);
        exit(2);
    }
    /* runs are shared between sizes: their names say what they are */
    snprintf(s->root, sizeof s->root, "%s/studies/button-hopper/runs", BUILD_FOLDER);
    snprintf(s->data, sizeof s->data, "%s/studies/button-hopper/%s/data", BUILD_FOLDER,
             s->size->name);
    output_folder(s->root);
    output_folder(s->data);
    s->processes = jobs_processes();
}

static int validate(hopper_study *s, const hopper_summary *m, const hopper_published *p) {
    output_folder(BUILD_FOLDER "/validate");
    return hopper_verdicts(s, m, p, BUILD_FOLDER "/validate/button-hopper.csv");
}

static int figures(hopper_study *s, const hopper_summary *m, const hopper_published *p) {
    hopper_sensitivity v;
    int failed = hopper_sensitivity_run(s, &v);
    int bad = hopper_write_tables(s, m, p, &v);
    return bad ? bad : failed ? 1 : hopper_pictures(s);
}

int main(int argc, char **argv) {
    const char *size = getenv("CLAST_SIZE"), *what = argc > 1 ? argv[1] : "";
    if (!size || !*size) size = "published";
    for (int i = 2; i < argc; i++) {
        if (!strcmp(argv[i], "--size") && i + 1 < argc)
            size = argv[++i];
        else if (!strcmp(argv[i], "--jobs") && i + 1 < argc)
            setenv("CLAST_JOBS", argv[++i], 1);
        else
            what = "";
    }
    bool wants_figures = !strcmp(what, "figures");
    if (!wants_figures && strcmp(what, "validate")) {
        fputs(USAGE, strcmp(what, "--help") ? stderr : stdout);
        return strcmp(what, "--help") ? 2 : 0;
    }
    hopper_study s = {0};
    double since = seconds();
    open_study(&s, size);
    hopper_plan(&s);
    int failed = hopper_run_all(&s);
    for (int i = 0; i < s.flow_count; i++)
        if (s.runs[i].ran) hopper_measure(&s.runs[i]);
    hopper_published p = hopper_read_published();
    hopper_summary m = hopper_summarise(&s, &p);
    s.seconds = seconds() - since;
    if (failed) fprintf(stderr, "button-hopper: %d runs failed\n", failed);
    int verdict = wants_figures ? figures(&s, &m, &p) : validate(&s, &m, &p);
    return verdict ? verdict : failed ? 1 : 0;
}
