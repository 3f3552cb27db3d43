/* plan.c - the cases, and which of them a size is made of. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/grate-rtd/grate.h"

static const double BAR_SPEED = 3.5, PAUSE = 1, FRAMES = 120; /* mm/s, s, s, as in the scenes */
static const double DEGREE = 3.14159265358979323846 / 180;

/* Grate and bars of each device (S12 Tables 4.1 and 4.7). Every other bar moves: those that sweep
 * the stretch on which the feed falls, too. Where noses look downhill that is the first bar itself,
 * under the back wall; where they look uphill, the one below it. */
static const struct {
    double slope; /* degrees, rising towards +x */
    int way;      /* of downhill */
    bool leads;   /* the bar at the lowest x moves */
} DEVICES[] = {[FORWARD] = {-13, 1, true}, [BACKWARD] = {25, -1, false}, [STAIRS] = {-20, 1, true}};

#define GRATE    "grate.yaml"
#define LINEAR   "linear.yaml"
#define PACKING  "packing.yaml"
#define PERIODIC "periodic.yaml"

#define CLAY    .diameter = 0.021
#define WOOD    .diameter = 0.015
#define CERAMIC .diameter = 0.0126
#define NARROW  .diameter = 0.014

/* Table 3.4 and section 3.9.4: its walls are bars. */
#define WOOD_35   "grain=wood", "side=acrylic", "bar_speed=35 mm/s", "pause=0.1 s"
#define WOOD_FAST WOOD_35, "frames=4 s"

/* Of the published speed at each size but the quick one. */
#define FILMED(brief, time)                                                                        \
    { 0, brief, time, time }

/* Variants run at the published size alone. */
#define PUBLISHED(time)                                                                            \
    { 0, 0, time, time }
#define POURED                                                                                     \
    { 0, 4.0 / 3600, 4.0 / 3600, 4.0 / 3600 }

/* Rows of tables read better as they stand here. */
/* clang-format off */
/* What an assumption does to clay on a grate: a row of its own, at a pitch and a width. */
#define CLAY_ROW(which, on, what, value, wide, apart, ...)                                         \
    {.name = which ": " value, .group = GROUP_VARIANT, .assumption = what, .of = which,            \
     .device = on, .scene = GRATE, .set = {"grain=clay", __VA_ARGS__}, .hours = PUBLISHED(3),      \
     .feed = 20, CLAY, .across = wide, .pitch = apart}

/* Feeds other than the printed 20 kg/h, which is of the first group. */
#define FEED_ROW(rate, brief, published, full)                                                     \
    {.name = "backward clay " #rate " kg/h", .group = GROUP_FEED, .device = BACKWARD,              \
     .scene = GRATE, .set = {"grain=clay"}, .hours = {0, brief, published, full}, .feed = rate,    \
     CLAY, .across = 1}

/* All feeds with bars and feed at ten times the speed. */
#define QUICK_FEED_ROW(rate, time)                                                                 \
    {.name = "backward clay " #rate " kg/h at 10 x", .group = GROUP_FEED_10X, .device = BACKWARD, \
     .scene = GRATE, .set = {"grain=clay"}, .hours = PUBLISHED(time), .feed = rate, CLAY,          \
     .across = 1}

/* The first two cases again, shorter. */
#define SEED_ROW(which, on, value)                                                                 \
    {.name = which ": " value " (5 h at 1 x)", .group = GROUP_SEED, .assumption = "seed",          \
     .of = which, .device = on, .scene = GRATE, .set = {"grain=clay", "seed=" value},              \
     .hours = PUBLISHED(5), .feed = 20, CLAY, .across = 1}

#define CLAY_ROWS(which, on)                                                                       \
    CLAY_ROW(which, on, "bars and feed", "10 x", 1, 0, NULL),                                      \
    CLAY_ROW(which, on, "time step", "0.25 ms", 1, 0, "step=0.25 ms"),                             \
    CLAY_ROW(which, on, "pause", "none", 1, 0, "pause=0 s"),                                       \
    CLAY_ROW(which, on, "pause", "5 s", 1, 0, "pause=0.5 s"),                                      \
    CLAY_ROW(which, on, "drop", "0.1 m", 1, 0, "drop=100 mm"),                                     \
    CLAY_ROW(which, on, "drop", "0.3 m", 1, 0, "drop=300 mm"),                                     \
    CLAY_ROW(which, on, "feed area", "at the back wall", 1, 0, "feed_at=31 mm"),                   \
    CLAY_ROW(which, on, "nose radius", "1 mm", 1, 0, "nose=1 mm"),                                 \
    CLAY_ROW(which, on, "nose radius", "15 mm", 1, 0, "nose=15 mm"),                               \
    CLAY_ROW(which, on, "travel", "60 mm", 1, 0, "travel=60 mm", "behind=30 mm"),                  \
    CLAY_ROW(which, on, "moving bars start", "30 mm behind the line", 1, 0, "behind=30 mm"),       \
    CLAY_ROW(which, on, "Young's modulus", "0.4 MPa", 1, 0, "young_clay=0.4 MPa",           \
             "step=0.25 ms"),                                                                      \
    CLAY_ROW(which, on, "pitch", "100 mm", 1, 0.1, NULL),                                          \
    CLAY_ROW(which, on, "width", "2 particles", 2, 0, NULL)

const grate_case CASES[] = {
    {.name = "forward clay", .group = GROUP_MAIN, .device = FORWARD, .scene = GRATE,
     .set = {"grain=clay"}, .hours = {1, 5, 14, 42}, .feed = 20, CLAY, .across = 1},
    {.name = "backward clay", .group = GROUP_MAIN, .device = BACKWARD, .scene = GRATE,
     .set = {"grain=clay"}, .hours = {1, 5, 15, 45}, .feed = 20, CLAY, .across = 1},
    {.name = "backward wood", .group = GROUP_MAIN, .device = BACKWARD, .scene = GRATE,
     .set = {"grain=wood"}, .hours = {0, 2, 6, 18}, .feed = 40, WOOD, .across = 1},
    {.name = "backward ceramic", .group = GROUP_MAIN, .device = BACKWARD, .scene = GRATE,
     .set = {"grain=ceramic"}, .hours = {0, 3, 8, 24}, .feed = 60, CERAMIC, .across = 1},

    {.name = "fast 13.6 kg/h", .group = GROUP_FAST, .device = BACKWARD, .scene = LINEAR,
     .set = {WOOD_FAST}, .hours = {0, 0.1, 0.3, 1.5}, .feed = 13.6, WOOD, .across = 2},
    {.name = "fast 10.2 kg/h", .group = GROUP_FAST, .device = BACKWARD, .scene = LINEAR,
     .set = {WOOD_FAST}, .hours = PUBLISHED(0.2), .feed = 10.2, WOOD, .across = 2},
    {.name = "fast 6.8 kg/h", .group = GROUP_FAST, .device = BACKWARD, .scene = LINEAR,
     .set = {WOOD_FAST}, .hours = {0, 0.1, 0.25, 1}, .feed = 6.8, WOOD, .across = 2},

    {.name = "packing 1", .group = GROUP_PACKING, .scene = PACKING, .set = {"count=115"},
     .hours = POURED, WOOD, .across = 1, .replicates = 5},
    {.name = "packing 2", .group = GROUP_PACKING, .scene = PACKING, .set = {"count=230"},
     .hours = POURED, WOOD, .across = 2, .replicates = 5},
    {.name = "packing 3", .group = GROUP_PACKING, .scene = PACKING, .set = {"count=345"},
     .hours = POURED, WOOD, .across = 3, .replicates = 5},
    {.name = "packing 5", .group = GROUP_PACKING, .scene = PACKING, .set = {"count=575"},
     .hours = POURED, WOOD, .across = 5, .replicates = 5},
    {.name = "packing wide", .group = GROUP_PACKING, .scene = PACKING, .set = {"count=1150"},
     .hours = POURED, WOOD, .across = 10, .replicates = 5},

    {.name = "width 1", .group = GROUP_WIDTH, .device = STAIRS, .scene = LINEAR,
     .hours = PUBLISHED(3), .feed = 20, NARROW, .across = 1},
    {.name = "width 2", .group = GROUP_WIDTH, .device = STAIRS, .scene = LINEAR,
     .hours = PUBLISHED(1.5), .feed = 20, NARROW, .across = 2},
    {.name = "width 5", .group = GROUP_WIDTH, .device = STAIRS, .scene = LINEAR,
     .hours = PUBLISHED(1), .feed = 20, NARROW, .across = 5},
    {.name = "width 5 periodic", .group = GROUP_WIDTH, .device = STAIRS, .scene = PERIODIC,
     .hours = PUBLISHED(1), .feed = 20, NARROW, .across = 5},

    FEED_ROW(10, 0, 11, 33),
    FEED_ROW(14, 0, 9, 27),
    FEED_ROW(28, 0, 6, 18),
    FEED_ROW(40, 2, 5, 15),
    QUICK_FEED_ROW(10, 7),
    QUICK_FEED_ROW(14, 6),
    QUICK_FEED_ROW(20, 5),
    QUICK_FEED_ROW(28, 4),
    QUICK_FEED_ROW(40, 4),

    SEED_ROW("forward clay", FORWARD, "2"),
    SEED_ROW("forward clay", FORWARD, "3"),
    SEED_ROW("backward clay", BACKWARD, "2"),
    SEED_ROW("backward clay", BACKWARD, "3"),

    {.name = "film of forward clay", .group = GROUP_FILM, .device = FORWARD, .scene = GRATE,
     .set = {"grain=clay", "frames=1 s"}, .hours = FILMED(0.55, 0.8), .feed = 20, CLAY,
     .across = 1},
    {.name = "film of wood", .group = GROUP_FILM, .device = BACKWARD, .scene = LINEAR,
     .set = {WOOD_35, "frames=0.1 s"}, .hours = FILMED(0.035, 0.056), .feed = 13.6, WOOD,
     .across = 2, .of = "fast 13.6 kg/h"},

    {.name = "fast 13.6 kg/h: 74 mm", .group = GROUP_VARIANT, .assumption = "pitch",
     .of = "fast 13.6 kg/h", .device = BACKWARD, .scene = LINEAR, .set = {WOOD_FAST},
     .hours = PUBLISHED(0.15), .feed = 13.6, WOOD, .across = 2, .pitch = 0.074},
    {.name = "fast 13.6 kg/h: 98 mm", .group = GROUP_VARIANT, .assumption = "pitch",
     .of = "fast 13.6 kg/h", .device = BACKWARD, .scene = LINEAR, .set = {WOOD_FAST},
     .hours = PUBLISHED(0.3), .feed = 13.6, WOOD, .across = 2, .pitch = 0.098},
    {.name = "fast 13.6 kg/h: 109 mm", .group = GROUP_VARIANT, .assumption = "pitch",
     .of = "fast 13.6 kg/h", .device = BACKWARD, .scene = LINEAR, .set = {WOOD_FAST},
     .hours = PUBLISHED(0.15), .feed = 13.6, WOOD, .across = 2, .pitch = 0.109},

    CLAY_ROWS("forward clay", FORWARD),
    CLAY_ROW("forward clay", FORWARD, "which bars move", "the second and every other", 1, 0,
             "first=still", "second=moving", "lead=0"),
    CLAY_ROWS("backward clay", BACKWARD),
};
/* clang-format on */
const int CASE_COUNT = sizeof CASES / sizeof *CASES;

double case_slope(const grate_case *c) {
    return c->group == GROUP_PACKING ? 0 : DEVICES[c->device].slope * DEGREE;
}

double case_pitch(const grate_case *c) {
    return c->pitch > 0 ? c->pitch : PITCH;
}

/* A particle needs some gap (S12 3.9.4): 2 % of it. */
double case_width(const grate_case *c) {
    return c->diameter * (c->across + 0.02);
}

static bool is_fast(const grate_case *c) {
    return c->group == GROUP_FAST || (c->of && !strncmp(c->of, "fast", 4));
}

/* Rows that are compared with each other alone (sensitivity, one of the scans of the feed) run at
 * ten times the speed, as S12 3.9.4 does it. What runs down the stepped grate of the widths
 * does not creep from stroke to stroke: no other clock for it. */
double case_speed_up(const grate_case *c, study_size size) {
    if (is_fast(c) || c->group == GROUP_PACKING || c->group == GROUP_WIDTH) return 1;
    if (c->group == GROUP_FILM) return 1; /* eight frames and more in a stroke */
    bool hurried = c->group == GROUP_VARIANT || c->group == GROUP_FEED_10X;
    return hurried || size <= STUDY_BRIEF ? 10 : 1;
}

double case_bar_speed(const grate_case *c, study_size size) {
    return 1e-3 * BAR_SPEED * (is_fast(c) ? 10 : case_speed_up(c, size));
}

/* ---- jobs ------------------------------------------------------------------------------------ */

static char *path_of(const char *name) {
    char *path = malloc(strlen(SCENES) + strlen(name) + 2);
    CLAST_ASSERT(path);
    sprintf(path, "%s/%s", SCENES, name);
    return path;
}

static void set_grate(job *j, const grate_case *c, double speed_up) {
    job_set(j, "slope=%g deg", DEVICES[c->device].slope);
    job_set(j, "way=%d", DEVICES[c->device].way);
    if (!DEVICES[c->device].leads) {
        job_set(j, "first=still");
        job_set(j, "second=moving");
        job_set(j, "lead=0");
    }
    job_set(j, "rate=%g kg/h", c->feed * speed_up);
    job_set(j, "largest=%g mm", 1e3 * c->diameter);
    if (speed_up > 1) {
        job_set(j, "bar_speed=%g mm/s", BAR_SPEED * speed_up);
        job_set(j, "pause=%g s", PAUSE / speed_up);
        job_set(j, "frames=%g s", FRAMES / speed_up);
    }
    if (c->pitch > 0) job_set(j, "pitch=%g mm", 1e3 * c->pitch);
    /* this feed is that of the channel */
    if (is_fast(c)) job_set(j, "over=%.9g mm", 1e3 * case_width(c));
}

static void plan_one(grate_study *s, const grate_case *c, int replicate) {
    job *j = &s->jobs[s->count];
    j->scene = path_of(c->scene);
    snprintf(j->label, sizeof j->label, "%s", c->name);
    for (char *at = j->label; *at; at++)
        if (strchr(" ,/", *at)) *at = '-';
    double speed_up = case_speed_up(c, s->size);
    job_set(j, "end=%.9g s", 3600 * c->hours[s->size] / speed_up);
    job_set(j, "width=%.9g mm", 1e3 * case_width(c));
    if (c->group != GROUP_PACKING) set_grate(j, c, speed_up);
    if (replicate > 0) job_set(j, "seed=%d", 1 + replicate);
    for (int i = 0; i < CASE_SETTINGS && c->set[i]; i++) job_set(j, "%s", c->set[i]);
    jobs_name(j, s->root);
    s->results[s->count++] =
        (grate_result){.of = c, .replicate = replicate, .speed_up = speed_up, .folder = j->folder};
}

void grate_plan(grate_study *s) {
    for (int i = 0; i < CASE_COUNT; i++) {
        int replicates = CASES[i].replicates > 0 ? CASES[i].replicates : 1;
        for (int k = 0; CASES[i].hours[s->size] > 0 && k < replicates; k++) {
            CLAST_ASSERT(s->count < CASES_MAX);
            plan_one(s, &CASES[i], k);
        }
    }
}

int grate_run_all(grate_study *s) {
    return jobs_run(s->jobs, s->count, jobs_processes(), "grates");
}

const grate_result *result_of(const grate_study *s, const char *name) {
    for (int i = 0; i < s->count; i++)
        if (!strcmp(s->results[i].of->name, name)) return s->results[i].rtd ? &s->results[i] : NULL;
    return NULL;
}
