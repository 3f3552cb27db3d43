/* plan.c - which runs each size is made of. The orifices of a replicate start from the same bed, so
 * that what differs between them is the orifice. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "experiments/button-hopper/hopper.h"

const double ORIFICE_CM[ORIFICES] = {5, 6.5, 7.5, 8.5, 10};
const char *const FILL_NAME[FILLS] = {"frictionless", "frictional"};

static const hopper_size SIZES[] = {
    {"quick", {1, 0}, {false, false, true, false, true}, "4.5 us", "0.8 s", 0},
    {"brief", {5, 1}, {true, true, true, true, true}, "2.3 us", "1.5 s", 2},
    {"published", {5, 1}, {true, true, true, true, true}, "2.3 us", "1.5 s", 4},
    {"full", {20, 20}, {true, true, true, true, true}, "2.3 us", "1.5 s", 20},
};

const hopper_size *hopper_size_named(const char *name) {
    for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; i++)
        if (!strcmp(SIZES[i].name, name)) return &SIZES[i];
    return NULL;
}

/* A00 4.3.2.1: with friction 0.2 and the least distance between particles; or without friction and
 * more space between them (the widest grid that fits the 60 cm sheets). */
static void plan_bed(job *j, const hopper_size *size, int fill, int replicate) {
    j->scene = SCENES "/fill.yaml";
    snprintf(j->label, sizeof j->label, "%s-%02d", FILL_NAME[fill], replicate + 1);
    job_set(j, "seed=%d", 1 + replicate);
    job_set(j, "friction=%s", fill == FRICTIONAL ? "0.2" : "0");
    job_set(j, "wall_friction=%s", fill == FRICTIONAL ? "0.2" : "0");
    job_set(j, "columns=%d", fill == FRICTIONAL ? 10 : 8);
    job_set(j, "step=%s", size->step);
    job_set(j, "settle=%s", size->settle);
}

/* The first replicate of the widest orifice is the one that is animated. */
static void plan_flow(job *j, const hopper_study *s, const hopper_run *r) {
    j->scene = SCENES "/discharge.yaml";
    snprintf(j->label, sizeof j->label, "%s-%02d-%.1fcm", FILL_NAME[r->fill], r->replicate + 1,
             ORIFICE_CM[r->orifice]);
    job_set(j, "bed=%s", s->beds[r->bed].folder);
    job_set(j, "orifice=%g cm", ORIFICE_CM[r->orifice]);
    job_set(j, "step=%s", s->size->step);
    bool animated = r->fill == FRICTIONLESS && r->replicate == 0 && r->orifice == ORIFICES - 1;
    if (animated) job_set(j, "frame_every=10 ms");
}

static void *list(size_t count, size_t size) {
    void *p = calloc(count + 1, size);
    if (!p) abort();
    return p;
}

void hopper_plan(hopper_study *s) {
    int beds = s->size->replicates[0] + s->size->replicates[1];
    s->beds = list((size_t)beds, sizeof *s->beds);
    s->flows = list((size_t)beds * ORIFICES, sizeof *s->flows);
    s->runs = list((size_t)beds * ORIFICES, sizeof *s->runs);
    for (int fill = 0; fill < FILLS; fill++)
        for (int k = 0; k < s->size->replicates[fill]; k++) {
            int bed = s->bed_count++;
            plan_bed(&s->beds[bed], s->size, fill, k);
            jobs_name(&s->beds[bed], s->root);
            for (int d = 0; d < ORIFICES; d++) {
                if (!s->size->orifice[d]) continue;
                hopper_run *r = &s->runs[s->flow_count];
                *r = (hopper_run){.fill = fill, .orifice = d, .replicate = k, .bed = bed};
                job *j = &s->flows[s->flow_count++];
                plan_flow(j, s, r);
                jobs_name(j, s->root);
                r->folder = j->folder;
            }
        }
}

int hopper_run_all(hopper_study *s) {
    int failed = jobs_run(s->beds, s->bed_count, s->processes, "filling");
    failed += jobs_run(s->flows, s->flow_count, s->processes, "discharge");
    for (int i = 0; i < s->flow_count; i++) s->runs[i].ran = s->flows[i].done;
    return failed;
}
