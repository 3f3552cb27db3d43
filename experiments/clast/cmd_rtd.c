/* cmd_rtd.c - how long bodies stay between a feed and an outlet. */
#include "experiments/clast/commands.h"
#include "experiments/clast/options.h"
#include "experiments/rtd/rtd.h"
#include "experiments/scene/unit.h"

#include <stdio.h>

static const char HELP[] =
    "usage: clast rtd RUN [--sampling TIME] [--out FOLDER] [--from TIME] [--until TIME]\n"
    "                     [--feed NAME] [--outlet NAME] [--seed N] [--resamples N]\n"
    "                     [--footprint AREA --bulk-density DENSITY]\n"
    "\n"
    "Residence time distribution of a run whose scene has feeds and outlets: E(t), F(t), mean,\n"
    "variance, skewness, Peclet number, tanks in series, each with its 95 % interval; hold-up, "
    "residence\n"
    "time against diameter, and whether there is more than one peak. Of bodies fed after the run "
    "had\n"
    "become steady; those still inside at the end count as such.\n"
    "\n"
    "  --sampling TIME    width of the intervals of E and F (default 3min); at most 100000 of "
    "them\n"
    "  --out FOLDER       writes rtd.csv, curve.csv and tracers.csv there\n"
    "  --from TIME        bodies fed from then on (default: where the hold-up is steady, MSER-5)\n"
    "  --until TIME       and until then (default: the end of the run)\n"
    "  --feed NAME        of this feed alone\n"
    "  --outlet NAME      that left by this outlet alone; of several, all must have left\n"
    "  --seed N           of the resampling behind the intervals (default 1)\n"
    "  --resamples N      how many (default 1000)\n"
    "  --footprint AREA, --bulk-density DENSITY\n"
    "                     length x width of the bed and its mass per volume: its height as well,\n"
    "                     from the residence time and from the hold-up\n"
    "\n"
    "example: clast rtd build/forward --sampling 1min --out build/forward-rtd\n"
    "exit code: 0, 1 too few bodies have left, --outlet while some are inside, or mass is lost, 2 "
    "usage, 4 a file cannot be read or "
    "written\n";

typedef struct arguments {
    const char *run, *sampling, *out, *from, *until, *feed, *outlet, *footprint, *bulk_density;
    int seed, resamples;
} arguments;

static bool read_arguments(int argc, char **argv, arguments *a) {
    const option options[] = {
        {"--sampling", OPTION_TEXT, &a->sampling, NULL},
        {"--out", OPTION_TEXT, &a->out, NULL},
        {"--from", OPTION_TEXT, &a->from, NULL},
        {"--until", OPTION_TEXT, &a->until, NULL},
        {"--feed", OPTION_TEXT, &a->feed, NULL},
        {"--outlet", OPTION_TEXT, &a->outlet, NULL},
        {"--seed", OPTION_COUNT, &a->seed, NULL},
        {"--resamples", OPTION_COUNT, &a->resamples, NULL},
        {"--footprint", OPTION_TEXT, &a->footprint, NULL},
        {"--bulk-density", OPTION_TEXT, &a->bulk_density, NULL},
    };
    int found =
        options_read("rtd", argc, argv, options, sizeof options / sizeof *options, &a->run, 1);
    if (found == 0) fprintf(stderr, "clast rtd: which run? See clast rtd --help\n");
    return found == 1;
}

/* False after a message; text NULL leaves *si alone. */
static bool read_quantity(const char *name, const char *text, unit_kind kind, const char *like,
                          double *si) {
    char why[UNIT_TEXT] = "";
    unit_value v;
    if (!text) return true;
    bool good = unit_parse(text, NULL, &v, why);
    if (good && (v.bare || unit_same(v.dimension, unit_kind_dimension(kind))) && v.value > 0) {
        *si = v.value;
        return true;
    }
    fprintf(stderr, "clast rtd: %s %s: expected %s%s%s\n", name, text, like, *why ? ": " : "", why);
    return false;
}

static bool read_time(const char *name, const char *text, double *seconds) {
    return read_quantity(name, text, UNIT_TIME, "a time above zero, such as 3min or 90s", seconds);
}

static bool read_bed(const arguments *a, rtd_options *o) {
    if (!a->footprint != !a->bulk_density) {
        fprintf(stderr, "clast rtd: found %s alone, expected --footprint and --bulk-density\n",
                a->footprint ? "--footprint" : "--bulk-density");
        return false;
    }
    return read_quantity("--footprint", a->footprint, UNIT_AREA,
                         "an area above zero, such as 210cm2", &o->footprint) &&
           read_quantity("--bulk-density", a->bulk_density, UNIT_DENSITY,
                         "a density above zero, such as 350kg/m3", &o->bulk_density);
}

/* What makes the numbers doubtful, on stderr; the exit code that it gives. */
static int warn(const char *run, const passages *p) {
    if (p->strays > 0)
        fprintf(stderr,
                "clast rtd: %s: warning: %zu bodies left the domain, by no outlet, and count as "
                "having left; --outlet leaves them out\n",
                run, p->strays);
    if (passages_balanced(p)) return CLAST_EXIT_OK;
    fprintf(
        stderr,
        "clast rtd: %s: mass is lost: found %.6g kg in less out less inside, expected 0 within "
        "half the lightest body (%.3g kg): feeds.csv, outlets.csv and series.csv do not agree\n",
        run, p->balance, p->lightest);
    return CLAST_EXIT_RUN_FAILED;
}

static int analyse(const arguments *a, const rtd_options *o) {
    char why[RTD_ERROR_MAX];
    passages *p = passages_read(a->run, o, why);
    if (!p) {
        fprintf(stderr, "clast rtd: %s\n", why);
        return CLAST_EXIT_FILE;
    }
    if (!rtd_sampling_fits(p, o->sampling, why)) {
        fprintf(stderr, "clast rtd: --sampling: %s\n", why);
        passages_free(p);
        return CLAST_EXIT_USAGE;
    }
    rtd *r = rtd_new(p, o, why);
    int code = CLAST_EXIT_RUN_FAILED;
    if (r) {
        rtd_print(r, stdout);
        code = warn(a->run, p);
        if (a->out && rtd_write(r, a->out)) code = CLAST_EXIT_FILE;
    } else {
        fprintf(stderr, "clast rtd: %s: %s\n", a->run, why);
    }
    rtd_free(r);
    passages_free(p);
    return code;
}

int cmd_rtd(int argc, char **argv) {
    if (options_ask_help(argc, argv)) {
        fputs(HELP, stdout);
        return CLAST_EXIT_OK;
    }
    arguments a = {.seed = 1, .resamples = 1000};
    if (!read_arguments(argc, argv, &a)) return CLAST_EXIT_USAGE;
    rtd_options o = {
        .feed = a.feed, .outlet = a.outlet, .seed = (uint64_t)a.seed, .resamples = a.resamples};
    if (!read_time("--sampling", a.sampling, &o.sampling) ||
        !read_time("--from", a.from, &o.from) || !read_time("--until", a.until, &o.until) ||
        !read_bed(&a, &o))
        return CLAST_EXIT_USAGE;
    return analyse(&a, &o);
}
