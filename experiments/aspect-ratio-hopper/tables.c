/* tables.c - the data folder: plain CSV that the figures are drawn from. Lengths in cm. */
#include <math.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"
#include "experiments/study/output.h"
#include "experiments/study/verdict.h"

/* ---- facts ----------------------------------------------------------------------------------- */

static int write_facts(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "facts.csv",
                           "fact,unit,shape,aspect,density,n,mean,half,thesis_setting");
    if (!f) return 4;
    for (int i = 0; i < FACT_COUNT; i++)
        for (int shape = 0; shape < SHAPES; shape++) {
            interval ours = over(s, shape, FACTS[i].of), thesis = at_thesis(s, shape, FACTS[i].of);
            chain c = chain_of(shape);
            if (ours.n > 0)
                fprintf(f, "%s,%s,%s,%g,%g,%d,%.6g,%.3g,%.6g\n", FACTS[i].name, FACTS[i].unit,
                        c.name, c.aspect, c.density, ours.n, ours.mean, ours.half, thesis.mean);
        }
    return output_close(f);
}

static int write_runs(const aspect_study *s) {
    FILE *f =
        output_table(s->to.data, "runs.csv", "shape,setting,space,variant,replicate,fact,value");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++)
        for (int k = 0; k < FACT_COUNT && s->cases[i].ran; k++) {
            const aspect_case *c = &s->cases[i];
            fprintf(f, "%s,%s,%d,%d,%d,%s,%.6g\n", c->chain.name,
                    c->setting == THESIS ? "thesis" : "cheap", c->in_space ? 3 : 2, c->variant,
                    c->replicate + 1, FACTS[k].name, FACTS[k].of(c));
        }
    return output_close(f);
}

static const char *unit_of(fact *of) {
    for (int k = 0; k < FACT_COUNT; k++)
        if (FACTS[k].of == of) return FACTS[k].unit;
    return "";
}

/* The same facts at the setting of the source and at the cheaper one, which has replicates: is the
 * source's run one that another replicate could be? */
static int write_settings(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "settings.csv", "group,fact,unit,aspect,thesis,cheap,apart");
    if (!f) return 4;
    for (int i = 0; i < SETTING_FACT_COUNT && s->size->replicates[CHEAP] > 1; i++)
        for (int shape = 0; shape < MAIN_SHAPES; shape++) {
            fact *of = fact_named(SETTING_FACTS[i].fact);
            interval thesis = at_thesis(s, shape, of), cheap = over(s, shape, of);
            if (thesis.n == 0 || cheap.n < 2) continue;
            char text[60];
            interval_text(&cheap, text, sizeof text);
            fprintf(f, "both,%s,%s,%d,%.4g,%s,%s\n", SETTING_FACTS[i].fact, unit_of(of), shape + 1,
                    thesis.mean, text, stands_apart(cheap, thesis.mean) ? "yes" : "no");
        }
    return output_close(f);
}

static int write_trends(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "trends.csv", "group,fact,unit,slope,p,p_steps");
    if (!f) return 4;
    for (int i = 0; i < FACT_COUNT; i++) {
        trend t = trend_of(s, FACTS[i].of);
        if (!isfinite(t.p)) continue;
        char text[60];
        interval_text(&t.slope, text, sizeof text);
        fprintf(f, "all,%s,%s,%s,%.2g,%.2g\n", FACTS[i].name, FACTS[i].unit, text, t.p, t.p_steps);
    }
    return output_close(f);
}

/* What tells shape from roughness. */
static int write_contrasts(const aspect_study *s) {
    static const struct {
        const char *fact;
        bool relative;
    } SHOWN[] = {{"solid fraction", true},
                 {"co-ordination number", true},
                 {"rate", true},
                 {"fluctuation of the rate", true},
                 {"energy ratio", false}};
    FILE *f = output_table(s->to.data, "contrasts.csv", "fact,contrast,varied,runs,change,p");
    if (!f) return 4;
    for (size_t i = 0; i < sizeof SHOWN / sizeof *SHOWN; i++)
        for (int k = 0; k < CONTRAST_COUNT; k++) {
            contrasted c =
                contrast_of(s, &CONTRASTS[k], fact_named(SHOWN[i].fact), SHOWN[i].relative);
            if (!isfinite(c.half)) continue;
            char text[60];
            interval change = {c.change, NAN, c.half, c.a.n};
            interval_text(&change, text, sizeof text);
            fprintf(f, "%s,%s,%s,%d and %d,%s%s,%.2g\n", SHOWN[i].fact, CONTRASTS[k].name,
                    CONTRASTS[k].what, c.a.n, c.b.n, text, SHOWN[i].relative ? " %" : "", c.p);
        }
    return output_close(f);
}

/* s of processor time; NAN where a run was done in pieces. */
static int write_costs(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "costs.csv",
                           "shape,setting,space,variant,replicate,bed_s,rest_s,flow_s");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++) {
        const aspect_case *c = &s->cases[i];
        if (c->ran)
            fprintf(f, "%s,%s,%d,%d,%d,%.4g,%.4g,%.4g\n", c->chain.name,
                    c->setting == THESIS ? "thesis" : "cheap", c->in_space ? 3 : 2, c->variant,
                    c->replicate + 1, jobs_processor_time(&s->beds[i]),
                    c->in_space ? 0 : jobs_processor_time(&s->rests[i]),
                    jobs_processor_time(&s->flows[i]));
    }
    return output_close(f);
}

static int write_moments(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "moments.csv",
                           "group,aspect,skewness,skewness_source,kurtosis,kurtosis_source");
    static const double SKEWNESS[] = {-3.20, -3.09, -2.28, -2.69}; /* A00 Table 5.2 */
    static const double KURTOSIS[] = {9.95, 12.34, 12.59, 13.16};
    if (!f) return 4;
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        char skewness[60], kurtosis[60];
        interval a = over(s, shape, fact_named("skewness"));
        interval b = over(s, shape, fact_named("kurtosis"));
        interval_text(&a, skewness, sizeof skewness);
        interval_text(&b, kurtosis, sizeof kurtosis);
        if (a.n > 0)
            fprintf(f, "all,%d,%s,%.2f,%s,%.2f\n", shape + 1, skewness, SKEWNESS[shape], kurtosis,
                    KURTOSIS[shape]);
    }
    return output_close(f);
}

/* ---- variants -------------------------------------------------------------------------------- */

/* With a star where a single run lies outside of what one more replicate would lie in. */
static void put(FILE *f, interval ours, interval replicates) {
    char text[60];
    interval_text(&ours, text, sizeof text);
    if (ours.n == 1)
        fprintf(f, ",%.4g%s", ours.mean, stands_apart(replicates, ours.mean) ? " *" : "");
    else
        fprintf(f, ",%s", text);
}

static void write_variant(FILE *f, const aspect_study *s, const char *assumption, const char *name,
                          int of_variant, int shape) {
    static const char *const SHOWN[] = {"solid fraction", "co-ordination number",
                                        "rate",           "shear angle",
                                        "energy ratio",   "heap slope at 1.4 s"};
    interval first = of_variant ? over_variant(s, of_variant, fact_named("rate"))
                                : over(s, shape, fact_named("rate"));
    if (first.n == 0) return;
    fprintf(f, "aspect %s,%s,%s,%d", chain_of(shape).name, assumption, name, first.n);
    for (size_t i = 0; i < sizeof SHOWN / sizeof *SHOWN; i++)
        put(f,
            of_variant ? over_variant(s, of_variant, fact_named(SHOWN[i]))
                       : over(s, shape, fact_named(SHOWN[i])),
            over(s, shape, fact_named(SHOWN[i])));
    fprintf(f, "\n");
}

static int write_variants(const aspect_study *s) {
    FILE *f =
        output_table(s->to.data, "variants.csv",
                     "group,assumption,variant,n,solid_fraction,coordination,rate,angle,ratio,"
                     "heap");
    if (!f) return 4;
    for (int shape = 0; shape < MAIN_SHAPES && s->size->variants > 0; shape++) {
        write_variant(f, s, "baseline", "", 0, shape);
        for (int v = 1; v < VARIANT_COUNT; v++)
            if (VARIANTS[v].shape == shape)
                write_variant(f, s, VARIANTS[v].assumption, VARIANTS[v].name, v, shape);
    }
    return output_close(f);
}

static int write_in_space(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "space.csv",
                           "group,aspect,replicate,particles,spheres,solid_fraction,coordination,"
                           "rate,delay,ratio");
    if (!f) return 4;
    for (int i = 0; i < s->count; i++) {
        const aspect_case *c = &s->cases[i];
        if (c->ran && c->in_space)
            fprintf(f, "all,%s,%d,%d,%d,%.4f,%.3f,%.2f,%.3f,%.2f\n", c->chain.name,
                    c->replicate + 1, c->count, c->count * c->chain.spheres, c->bed.phi,
                    c->bed.coordination, c->flow.rate, c->flow.delay, c->flow.ratio_all);
    }
    return output_close(f);
}

/* ---- one run of each shape in time ----------------------------------------------------------- */

static void write_consolidation(FILE *f, const aspect_case *c) {
    results *r = run_open(c->bed_folder);
    const double *t = run_column(r, "time_s"), *z = run_column(r, "z_bodies");
    const double *force = run_column(r, "floor_force_z_N");
    for (size_t i = 0; i < results_rows(r); i++)
        fprintf(f, "%s,%.4g,%.4g,%.5g\n", c->chain.name, t[i], z[i], -force[i] / c->bed.weight);
    results_free(r);
}

static void write_discharge(FILE *f, const aspect_case *c) {
    results *r = run_open(c->flow_folder);
    const double *t = run_column(r, "time_s"), *out = run_column(r, "out_count");
    for (size_t i = 0; i < results_rows(r); i++)
        fprintf(f, "%s,%s,%d,%.4g,%.5g\n", c->chain.name, c->setting == THESIS ? "thesis" : "cheap",
                c->replicate + 1, t[i], 100 * out[i] / c->count);
    results_free(r);
}

static void write_ratios(FILE *f, const aspect_case *c) {
    results *r = run_open(c->flow_folder);
    for (size_t i = 1; i < results_frames(r); i++) {
        frame *now = results_frame(r, i);
        CLAST_ASSERT(now);
        ratio_at at = ratios_of(now, c);
        fprintf(f, "%s,%.4g", c->chain.name, now->time);
        for (int k = 0; k <= REGIONS; k++) fprintf(f, ",%.4g", log10(at.summed[k]));
        fprintf(f, "\n");
        frame_free(now);
    }
    results_free(r);
}

static void write_walls(FILE *f, const aspect_case *c) {
    results *r = run_open(c->flow_folder);
    const double *t = run_column(r, "time_s");
    for (size_t i = 0; i < results_rows(r) && t[i] <= 0.8; i++)
        for (int k = 0; k < SECTIONS; k++) {
            char name[40];
            snprintf(name, sizeof name, "west_normal_%d_N", k + 1);
            fprintf(f, "%s,%.4g,%d,%.4g\n", c->chain.name, t[i], k + 1, run_column(r, name)[i]);
        }
    results_free(r);
}

static void write_tracks(FILE *f, const aspect_case *c) {
    static track all[TRACKED];
    results *r = run_open(c->flow_folder);
    tracks_of(r, c, all);
    results_free(r);
    for (int k = 0; k < TRACKED; k++)
        for (int i = 0; i < all[k].count; i++)
            fprintf(f, "%s,%d,%d,%.4g,%.5g,%.5g,%.5g,%.4g\n", c->chain.name, k / 3 + 1, k % 3 + 1,
                    all[k].time[i], 100 * all[k].x[i], 100 * all[k].z[i],
                    57.29577951308232 * all[k].angle[i], 100 * all[k].vx[i]);
}

typedef struct timed_table {
    const char *file, *header;
    void (*write)(FILE *f, const aspect_case *c);
} timed_table;

static const timed_table TIMED[] = {
    {"consolidation.csv", "shape,time_s,coordination,force_over_weight", write_consolidation},
    {"discharge.csv", "shape,setting,replicate,time_s,percent", write_discharge},
    {"ratios.csv", "shape,time_s,left,centre,right,all", write_ratios},
    {"walls.csv", "shape,time_s,partition,force_N", write_walls},
    {"tracks.csv", "shape,column,row,time_s,x_cm,z_cm,angle_deg,vx_cm_s", write_tracks},
};

static int write_timed(const aspect_study *s) {
    int bad = 0;
    for (size_t i = 0; i < sizeof TIMED / sizeof *TIMED; i++) {
        FILE *f = output_table(s->to.data, TIMED[i].file, TIMED[i].header);
        if (!f) return 4;
        for (int shape = 0; shape < MAIN_SHAPES; shape++) {
            const aspect_case *c = shown_case(s, shape);
            if (c) TIMED[i].write(f, c);
        }
        bad |= output_close(f);
    }
    return bad;
}

/* ---- profiles -------------------------------------------------------------------------------- */

/* Means over replicates at places along a wall or a floor. */
static interval place_over(const aspect_study *s, int shape, int place, bool heap) {
    double value[REPLICATES_MAX];
    int n = 0;
    for (int k = 0; k < REPLICATES_MAX; k++) {
        const aspect_case *c = case_of(s, shape, CHEAP, 0, k);
        if (c) value[n++] = heap ? c->flow.heap[place] : c->flow.pressure[place];
    }
    return mean_interval(value, n);
}

static int write_pressure(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "pressure.csv",
                           "shape,partition,depth_cm,load_N_m,half,janssen_N_m,K");
    if (!f) return 4;
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        const aspect_case *c = case_of(s, shape, CHEAP, 0, 0);
        for (int k = 0; k < SECTIONS && c; k++) {
            double depth = (SECTIONS - k - 0.5) / SECTIONS * c->bed.height;
            double factor = over(s, shape, fact_named("Janssen K")).mean;
            interval load = place_over(s, shape, k, false);
            fprintf(f, "%s,%d,%.4g,%.5g,%.3g,%.5g,%.3f\n", c->chain.name, k + 1, 100 * depth,
                    load.mean, load.half, janssen_load(c, factor, depth), factor);
        }
    }
    return output_close(f);
}

static int write_heaps(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "heaps.csv", "shape,x_cm,height_cm,half");
    if (!f) return 4;
    for (int shape = 0; shape < MAIN_SHAPES; shape++)
        for (int k = 0; k < HEAP_BINS && case_of(s, shape, CHEAP, 0, 0); k++) {
            interval top = place_over(s, shape, k, true);
            fprintf(f, "%s,%.4g,%.5g,%.3g\n", chain_of(shape).name,
                    100 * (2 * (k + 0.5) / HEAP_BINS - 1) * s->size->half_width, 100 * top.mean,
                    100 * top.half);
        }
    return output_close(f);
}

static int write_angles(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "angles.csv", "shape,replicate,time_s,angle_deg");
    if (!f) return 4;
    for (int shape = 0; shape < MAIN_SHAPES; shape++)
        for (int r = 0; r < REPLICATES_MAX; r++) {
            const aspect_case *c = case_of(s, shape, CHEAP, 0, r);
            for (int k = 0; k < SHEAR_TIMES && c; k++)
                fprintf(f, "%s,%d,%g,%.4g\n", c->chain.name, r + 1, SHEAR_AT[k], c->flow.angle[k]);
        }
    return output_close(f);
}

static int write_subcontacts(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "subcontacts.csv", "shape,points,percent");
    if (!f) return 4;
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        const aspect_case *c = shown_case(s, shape);
        for (int k = 0; k < SUBCONTACTS && c; k++)
            fprintf(f, "%s,%d,%.3g\n", c->chain.name, k + 1, 100 * c->bed.subcontacts[k]);
    }
    return output_close(f);
}

/* ---- all ------------------------------------------------------------------------------------- */

static int write_about(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "about.txt", "study=aspect-ratio-hopper");
    if (!f) return 4;
    uint64_t hash = 0;
    double worst = 0;
    for (int i = 0; i < s->count; i++) {
        hash = hash * UINT64_C(0x100000001b3) ^ s->flows[i].hash;
        if (s->cases[i].ran) worst = fmax(worst, s->cases[i].flow.residual);
    }
    const int *n = s->size->replicates;
    fprintf(f, "size=%s\nreplicates=%d + %d cheaper\n", s->size->name, n[THESIS], n[CHEAP]);
    fprintf(f, "particles=%d\nspheres_per_particle=1; 2; 3; 4\nworst_residual=%.2g\n",
            s->size->count, worst);
    fprintf(f, "width_cm=%g\nshown=%s\nhash=0x%016llx\nengine=%s\n", 200 * s->size->half_width,
            n[THESIS] > 0 ? "10 µs and 3.5 GPa" : "25 µs and 0.35 GPa", (unsigned long long)hash,
            CLAST_VERSION);
    return output_close(f);
}

int aspect_write_tables(const aspect_study *s) {
    CLAST_ASSERT(s);
    int bad = write_facts(s) | write_runs(s) | write_settings(s) | write_moments(s);
    bad |= write_trends(s) | write_contrasts(s) | write_costs(s);
    bad |= write_variants(s) | write_in_space(s) | write_timed(s) | write_pressure(s);
    bad |= write_heaps(s) | write_angles(s) | write_subcontacts(s) | write_about(s);
    return bad ? 4 : 0;
}
