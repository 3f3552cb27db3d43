/* parallel.c - a crew of threads that wait for work: a short while on their toes, then asleep.
 * OpenMP was tried first: its threads stay on their toes for a millisecond, and where another
 * program wants the processors too, a step of 0.1 ms then takes ten. */
#include "engine/parallel.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

#include "engine/check.h"

enum { TOES = 4000 }; /* looks before a thread goes to sleep: some 20 us */

typedef struct crew {
    pthread_mutex_t one_at_a_time, lock;
    pthread_cond_t work, done;
    int members; /* threads beside the caller */
    parallel_body *body;
    void *context;
    int threads;           /* of the job */
    atomic_uint job;       /* number of the job */
    atomic_int unfinished; /* members that have not finished it */
} crew;

static crew ours = {.one_at_a_time = PTHREAD_MUTEX_INITIALIZER,
                    .lock = PTHREAD_MUTEX_INITIALIZER,
                    .work = PTHREAD_COND_INITIALIZER,
                    .done = PTHREAD_COND_INITIALIZER};

int parallel_max_threads(void) {
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores > 0 ? (int)cores : 1;
}

static void look_again(void) {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

static unsigned wait_for_job(unsigned last) {
    for (int i = 0; i < TOES; i++, look_again())
        if (atomic_load(&ours.job) != last) return atomic_load(&ours.job);
    pthread_mutex_lock(&ours.lock);
    while (atomic_load(&ours.job) == last) pthread_cond_wait(&ours.work, &ours.lock);
    pthread_mutex_unlock(&ours.lock);
    return atomic_load(&ours.job);
}

static void finish(void) {
    if (atomic_fetch_sub(&ours.unfinished, 1) != 1) return;
    pthread_mutex_lock(&ours.lock);
    pthread_cond_signal(&ours.done);
    pthread_mutex_unlock(&ours.lock);
}

/* Thread `number` of every job that has so many, from the job after `last` on. */
typedef struct recruit {
    int number;
    unsigned last;
} recruit;

static void *member(void *argument) {
    recruit r = *(recruit *)argument;
    free(argument);
    for (;;) {
        r.last = wait_for_job(r.last);
        if (r.number < ours.threads) ours.body(ours.context, r.number);
        finish();
    }
    return NULL;
}

static void wait_for_members(void) {
    for (int i = 0; i < TOES; i++, look_again())
        if (atomic_load(&ours.unfinished) == 0) return;
    pthread_mutex_lock(&ours.lock);
    while (atomic_load(&ours.unfinished) > 0) pthread_cond_wait(&ours.done, &ours.lock);
    pthread_mutex_unlock(&ours.lock);
}

static void publish_job(void) {
    pthread_mutex_lock(&ours.lock);
    atomic_store(&ours.unfinished, ours.members);
    atomic_fetch_add(&ours.job, 1);
    pthread_cond_broadcast(&ours.work);
    pthread_mutex_unlock(&ours.lock);
}

/* A child process has the caller's thread alone. */
static void forget_crew(void) {
    ours = (crew){.one_at_a_time = PTHREAD_MUTEX_INITIALIZER,
                  .lock = PTHREAD_MUTEX_INITIALIZER,
                  .work = PTHREAD_COND_INITIALIZER,
                  .done = PTHREAD_COND_INITIALIZER};
}

static void hire(int members) {
    static bool told;
    if (!told) pthread_atfork(NULL, NULL, forget_crew);
    told = true;
    while (ours.members < members) {
        pthread_t thread;
        recruit *r = malloc(sizeof *r);
        CLAST_ASSERT(r);
        *r = (recruit){ours.members + 1, atomic_load(&ours.job)};
        if (pthread_create(&thread, NULL, member, r) != 0) {
            free(r);
            return;
        }
        pthread_detach(thread);
        ours.members++;
    }
}

static void run_alone(int begin, int threads, parallel_body *body, void *context) {
    for (int t = begin; t < threads; t++) body(context, t);
}

/* Another world that is being stepped by another thread has the crew: then this one works alone. */
void parallel_run(int threads, parallel_body *body, void *context) {
    CLAST_ASSERT(threads >= 1);
    if (threads == 1 || pthread_mutex_trylock(&ours.one_at_a_time) != 0) {
        run_alone(0, threads, body, context);
        return;
    }
    hire(threads - 1);
    ours.body = body, ours.context = context, ours.threads = threads;
    publish_job();
    body(context, 0);
    run_alone(ours.members + 1, threads, body, context);
    wait_for_members();
    pthread_mutex_unlock(&ours.one_at_a_time);
}
