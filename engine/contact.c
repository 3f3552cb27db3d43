/* contact.c - runs the contact kernel over all blocks and adds up what the threads found. */
#include <string.h>

#include "engine/geometry.h"
#include "engine/parallel.h"

contact_kernel contact_kernel_baseline, contact_kernel_avx2, contact_kernel_avx512;

static bool has_avx512(void) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
}

/* A wish that the processor cannot fulfil falls back to the next best. */
void contacts_choose_kernel(clast_world *w) {
    clast_isa wish = w->def.isa == CLAST_ISA_AUTO ? CLAST_ISA_AVX512 : w->def.isa;
    if (wish == CLAST_ISA_AVX512 && has_avx512()) {
        w->kernel = contact_kernel_avx512, w->isa_name = "avx512";
    } else if (wish >= CLAST_ISA_AVX2 && __builtin_cpu_supports("avx2")) {
        w->kernel = contact_kernel_avx2, w->isa_name = "avx2";
    } else {
        w->kernel = contact_kernel_baseline, w->isa_name = "baseline";
    }
}

static void run_blocks(void *context, size_t begin, size_t end, int thread) {
    clast_world *w = context;
    w->kernel(w, begin, end, &w->tallies[thread]);
}

static void clear_tallies(clast_world *w) {
    memset(w->tally_work, 0, (size_t)w->threads * (size_t)w->part_count * sizeof *w->tally_work);
    for (int t = 0; t < w->threads; t++)
        w->tallies[t] = (contact_tally){.part_work = w->tally_work + t * w->part_count};
}

/* The sums are exact, so the order of the threads does not matter; the totals grow step by step. */
static void add_tallies(clast_world *w) {
    exact_sum elastic = {0, 0}, dashpot = {0, 0};
    size_t contacts = 0;
    double overlap = 0;
    for (int t = 0; t < w->threads; t++) {
        const contact_tally *tally = &w->tallies[t];
        sum_merge(&elastic, &tally->elastic);
        sum_merge(&dashpot, &tally->dashpot);
        contacts += tally->contacts;
        overlap = tally->overlap_max > overlap ? tally->overlap_max : overlap;
    }
    w->ledger.elastic += sum_value(&elastic);
    w->ledger.dashpot += sum_value(&dashpot);
    double all_parts = 0;
    for (int p = 0; p < w->part_count; p++) {
        exact_sum work = {0, 0};
        for (int t = 0; t < w->threads; t++) sum_merge(&work, &w->tallies[t].part_work[p]);
        w->parts[p].work_total += sum_value(&work);
        all_parts += sum_value(&work);
    }
    w->ledger.wall_work += all_parts;
    w->ledger.wall_input += fabs(all_parts);
    w->counters.contacts = contacts;
    w->overlap_now = overlap;
    if (overlap > w->counters.overlap_max) w->counters.overlap_max = overlap;
}

void contacts_evaluate(clast_world *w) {
    clear_tallies(w);
    parallel_for(w->threads, w->list.block_count, run_blocks, w);
    add_tallies(w);
}

/* Sums per pair from stored histories, with the bits of the evaluation that stored them. */
void contacts_restore(clast_world *w) {
    pair_list *l = &w->list;
    for (size_t p = 0; p < l->pair_count; p++) {
        l->forces[p] = (pair_force){0};
        for (size_t c = l->pairs[p].first; c < l->pairs[p + 1].first; c++) {
            if (!l->candidates.touching[c]) continue;
            touch t = touch_of(w, &l->pairs[p], c);
            pair_force_add(&l->forces[p], &t, l->candidates.histories[c].force);
        }
    }
}

stored_energy contact_stored_energy(const clast_world *w, const pair *p, size_t c) {
    const pair_coef *k = &w->coefs[p->coef];
    const history *h = &w->list.candidates.histories[c];
    double s2 = v3_dot(h->spring, h->spring), d = h->overlap;
    if (w->def.law == CLAST_LAW_LINEAR)
        return (stored_energy){0.5 * k->stiffness * d * d, 0.5 * s2 / k->tangential};
    double a = sqrt(w->list.candidates.radius[c] * d);
    return (stored_energy){8.0 / 15.0 * k->e_star * a * d * d, 0.5 * s2 / (8 * k->g_star * a)};
}

stored_energy contacts_stored_energy(const clast_world *w) {
    const pair_list *l = &w->list;
    exact_sum normal = {0, 0}, tangential = {0, 0};
    for (size_t p = 0; p < l->pair_count; p++)
        for (size_t c = l->pairs[p].first; c < l->pairs[p + 1].first; c++) {
            if (!l->candidates.touching[c]) continue;
            stored_energy e = contact_stored_energy(w, &l->pairs[p], c);
            sum_add(&normal, &w->ledger.scale, e.normal);
            sum_add(&tangential, &w->ledger.scale, e.tangential);
        }
    return (stored_energy){sum_value(&normal), sum_value(&tangential)};
}
