/* run.h - runs a scene and writes its results: one folder per run.
 *
 *     char *faults;
 *     scene *s = scene_load("hopper.yaml", &(scene_options){0}, &faults);
 *     run_report r = run_scene(s, &(run_options){.out = "build/hopper", .talk = RUN_SILENT});
 *     if (r.end != RUN_DONE) fputs(r.message, stderr);
 *
 * README.md of this folder lists the files. results.h reads them back.
 */
#ifndef CLAST_RUN_H
#define CLAST_RUN_H

#include "experiments/scene/scene.h"

typedef enum run_end {
    RUN_DONE,  /* came to its latest time or to rest */
    RUN_GUARD, /* the engine stopped it: failed.h5 holds the state, checkpoint.h5 the last good one
                */
    RUN_INTERRUPTED,  /* SIGINT or SIGTERM: everything is saved, `resume` goes on */
    RUN_WRITE_FAILED, /* disk full, no permission: what was written before stays readable */
    RUN_MISMATCH,     /* `resume` in the folder of another scene */
    RUN_UNREADABLE,   /* `resume` from a damaged checkpoint */
    RUN_REFUSED       /* the folder holds something and neither `resume` nor `force` was said, or
                          another run is writing into it */
} run_end;

typedef enum run_talk {
    RUN_TALK,  /* what was picked, progress, timers, hash */
    RUN_QUIET, /* the hash alone */
    RUN_SILENT /* nothing on stdout: for studies that run many */
} run_talk;

typedef struct run_options {
    const char *out; /* folder; made when missing, its parents too */
    bool resume;     /* go on from the folder's checkpoint; from the start when there is none */
    bool force;      /* throw an earlier run in the folder away (its own files only) */
    double until;    /* s; > 0 takes the place of the scene's latest time */
    run_talk talk;
} run_options;

typedef struct run_report {
    run_end end;
    bool at_rest; /* ended because nothing moved */
    double time;  /* s, simulated */
    uint64_t steps, hash;
    double seconds;     /* s, of this process for this run */
    double residual;    /* of the energy put in */
    char message[4096]; /* what went wrong: what, who, where, when; "" after RUN_DONE */
} run_report;

/* Runs the scene to its end. Catches SIGINT and SIGTERM meanwhile; a second one kills. One run at a
 * time in a process (signals, HDF5): studies run replicates as processes. */
run_report run_scene(scene *s, const run_options *options);

/* True when `folder` holds a run that came to its end; then *hash is that of its last state. Lets a
 * study keep what an earlier start has finished. */
bool run_is_finished(const char *folder, uint64_t *hash);

#endif
