/* tables.c - the data folder: plain CSV that the figures are drawn from (figures/README.md). */
#include <math.h>
#include <stdio.h>

#include "engine/clast.h"
#include "experiments/button-hopper/hopper.h"
#include "experiments/run/results.h"
#include "experiments/study/output.h"

static results *open_run(const hopper_run *r) {
    char why[RESULTS_ERROR_MAX];
    results *open = results_open(r->folder, why);
    if (!open) fprintf(stderr, "%s: %s\n", r->folder, why);
    return open;
}

/* ---- the button ------------------------------------------------------------------------------ */

static int write_profile(const hopper_study *s) {
    FILE *f = output_table(s->data, "profile.csv", "kind,x_cm,z_cm,r_cm");
    if (!f) return 4;
    for (int i = 0; i <= 360; i++) {
        double sine, cosine;
        clast_sincos(i * (3.14159265358979323846 / 180), &sine, &cosine);
        fprintf(f, "outline,%.6f,%.6f,0\n", BUTTON_A_CM * cosine, BUTTON_B_CM * sine);
    }
    clast_vec3 centre[7];
    double radius[7];
    clast_fit_ellipse(BUTTON_A_CM, BUTTON_B_CM, 7, centre, radius);
    for (int i = 0; i < 7; i++) fprintf(f, "sphere,%.6f,0,%.6f\n", centre[i].x, radius[i]);
    return output_close(f);
}

/* ---- one line per sample --------------------------------------------------------------------- */

static int write_cumulative(const hopper_study *s) {
    FILE *f = output_table(s->data, "cumulative.csv",
                           "fill,orifice_cm,replicate,time_s,mass_g,number,"
                           "solid_fraction,bulk_density_g_cm2");
    if (!f) return 4;
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *h = &s->runs[i];
        results *r = h->ran ? open_run(h) : NULL;
        if (!r) continue;
        const double *t = results_series(r, "time_s"), *kg = results_series(r, "out_kg"),
                     *n = results_series(r, "out_count"), *phi = results_series(r, "bed_fraction"),
                     *rho = results_series(r, "bed_bulk_kg_per_m2");
        for (size_t k = 0; k < results_rows(r); k += 2)
            fprintf(f, "%s,%g,%d,%.4f,%.3f,%g,%.5f,%.5f\n", FILL_NAME[h->fill],
                    ORIFICE_CM[h->orifice], h->replicate + 1, t[k], 1000 * kg[k], n[k], phi[k],
                    0.1 * rho[k]);
        results_free(r);
    }
    return output_close(f);
}

static int write_rates(const hopper_study *s) {
    FILE *f =
        output_table(s->data, "rates.csv",
                     "fill,orifice_cm,replicate,q_g_s,from_s,to_s,blocked,left,"
                     "solid_fraction_rest,solid_fraction_flow,bulk_density_flow_g_cm2,c_per_cm,"
                     "arches,longest_arch_s");
    if (!f) return 4;
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *h = &s->runs[i];
        if (!h->ran) continue;
        fprintf(f, "%s,%g,%d,%.3f,%.4f,%.4f,%d,%d,%.5f,%.5f,%.5f,%.4f,%d,%.4f\n",
                FILL_NAME[h->fill], ORIFICE_CM[h->orifice], h->replicate + 1, h->rate[0],
                h->steady.from, h->steady.to, h->blocked, h->left, h->phi_rest, h->phi_flow,
                h->rho_flow, h->c, h->arch_count, h->pause.length);
    }
    return output_close(f);
}

/* ---- one line per orifice -------------------------------------------------------------------- */

static int write_summary(const hopper_study *s, const hopper_summary *m,
                         const hopper_published *p) {
    FILE *f = output_table(s->data, "summary.csv",
                           "fill,orifice_cm,n,blocked,q_mean,q_half,q_experiment,"
                           "q_thesis,rho_mean,rho_half,rho_experiment,rho_thesis,phi_mean,phi_half,"
                           "c_mean,c_half,c_experiment,c_thesis");
    if (!f) return 4;
    for (int fill = 0; fill < FILLS; fill++)
        for (int d = 0; d < ORIFICES; d++) {
            const hopper_mean *h = &m->mean[fill][d];
            if (h->runs == 0) continue;
            fprintf(f, "%s,%g,%d,%d,%.3f,%.3f,%g,%g,%.5f,%.5f,%g,%g,%.5f,%.5f,%.4f,%.4f,%g,%g\n",
                    FILL_NAME[fill], ORIFICE_CM[d], h->q.n, h->blocked, h->q.mean, h->q.half,
                    p->q_experiment[d], p->q_thesis[d], h->rho.mean, h->rho.half,
                    p->rho_experiment[d], p->rho_thesis[d], h->phi.mean, h->phi.half, h->c.mean,
                    h->c.half, p->c_experiment[d], p->c_thesis[d]);
        }
    return output_close(f);
}

static void write_fit(FILE *f, const char *set, const beverloo *b) {
    fprintf(f, "%s,%.6f,%.6f,%.4f,%.4f,%.4f\n", set, b->fit.slope, b->fit.intercept, b->kd, b->k,
            b->kd_half);
}

static int write_beverloo(const hopper_study *s, const hopper_summary *m,
                          const hopper_published *p) {
    FILE *f = output_table(s->data, "beverloo.csv", "set,slope,intercept,kd_cm,k,kd_half");
    if (!f) return 4;
    beverloo experiment = beverloo_fit(ORIFICE_CM, p->q_experiment, ORIFICES, BUTTON_DIAMETER);
    beverloo thesis = beverloo_fit(ORIFICE_CM, p->q_thesis, ORIFICES, BUTTON_DIAMETER);
    write_fit(f, "ours", &m->fit);
    write_fit(f, "experiment", &experiment);
    write_fit(f, "thesis", &thesis);
    return output_close(f);
}

/* ---- velocities ------------------------------------------------------------------------------ */

static int write_velocity_samples(const hopper_study *s) {
    FILE *f = output_table(s->data, "velocity_samples.csv", "orifice_cm,replicate,x_cm,v_m_s");
    if (!f) return 4;
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *h = &s->runs[i];
        if (!h->ran || h->fill != FRICTIONLESS) continue;
        for (int k = 0; k < h->velocity_count; k++)
            fprintf(f, "%g,%d,%.4f,%.5f\n", ORIFICE_CM[h->orifice], h->replicate + 1,
                    h->velocity_x[k], h->velocity[k]);
    }
    return output_close(f);
}

static int write_velocity_fits(const hopper_study *s, const hopper_summary *m) {
    FILE *f = output_table(s->data, "velocity_fit.csv",
                           "orifice_cm,set,v0_m_s,b_cm,b_over_d,b_half_cm,mean_m_s,sd_m_s");
    if (!f) return 4;
    for (int d = 0; d < ORIFICES; d++) {
        const hopper_profile *p = &m->profile[d];
        if (p->mean.n == 0) continue;
        fprintf(f, "%g,centre,%.4f,%.4f,%.4f,,%.4f,%.4f\n", ORIFICE_CM[d], p->v0, p->pooled_b_cm,
                p->pooled_b_cm / BUTTON_DIAMETER, p->mean.mean, p->sd.mean);
        fprintf(f, "%g,free,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\n", ORIFICE_CM[d], p->free.v0, p->free.b,
                p->free.b / BUTTON_DIAMETER, p->free.b_half, p->mean.mean, p->sd.mean);
    }
    return output_close(f);
}

/* ---- the free surface ------------------------------------------------------------------------ */

static void write_surface_of(FILE *f, const hopper_run *h, const results *r) {
    const double *t = results_series(r, "time_s");
    double next = 0;
    for (size_t k = 0; k < results_rows(r) && t[k] < 1.01; k++) {
        if (t[k] < next - 1e-9) continue;
        next += VIDEO_FRAME_S;
        for (int i = 0; i < 10; i++) {
            char name[40];
            snprintf(name, sizeof name, "bed_height_%d_m", i + 1);
            fprintf(f, "%g,%d,%.3f,%d,%.3f,%.3f\n", ORIFICE_CM[h->orifice], h->replicate + 1, t[k],
                    i + 1, BIN_WIDTH_CM * ((i + 0.5) / 10 - 0.5), 100 * results_series(r, name)[k]);
        }
    }
}

static int write_surface(const hopper_study *s) {
    FILE *f =
        output_table(s->data, "surface.csv", "orifice_cm,replicate,time_s,section,x_cm,height_cm");
    if (!f) return 4;
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *h = &s->runs[i];
        results *r = h->ran && h->fill == FRICTIONLESS ? open_run(h) : NULL;
        if (!r) continue;
        write_surface_of(f, h, r);
        results_free(r);
    }
    return output_close(f);
}

/* ---- sensitivity and what it was made with --------------------------------------------------- */

static int write_sensitivity(const hopper_study *s, const hopper_sensitivity *v) {
    if (v->count == 0) return 0;
    FILE *f = output_table(s->data, "sensitivity.csv",
                           "assumption,variant,baseline,orifice_cm,n,q_mean,q_half,"
                           "q_baseline,change_percent,blocked,rest_mean,rest_half");
    if (!f) return 4;
    double base = NAN;
    for (int i = 0; i < v->count; i++) {
        const hopper_variant *h = &v->variants[i];
        if (i == 0 || h->orifice != v->variants[i - 1].orifice) base = h->q.mean;
        fprintf(f, "%s,\"%s\",%s,%g,%d,%.3f,%.3f,%.3f,%.2f,%d,%.4f,%.4f\n", h->assumption,
                h->variant, v->variants[0].variant, ORIFICE_CM[h->orifice], h->q.n, h->q.mean,
                h->q.half, base, 100 * (h->q.mean / base - 1), h->blocked, h->rest.mean,
                h->rest.half);
    }
    return output_close(f);
}

static int write_about(const hopper_study *s, const hopper_summary *m) {
    FILE *f = output_table(s->data, "about.txt", "study=button-hopper");
    if (!f) return 4;
    uint64_t hash = 0;
    for (int i = 0; i < s->flow_count; i++) hash = (hash * 31) ^ s->flows[i].hash;
    fprintf(f, "size=%s\nreplicates=%d frictionless, %d frictional\nhash=0x%016llx\nengine=%s\n",
            s->size->name, s->size->replicates[0], s->size->replicates[1], (unsigned long long)hash,
            CLAST_VERSION);
    fprintf(f, "step=%s\nparticles=%d\nspheres_per_particle=7\nworst_residual=%.2e\nwall_s=%.0f\n",
            s->size->step, BUTTONS, m->worst_residual, s->seconds);
    fprintf(f,
            "mean_error_percent=%.2f\nmean_error_half=%.2f\nkd_cm=%.3f\nrest_frictionless=%.4f\n"
            "rest_frictional=%.4f\n",
            m->error_percent.mean, m->error_percent.half, m->fit.kd, m->rest[FRICTIONLESS].mean,
            m->rest[FRICTIONAL].mean);
    return output_close(f);
}

int hopper_write_tables(const hopper_study *s, const hopper_summary *m, const hopper_published *p,
                        const hopper_sensitivity *v) {
    int bad = write_profile(s) | write_cumulative(s) | write_rates(s) | write_summary(s, m, p);
    bad |= write_beverloo(s, m, p) | write_velocity_samples(s) | write_velocity_fits(s, m);
    bad |= write_surface(s) | write_sensitivity(s, v) | write_about(s, m);
    return bad ? 4 : 0;
}
