#include "experiments/run/progress.h"

#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "engine/check.h"

double clock_seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void progress_start(progress *p, run_talk talk, uint64_t first_step, uint64_t last_step) {
    *p = (progress){.talk = talk,
                    .first_step = first_step,
                    .last_step = last_step,
                    .shown_step = first_step,
                    .terminal = clast_ranks_count() == 1 && isatty(STDOUT_FILENO) == 1};
    p->started = p->shown = clock_seconds();
}

/* "1 h 05 min", "3 min 20 s", "12 s" */
static void print_duration(double seconds) {
    long s = lround(seconds);
    if (s >= 3600)
        printf("%ld h %02ld min", s / 3600, s / 60 % 60);
    else if (s >= 60)
        printf("%ld min %02ld s", s / 60, s % 60);
    else
        printf("%ld s", s);
}

void progress_show(progress *p, clast_world *w) {
    double now = clock_seconds();
    uint64_t step = clast_world_steps(w);
    double rate = (double)(step - p->first_step) / fmax(now - p->started, 1e-9);
    double done = p->last_step > 0 ? 100 * (double)step / (double)p->last_step : 100;
    clast_energy e = clast_world_energy(w);
    if (p->terminal) printf("\r\033[K");
    printf("t = %.4f s  %3.0f %%  %.3g steps/s  %.3g M sphere-steps/s  residual %.2g  left ",
           clast_world_time(w), done, rate, 1e-6 * rate * (double)clast_world_counters(w).spheres,
           e.input > 0 ? fabs(e.residual) / e.input : 0);
    print_duration(rate > 0 ? (double)(p->last_step - step) / rate : 0);
    if (!p->terminal) putchar('\n');
    fflush(stdout);
    p->line_open = p->terminal;
    p->shown = now;
    p->shown_step = step;
}

bool progress_is_due(const progress *p, const clast_world *w) {
    if (p->talk != RUN_TALK || clast_world_steps(w) >= p->last_step) return false;
    double now = clock_seconds(), waited = now - p->shown;
    bool tenth = clast_world_steps(w) - p->shown_step >= (p->last_step - p->first_step) / 10;
    return p->terminal ? waited > 0.2 : waited > 10 || (tenth && waited > 1);
}

void progress_stop(progress *p) {
    if (p->line_open) printf("\r\033[K");
    p->line_open = false;
    fflush(stdout);
}

static void print_every(const char *what, double every) {
    if (every > 0) printf(", %s every %.6g s", what, every);
}

/* What comes; how much will be there at once is for the run to find out. */
static void report_feeds(const clast_world *w) {
    for (int i = 0; i < clast_world_feed_count(w); i++) {
        clast_feed_def d = clast_world_feed(w, i);
        printf("feed    %s: ", d.name);
        if (d.mass_rate > 0)
            printf("%.6g kg/h", 3600 * d.mass_rate);
        else
            printf("%.6g bodies/s", d.number_rate);
        printf(" from %.6g s", d.from);
        if (d.until > 0) printf(" until %.6g s", d.until);
        putchar('\n');
    }
}

void report_plan(const scene *s, const run_options *o) {
    clast_plan p = clast_world_plan(s->world);
    clast_counters c = clast_world_counters(s->world);
    int walls = clast_world_wall_count(s->world), parts = clast_world_part_count(s->world);
    printf("scene   %s: %zu bodies, %zu spheres, %d wall%s in %d part%s\n",
           s->title && s->title[0] ? s->title : "untitled", c.bodies, c.spheres, walls,
           walls == 1 ? "" : "s", parts, parts == 1 ? "" : "s");
    printf("step    %.4g s: %.3g per contact at %.3g m/s (Rayleigh %.3g s, critical %.3g s)\n",
           p.time_step, p.resolution, p.impact_speed, p.rayleigh_step, p.critical_step);
    printf("kernel  %s; %s, %d thread%s", p.kernel ? p.kernel : "general", p.isa ? p.isa : "?",
           p.threads, p.threads == 1 ? "" : "s");
    if (clast_ranks_count() > 1) printf(" in each of %d processes", clast_ranks_count());
    putchar('\n');
    report_feeds(s->world);
    printf("until   %.6g s", s->ending.latest);
    if (s->ending.rest_for > 0)
        printf(" or nothing faster than %.3g m/s for %.3g s", s->ending.rest_speed,
               s->ending.rest_for);
    printf("\noutput  %s", o->out);
    print_every("frames", s->output.frame_every);
    print_every("series", s->output.series_every);
    print_every("checkpoints", s->output.checkpoint_every);
    putchar('\n');
    fflush(stdout);
}

void report_costs(const scene *s, double seconds, uint64_t steps) {
    clast_counters c = clast_world_counters(s->world);
    const struct {
        const char *name;
        double seconds;
    } stages[] = {{"neighbours", c.seconds_neighbours},
                  {"contacts", c.seconds_contacts},
                  {"bodies", c.seconds_bodies},
                  {"walls", c.seconds_walls},
                  {"guards", c.seconds_measure}};
    double known = 0;
    printf("stage          s      %%\n");
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
        printf("%-10s %7.2f  %5.1f\n", stages[i].name, stages[i].seconds,
               100 * stages[i].seconds / fmax(seconds, 1e-9));
        known += stages[i].seconds;
    }
    printf("%-10s %7.2f  %5.1f\n", "output", fmax(seconds - known, 0),
           100 * fmax(seconds - known, 0) / fmax(seconds, 1e-9));
    printf("%-10s %7.2f\n", "total", seconds);
    printf("%llu steps, %.3g steps/s, %llu rebuilds, %zu pairs, %zu candidates, %zu contacts\n",
           (unsigned long long)steps, (double)steps / fmax(seconds, 1e-9),
           (unsigned long long)c.rebuilds, c.pairs, c.candidates, c.contacts);
    if (clast_ranks_count() > 1)
        printf("the first of %d processes: %zu ghosts, %.3g messages and %.3g kB per step, "
               "%llu divisions of the world\n",
               clast_ranks_count(), c.ghosts, (double)c.messages / fmax((double)steps, 1),
               1e-3 * (double)c.message_bytes / fmax((double)steps, 1),
               (unsigned long long)c.divisions);
    printf("overlap max %.3g of a radius, %zu bodies left, engine memory %.1f MB\n", c.overlap_max,
           c.removed, 1e-6 * (double)c.bytes);
    fflush(stdout);
}
