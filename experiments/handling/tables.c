/* tables.c - the data folder: plain CSV that the figures are drawn from. Lengths in cm, as in the
 * inputs. */
#include <math.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/handling/handling.h"
#include "experiments/study/verdict.h"

static frame *frame_of(results *r, size_t i) {
    frame *f = results_frame(r, i);
    if (f) return f;
    fprintf(stderr, "handling: %s\n", results_error(r));
    exit(4);
}

/* ---- where bodies go ------------------------------------------------------------------------- */

static void write_places(FILE *f, const char *name, const handling_run *run) {
    results *r = run_open(run);
    for (size_t i = 0; i < results_frames(r); i++) {
        frame *now = frame_of(r, i);
        for (size_t k = 0; k < now->bodies; k++) {
            const double *p = &now->position[3 * k], *v = &now->velocity[3 * k];
            fprintf(f, "%s,%d,%u,%.4g,%.5g,%.5g,%.5g,%.4g\n", name, run->replicate + 1,
                    (unsigned)now->id[k], now->time, 100 * p[0], 100 * p[1], 100 * p[2],
                    100 * v[0]);
        }
        frame_free(now);
    }
    results_free(r);
}

/* One particle: all runs; many: the first. */
static int write_tracks(const handling_study *s) {
    FILE *f = output_table(s->to.data, "tracks.csv",
                           "scene,replicate,body,time_s,x_cm,y_cm,z_cm,vx_cm_s");
    if (!f) return 4;
    const handling_run *run;
    for (int kind = 0; kind < BIN; kind++)
        for (int k = 0; k < (kind <= IRREGULAR ? REPLICATES_MAX : 1); k++)
            if ((run = run_of(s, (scene_kind)kind, 0, k))) write_places(f, KIND_NAME[kind], run);
    return output_close(f);
}

static int write_passing(const handling_study *s) {
    FILE *f =
        output_table(s->to.data, "passing.csv", "replicate,order,time_s,speed_cm_s,ahead_cm,alone");
    if (!f) return 4;
    const handling_run *run;
    for (int k = 0; k < REPLICATES_MAX; k++) {
        if (!(run = run_of(s, SINGULATION, 0, k))) continue;
        results *r = run_open(run);
        singled one = singled_of(r);
        for (int i = 0; i < one.count; i++)
            fprintf(f, "%d,%d,%.4g,%.4g,%.4g,%d\n", k + 1, i + 1, one.time[i], 100 * one.speed[i],
                    100 * one.ahead[i], one.alone[i]);
        results_free(r);
    }
    return output_close(f);
}

/* ---- forces on the conveyors (Fig. 3.27) ----------------------------------------------------- */

static const double WINDOW = 2e-3; /* s, before and behind the largest force */

static void write_belt(FILE *f, const results *r, const char *part, double at) {
    char name[3][40];
    for (int k = 0; k < 3; k++) snprintf(name[k], 40, "%s_force_%c_N", part, "xyz"[k]);
    const double *t = run_column(r, "time_s"), *x = run_column(r, name[0]);
    const double *y = run_column(r, name[1]), *z = run_column(r, name[2]);
    for (size_t i = 0; i < results_rows(r); i++) {
        double normal = -z[i] + 0.0, shear = hypot(x[i], y[i]); /* no minus before 0 */
        if (i % EVERY_STEPS == 0)
            fprintf(f, "%s,fiftieth,%.8g,%.6g,%.6g\n", part, t[i], normal, shear);
        if (fabs(t[i] - at) <= WINDOW)
            fprintf(f, "%s,every,%.8g,%.6g,%.6g\n", part, t[i], normal, shear);
    }
}

static int write_forces(const handling_study *s) {
    FILE *f = output_table(s->to.data, "forces.csv", "part,record,time_s,normal_N,tangential_N");
    if (!f) return 4;
    const handling_run *run = run_of(s, IRREGULAR, 0, 0);
    if (run) {
        results *r = run_open(run);
        double at = drop_of(r).at;
        write_belt(f, r, "upper", at);
        write_belt(f, r, "lower", at);
        results_free(r);
    }
    return output_close(f);
}

static int write_drops(const handling_study *s) {
    FILE *f = output_table(s->to.data, "drops.csv",
                           "replicate,collisions,peak_N,seen_N,tangential_N,duration_s,"
                           "first_is_largest,shear_with_normal");
    if (!f) return 4;
    const handling_run *run;
    for (int k = 0; k < REPLICATES_MAX; k++) {
        if (!(run = run_of(s, IRREGULAR, 0, k))) continue;
        results *r = run_open(run);
        drop d = drop_of(r);
        fprintf(f, "%d,%d,%.6g,%.6g,%.6g,%.4g,%d,%d\n", k + 1, d.collisions, d.peak, d.seen,
                d.shear, d.duration, d.first_is_largest, d.shear_with_normal);
        results_free(r);
    }
    return output_close(f);
}

/* ---- the bin (Fig. 3.31) --------------------------------------------------------------------- */

static void write_curve(FILE *f, const handling_run *run) {
    results *r = run_open(run);
    const double *t = run_column(r, "time_s"), *out = run_column(r, "out_count");
    size_t n = results_rows(r);
    for (size_t i = 0; i < n; i++)
        if (i == 0 || i + 1 == n || out[i] != out[i - 1] || out[i] != out[i + 1])
            fprintf(f, "%.1f,%g,%d,%.5g,%g\n", ASPECT[run->shape], ORIFICE_CM[run->orifice],
                    run->replicate + 1, t[i], out[i]);
    results_free(r);
}

static int write_bin(const handling_study *s) {
    FILE *curves =
        output_table(s->to.data, "discharge.csv", "aspect,orifice_cm,replicate,time_s,number");
    if (!curves) return 4;
    FILE *f = output_table(s->to.data, "bin.csv",
                           "aspect,orifice_cm,n,arched,arched_half,out,out_half,rate,rate_half,"
                           "coordination,coordination_half");
    if (!f) return 4 | output_close(curves);
    const handling_run *run;
    for (int shape = 0; shape < SHAPES; shape++)
        for (int orifice = 0; orifice < ORIFICES; orifice++) {
            for (int k = 0; k < REPLICATES_MAX; k++)
                if ((run = flow_of(s, 0, shape, orifice, k))) write_curve(curves, run);
            bin_summary b = bin_over(s, 0, shape, orifice);
            if (b.runs == 0) continue;
            fprintf(f, "%.1f,%g,%d,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g\n", ASPECT[shape],
                    ORIFICE_CM[orifice], b.runs, b.arched.mean, b.arched.half, b.out.mean,
                    b.out.half, b.rate.mean, b.rate.half, b.coordination.mean, b.coordination.half);
        }
    return output_close(curves) | output_close(f);
}

/* ---- templates ------------------------------------------------------------------------------- */

/* x of the element spheres in the frame of the body: turned back by its orientation. */
static void write_template(FILE *f, const char *shape, const handling_run *run) {
    if (!run) return;
    results *r = run_open(run);
    frame *now = frame_of(r, 0);
    const double *q = now->orientation, *p = now->position;
    const double axis[3] = {1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] + q[0] * q[3]),
                            2 * (q[1] * q[3] - q[0] * q[2])};
    for (size_t i = 0; i < now->spheres && now->sphere_body[i] == now->id[0]; i++) {
        double x = 0;
        for (int k = 0; k < 3; k++) x += (now->centre[3 * i + (size_t)k] - p[k]) * axis[k];
        fprintf(f, "%s,%.4f,%.4f\n", shape, 100 * x, 100 * now->radius[i]);
    }
    frame_free(now);
    results_free(r);
}

static int write_templates(const handling_study *s) {
    FILE *f = output_table(s->to.data, "templates.csv", "shape,x_cm,r_cm");
    if (!f) return 4;
    write_template(f, "tapered", run_of(s, TAPERED, 0, 0));
    write_template(f, "irregular", run_of(s, IRREGULAR, 0, 0));
    write_template(f, "spheroid", run_of(s, SINGULATION, 0, 0));
    for (int i = 0; i < SHAPES; i++) {
        pair_shape p = pair_of(ASPECT[i]);
        fprintf(f, "%.1f,%.4f,%.4f\n%.1f,%.4f,%.4f\n", ASPECT[i], -p.half, p.radius, ASPECT[i],
                p.half, p.radius);
    }
    return output_close(f);
}

/* ---- what assumptions do --------------------------------------------------------------------- */

static void row(FILE *f, const variant *v, scene_kind kind, const char *quantity,
                const interval *ours) {
    char text[60];
    if (ours->n == 0) return;
    interval_text(ours, text, sizeof text);
    fprintf(f, "%s,%s,%s,%d,%s,%s\n", KIND_NAME[kind], v->assumption, v->name, ours->n, quantity,
            text);
}

static void write_conveyed(FILE *f, const handling_study *s, int v, scene_kind kind) {
    conveyed_summary c = conveyed_over(s, kind, v);
    row(f, &VARIANTS[v], kind, "share dropped", &c.dropped);
    row(f, &VARIANTS[v], kind, "share moved back", &c.returned);
    if (kind == IRREGULAR) row(f, &VARIANTS[v], kind, "largest force (N)", &c.peak);
}

static void write_variant(FILE *f, const handling_study *s, int v, scene_kind kind) {
    const variant *of = &VARIANTS[v];
    if (kind <= BUNCH) write_conveyed(f, s, v, kind);
    if (kind == SINGULATION) {
        singled_summary one = singled_over(s, v);
        row(f, of, kind, "share touching no other", &one.alone);
        row(f, of, kind, "share that passes", &one.passed);
    }
    if (kind == DISC) {
        disc_summary d = disc_over(s, v);
        row(f, of, kind, "share that stays", &d.stay);
        row(f, of, kind, "frequency over spin", &d.frequency);
    }
    if (kind == BIN) {
        bin_summary b = bin_over(s, v, 2, 0); /* the shape in the middle, 5 cm */
        row(f, of, kind, "share of arches", &b.arched);
        row(f, of, kind, "particles out", &b.out);
    }
}

static int write_variants(const handling_study *s) {
    FILE *f = output_table(s->to.data, "variants.csv", "scene,assumption,variant,n,quantity,value");
    if (!f) return 4;
    for (int kind = 0; kind < KINDS; kind++)
        for (int v = 0; v < VARIANT_COUNT; v++)
            if (v == 0 || VARIANTS[v].kind == (scene_kind)kind)
                write_variant(f, s, v, (scene_kind)kind);
    return output_close(f);
}

/* ---- all ------------------------------------------------------------------------------------- */

static double worst_residual(const handling_study *s) {
    double worst = 0;
    for (int i = 0; i < s->run_count; i++) {
        if (!s->runs[i].ran || s->runs[i].variant != 0) continue;
        results *r = run_open(&s->runs[i]);
        const double *residual = run_column(r, "residual_J"), *input = run_column(r, "input_J");
        size_t n = results_rows(r);
        for (size_t k = 0; k < n; k++) worst = fmax(worst, fabs(residual[k]) / input[n - 1]);
        results_free(r);
    }
    return worst;
}

static int write_about(const handling_study *s) {
    FILE *f = output_table(s->to.data, "about.txt", "study=handling");
    if (!f) return 4;
    uint64_t hash = 0;
    for (int i = 0; i < s->run_count; i++) hash = hash * UINT64_C(0x100000001b3) ^ s->jobs[i].hash;
    const int *n = s->size->replicates;
    fprintf(f, "size=%s\nreplicates=%d tapered; %d irregular; %d bunch; %d singulation; %d bin\n",
            s->size->name, n[TAPERED], n[IRREGULAR], n[BUNCH], n[SINGULATION], n[BIN]);
    fprintf(f, "hash=0x%016llx\nengine=%s\nworst_residual=%.2g\n", (unsigned long long)hash,
            CLAST_VERSION, worst_residual(s));
    return output_close(f);
}

int handling_write_tables(const handling_study *s) {
    CLAST_ASSERT(s);
    int bad = write_tracks(s) | write_passing(s) | write_forces(s);
    bad |= write_drops(s) | write_bin(s) | write_templates(s) | write_variants(s);
    return bad | write_about(s) ? 4 : 0;
}
