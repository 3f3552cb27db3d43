/* clast_bench - how fast the engine is on the scenes of DESIGN section 8, ledger and guards on.
 *
 *     clast_bench [--scenes A20k,B] [--threads 1,2] [--isa baseline,avx2,avx512] [--runs 3]
 * [--quick]
 *                 [--states DIR] [--out DIR]
 *     clast_bench --scaling [--threads 1,2] [--runs 3] [--states DIR] [--out DIR]
 *     clast_bench --export SCENE [--states DIR] [--out DIR]     the settled state for the peers
 *     clast_bench --physics SCENE STEP... [--states DIR] [--out DIR]   dumps of a run from there
 *     clast_bench --judge SCENE DUMP                            what a dump of any code holds
 *     clast_bench --list
 *
 * Writes DIR/bench.csv, bench-stages.csv and, with several instruction sets, bench-isa.csv; with
 * --scaling bench-scaling.csv alone. Every
 * run is a process of its own; rounds go over all configurations, and the median of the rounds
 * counts. */
#include "tests/bench/exchange.h"
#include "tests/bench/machine.h"
#include "tests/bench/sample.h"

#include <inttypes.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAX_SCENES = 32, MAX_THREADS = 8, MAX_ISA = 4, MAX_RUNS = 25, MAX_ROWS = 256 };

static const char *const ISA_NAMES[] = {"auto", "baseline", "avx2", "avx512"};

typedef struct options {
    const bench_scene *scenes[MAX_SCENES];
    int scene_count, threads[MAX_THREADS], thread_count, isa[MAX_ISA], isa_count;
    int runs;
    bool quick, fresh, exactly, scaling;
    const char *states, *out, *program;
    const char *task, *subject; /* --export, --physics, --judge and what they are about */
    const char *rest[16];
    int rest_count;
} options;

typedef struct row {
    bool main;    /* of bench.csv; the others compare instruction sets */
    bool refused; /* this processor lacks the instruction set */
    bench_order order;
    bench_sample samples[MAX_RUNS];
    int count;
} row;

static void usage(const char *complaint, const char *what) {
    fprintf(stderr, "clast_bench: %s%s\n", complaint, what);
    fprintf(stderr, "usage: clast_bench [--scenes A20k,B] [--threads 1,2] [--isa baseline,avx2] "
                    "[--runs 3] [--quick] [--fresh] [--exactly] [--states DIR] [--out DIR]\n"
                    "       clast_bench --export SCENE | --physics SCENE STEP... | --judge SCENE "
                    "DUMP\n");
    exit(2);
}

/* ---- options --------------------------------------------------------------------------------- */

static const bench_scene *scene_named(const char *name) {
    const bench_scene *s = bench_scene_find(name);
    if (!s) usage("no such scene: ", name);
    return s;
}

static int isa_named(const char *name) {
    for (int i = 0; i < MAX_ISA; i++)
        if (strcmp(name, ISA_NAMES[i]) == 0) return i;
    usage("no such instruction set: ", name);
    return 0;
}

static int number_in(const char *text, int low, int high) {
    char *end;
    long n = strtol(text, &end, 10);
    if (*end || n < low || n > high) usage("not a number in its range: ", text);
    return (int)n;
}

/* Calls take(o, word) for every word of a list with commas. */
static void each(options *o, char *list, void (*take)(options *, const char *)) {
    for (char *word = strtok(list, ","); word; word = strtok(NULL, ",")) take(o, word);
}

static void take_scene(options *o, const char *word) {
    if (o->scene_count < MAX_SCENES) o->scenes[o->scene_count++] = scene_named(word);
}

static void take_threads(options *o, const char *word) {
    if (o->thread_count < MAX_THREADS) o->threads[o->thread_count++] = number_in(word, 0, 1024);
}

static void take_isa(options *o, const char *word) {
    if (o->isa_count < MAX_ISA) o->isa[o->isa_count++] = isa_named(word);
}

static bool take_flag(options *o, const char *name) {
    if (strcmp(name, "--quick") == 0) return o->quick = true;
    if (strcmp(name, "--fresh") == 0) return o->fresh = true;
    if (strcmp(name, "--exactly") == 0) return o->exactly = true;
    if (strcmp(name, "--scaling") == 0) return o->scaling = true;
    return false;
}

static void take_value(options *o, const char *name, char *value) {
    if (!value) usage("a value is missing after ", name);
    if (strcmp(name, "--scenes") == 0)
        each(o, value, take_scene);
    else if (strcmp(name, "--threads") == 0)
        each(o, value, take_threads);
    else if (strcmp(name, "--isa") == 0)
        each(o, value, take_isa);
    else if (strcmp(name, "--runs") == 0)
        o->runs = number_in(value, 1, MAX_RUNS);
    else if (strcmp(name, "--states") == 0)
        o->states = value;
    else if (strcmp(name, "--out") == 0)
        o->out = value;
    else if (strcmp(name, "--export") == 0 || strcmp(name, "--physics") == 0 ||
             strcmp(name, "--judge") == 0)
        o->task = name, o->subject = value;
    else
        usage("no such option: ", name);
}

/* Beds like A from 1000 to 1 000 000. */
static void take_scaling(options *o) {
    static const char *const SIZES[] = {"S1k",  "S3k",   "S10k",  "A20k",
                                        "S40k", "A100k", "S300k", "S1M"};
    for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; i++) take_scene(o, SIZES[i]);
}

static void fill_in(options *o) {
    static const char *const QUICK[] = {"A20k", "B", "G100"};
    if (o->scene_count == 0 && o->scaling) take_scaling(o);
    if (o->scene_count == 0 && o->quick)
        for (int i = 0; i < 3; i++) take_scene(o, QUICK[i]);
    bool all = o->scene_count == 0;
    for (int i = 0; all && i < bench_scene_count; i++)
        if (bench_scenes[i].use == BENCH_USE_ALL) o->scenes[o->scene_count++] = &bench_scenes[i];
    if (o->thread_count == 0) take_threads(o, "1"), take_threads(o, "2");
    if (o->isa_count == 0) o->isa[o->isa_count++] = CLAST_ISA_AUTO;
    if (o->runs == 0) o->runs = o->quick ? 1 : 3;
}

static options read_options(int argc, char **argv) {
    options o = {.states = "build/bench-states", .out = "build", .program = "/proc/self/exe"};
    for (int i = 1; i < argc; i++) {
        if (strncmp(argv[i], "--", 2) != 0) {
            if (o.rest_count == 16 || !o.task) usage("what is this: ", argv[i]);
            o.rest[o.rest_count++] = argv[i];
        } else if (!take_flag(&o, argv[i])) {
            take_value(&o, argv[i], argv[i + 1]);
            i++;
        }
    }
    fill_in(&o);
    return o;
}

/* ---- measuring ------------------------------------------------------------------------------- */

static int plan_rows(const options *o, row *rows) {
    int count = 0;
    for (int s = 0; s < o->scene_count; s++)
        for (int t = 0; t < o->thread_count; t++)
            for (int i = 0; i < o->isa_count && count < MAX_ROWS; i++) {
                if (i > 0 && t > 0) continue; /* the others on one count of threads alone */
                const bench_scene *scene = o->scenes[s];
                bench_wish wish = {o->threads[t], (clast_isa)o->isa[i], o->fresh, o->exactly};
                uint64_t part = o->quick ? 20 : 1;
                rows[count].main = i == 0;
                rows[count++].order =
                    (bench_order){scene, wish, scene->steps / part + 1, scene->warm / part};
            }
    return count;
}

/* A state that is missing is made before anything is timed. */
static void make_states(const options *o) {
    for (int s = 0; s < o->scene_count; s++) {
        bench_order first = {o->scenes[s], {.threads = 1}, 1, 0};
        bench_sample ignored;
        if (!bench_sample_take(&first, o->program, o->states, &ignored)) exit(1);
    }
}

static void measure_row(const options *o, row *r) {
    bench_sample *s = &r->samples[r->count];
    r->refused = !bench_sample_take(&r->order, o->program, o->states, s);
    if (r->refused && r->main) exit(1);
    if (r->refused) return;
    if (s->hash != r->samples[0].hash) usage("hashes differ between runs", "");
    r->count++;
}

static void measure(const options *o, row *rows, int count) {
    for (int run = 0; run < o->runs; run++)
        for (int i = 0; i < count; i++) {
            if (isatty(STDERR_FILENO))
                fprintf(stderr, "\rround %d of %d: %-6s %d threads ", run + 1, o->runs,
                        rows[i].order.scene->name, rows[i].order.wish.threads);
            if (!rows[i].refused) measure_row(o, &rows[i]);
        }
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r%-50s\r", "");
}

static int by_wall(const void *a, const void *b) {
    double x = ((const bench_sample *)a)->wall, y = ((const bench_sample *)b)->wall;
    return x < y ? -1 : x > y;
}

/* The run with the median time. */
static const bench_sample *median_of(row *r) {
    qsort(r->samples, (size_t)r->count, sizeof *r->samples, by_wall);
    return &r->samples[(r->count - 1) / 2];
}

/* ---- writing --------------------------------------------------------------------------------- */

static FILE *table(const options *o, const char *name, const char *header) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", o->out, name);
    mkdir(o->out, 0777);
    FILE *f = fopen(path, "w");
    if (!f) {
        perror(path);
        exit(1);
    }
    fprintf(f, "%s\n", header);
    return f;
}

static double speed_of(const bench_sample *s) {
    return 1e-6 * (double)s->spheres * (double)s->steps / s->wall;
}

static void write_main_row(FILE *f, const row *r, const bench_sample *s) {
    fprintf(f, "%s,%d,%zu,%" PRIu64 ",%.6f,%.6f,%.4f,%.1f\n", r->order.scene->name,
            r->order.wish.threads, s->spheres, s->steps, s->wall, s->cpu, speed_of(s),
            (double)s->peak_bytes / (double)s->spheres);
}

static void write_stages(FILE *f, const row *r, const bench_sample *s) {
    double known = 0;
    fprintf(f, "%s,%d,%s", r->order.scene->name, r->order.wish.threads, s->isa);
    for (int i = 0; i < BENCH_STAGES; i++) {
        fprintf(f, ",%.4f", 1e9 * s->stage[i] / (double)s->steps / (double)s->spheres);
        known += s->stage[i];
    }
    fprintf(f, ",%.4f\n", 1e9 * (s->wall - known) / (double)s->steps / (double)s->spheres);
}

static void write_isa(FILE *f, const row *r, const bench_sample *s) {
    fprintf(f, "%s,%d,%s,%.6f,%.4f,%016" PRIx64 "\n", r->order.scene->name, r->order.wish.threads,
            s->isa, s->wall, speed_of(s), s->hash);
}

static void write_scaling(const options *o, row *rows, int count) {
    FILE *f =
        table(o, "bench-scaling.csv",
              "scene,spheres,threads,ns_per_sphere_step,neighbours_ns,load_s,first_step_s,frame_s,"
              "bytes_per_sphere,engine_bytes_per_sphere");
    for (int i = 0; i < count; i++) {
        const bench_sample *s = median_of(&rows[i]);
        double n = (double)s->spheres, work = (double)s->steps * n;
        fprintf(f, "%s,%zu,%d,%.3f,%.3f,%.4f,%.4f,%.4f,%.1f,%.1f\n", rows[i].order.scene->name,
                s->spheres, rows[i].order.wish.threads, 1e9 * s->wall / work,
                1e9 * s->stage[2] / work, s->load, s->first, s->frame, (double)s->peak_bytes / n,
                (double)s->engine_bytes / n);
    }
    fclose(f);
}

/* bench.csv has the main rows; bench-isa.csv those that name an instruction set. */
static void write_tables(const options *o, row *rows, int count) {
    FILE *all = table(o, "bench.csv",
                      "scene,threads,spheres,steps,wall_s,cpu_s,msteps_per_s,bytes_per_sphere");
    FILE *stages = table(o, "bench-stages.csv",
                         "scene,threads,isa,bodies_ns,walls_ns,neighbours_ns,contacts_ns,"
                         "measure_ns,rest_ns");
    FILE *isa = o->isa_count > 1
                    ? table(o, "bench-isa.csv", "scene,threads,isa,wall_s,msteps_per_s,hash")
                    : NULL;
    for (int i = 0; i < count; i++) {
        if (rows[i].refused) continue;
        const bench_sample *s = median_of(&rows[i]);
        if (isa && rows[i].order.wish.isa != CLAST_ISA_AUTO) write_isa(isa, &rows[i], s);
        if (!rows[i].main) continue;
        write_main_row(all, &rows[i], s);
        write_stages(stages, &rows[i], s);
    }
    fclose(all), fclose(stages);
    if (isa) fclose(isa);
}

/* ---- telling --------------------------------------------------------------------------------- */

static void print_row(row *r) {
    const bench_sample *s = median_of(r);
    double n = (double)s->spheres, steps = (double)s->steps;
    printf("%-6s %d %-8s %8zu %8" PRIu64 " %8.3f %8.3f %9.2f %8.2f | %7.0f %6.0f %6.0f |",
           r->order.scene->name, r->order.wish.threads, s->isa, s->spheres, s->steps, s->wall,
           s->cpu, 1e6 * s->wall / steps, speed_of(s), (double)s->peak_bytes / n,
           (double)s->now_bytes / n, (double)s->engine_bytes / n);
    for (int i = 0; i < BENCH_STAGES; i++) printf(" %6.1f", 1e9 * s->stage[i] / steps / n);
    printf(" | %8.2f %10.2f %8.1f\n", (double)s->contacts / n, (double)s->candidates / n,
           s->rebuilds ? steps / (double)s->rebuilds : 0.0);
}

static void print_table(const options *o, row *rows, int count) {
    printf(
        "Median of %d runs; ledger and guards on. M/s: million sphere-steps per second. Bytes per "
        "sphere: peak of the\nprocess, reading the state included; resident while it steps; "
        "counted by the engine. 0 steps per rebuild: none.\n\n",
        o->runs);
    printf("%69s | %21s | %-34s | %s\n", "", "bytes per sphere", "ns per sphere and step",
           "per sphere          steps per");
    printf("%-6s %s %-8s %8s %8s %8s %8s %9s %8s | %7s %6s %6s |", "scene", "t", "isa", "spheres",
           "steps", "wall s", "cpu s", "us/step", "M/s", "peak", "now", "engine");
    for (int i = 0; i < BENCH_STAGES; i++) printf(" %6.6s", bench_stage_names[i]);
    printf(" | contacts candidates  rebuild\n");
    for (int i = 0; i < count; i++)
        if (!rows[i].refused) print_row(&rows[i]);
}

/* ---- tasks ----------------------------------------------------------------------------------- */

static int bench(const options *o) {
    row *rows = calloc(MAX_ROWS, sizeof *rows);
    if (!rows) return 1;
    int count = plan_rows(o, rows);
    make_states(o);
    measure(o, rows, count);
    if (o->scaling)
        write_scaling(o, rows, count);
    else
        write_tables(o, rows, count);
    bench_machine_write(o->out);
    print_table(o, rows, count);
    free(rows);
    return 0;
}

/* The hidden form that sample.c starts: --one SCENE THREADS ISA FRESH EXACTLY STEPS WARM
 * STATES. */
static int one(char **word) {
    bench_order order = {scene_named(word[0]),
                         {atoi(word[1]), (clast_isa)atoi(word[2]), atoi(word[3]) != 0,
                          atoi(word[4]) != 0},
                         strtoull(word[5], NULL, 10),
                         strtoull(word[6], NULL, 10)};
    bench_sample_print(&order, word[7]);
    return 0;
}

static int task(const options *o) {
    const bench_scene *scene = scene_named(o->subject);
    if (strcmp(o->task, "--export") == 0) return bench_export(scene, o->states, o->out);
    if (strcmp(o->task, "--physics") == 0)
        return bench_physics(scene, o->rest, o->rest_count, o->states, o->out);
    if (o->rest_count != 1) usage("--judge wants one dump", "");
    return bench_judge(scene, o->rest[0]);
}

/* Large blocks go back to the system when they are freed, at once and always: without this, glibc
 * keeps ever larger ones after the first. */
static void give_memory_back(void) {
#ifdef M_MMAP_THRESHOLD
    mallopt(M_MMAP_THRESHOLD, 128 * 1024);
#endif
}

int main(int argc, char **argv) {
    give_memory_back();
    if (argc == 10 && strcmp(argv[1], "--one") == 0) return one(argv + 2);
    if (argc == 2 && strcmp(argv[1], "--list") == 0) return bench_list();
    options o = read_options(argc, argv);
    return o.task ? task(&o) : bench(&o);
}
