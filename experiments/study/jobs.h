/* jobs.h - many runs of scenes side by side, each in a process of its own, kept from one start of
 * the program to the next.
 *
 * A run's folder is named by the hash of its scene file, its parameters and the engine (digest.h):
 * what has been run is not run again, and any change of any of the three makes a new folder. A run
 * that was cut off goes on from its last checkpoint. Folders are never committed.
 */
#ifndef CLAST_STUDY_JOBS_H
#define CLAST_STUDY_JOBS_H

#include <stdbool.h>
#include <stdint.h>

enum { JOB_SETTINGS = 16, JOB_TEXT = 400, JOB_FOLDER = 700 };

typedef struct job {
    const char *scene;                /* path of the YAML file */
    char label[80];                   /* for people: begins the folder's name */
    char set[JOB_SETTINGS][JOB_TEXT]; /* "name=value" */
    int set_count;
    bool quiet;              /* what failed is in <folder>.log alone */
    char folder[JOB_FOLDER]; /* filled by jobs_name() */
    bool done;               /* filled by jobs_run() */
    uint64_t hash;           /* of the last state, when done */
    double seconds;          /* of processor time that jobs_run() spent on it; 0 when it was kept */
} job;

/* s of processor time of a whole run, kept beside its folder; NAN when it was done in pieces or is
 * not done. */
double jobs_processor_time(const job *j);

/* Adds a parameter; printf style. */
void job_set(job *j, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Names the folder of a job below `root`. Call when all parameters are set. */
void jobs_name(job *j, const char *root);

/* Runs what is not finished yet, at most `processes` at a time, with a line of progress. Returns
 * the number of jobs that failed; their messages go to stderr and stay in <folder>.log. `what`
 * NULL: no progress. 0 processes: nothing is started, `done` says what there is. */
int jobs_run(job *jobs, int count, int processes, const char *what);

/* Number of processors to use: CLAST_JOBS, else all of this machine. */
int jobs_processes(void);

#endif
