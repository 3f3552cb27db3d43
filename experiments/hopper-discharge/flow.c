/* flow.c - one discharge, watched from step to step. Only the engine's steps are timed.
 *
 * A sphere leaves when its centre passes the level of the orifice between the walls, and is through
 * a wall when it is wholly behind it above that level. Energy is added up here: the world holds
 * that of the spheres in it, and those that have fallen out of it took along what they had when
 * last seen, in free fall. Spheres that are gone at the orifice take a part of what their contacts
 * hold: no energy is told then. */
#include <math.h>
#include <time.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"

#define LOOK_EVERY 0.005 /* s, at the energy */
#define HOPELESS   10.0  /* of the bed's energy made: what is left is noise */

const char *const FAILURE_NAME[FAILURES] = {
    "", "through walls", "through a sphere", "Newton's method", "energy", "left inside"};

typedef enum place { INSIDE, OUT, THROUGH } place;

typedef struct watch {
    const flow_plan *plan;
    clast_world *world;
    flow *out;
    hopper_wall wall[HOPPER_WALLS];
    double z[SPHERES], vz[SPHERES]; /* m, m/s, when last seen */
    double energy[SPHERES];         /* J, of motion and height then */
    double left[SPHERES];           /* s, through the orifice */
    place place[SPHERES];
    bool gone[SPHERES];     /* out of the world */
    uint64_t seen[SPHERES]; /* number of the look at which it was there */
    uint64_t looks;
    int inside;               /* spheres */
    double mass, mass_inside; /* kg */
    double start, carried;    /* J: of the world at the start, by spheres that are gone */
    double ground;            /* m, that heights count from */
} watch;

static double processor_time(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- energy ---------------------------------------------------------------------------------- */

static double energy_of_world(clast_world *w) {
    clast_energy e = clast_world_energy(w);
    return e.kinetic + e.rotational + e.gravity + e.elastic;
}

/* What the discharge sets free: height above the orifice, and what the springs hold. */
static double energy_of_bed(clast_world *w, const bed *b) {
    double height = 0;
    for (int i = 0; i < b->count; i++) height += sphere_mass(b->size[i]) * GRAVITY * b->z[i];
    return height + clast_world_energy(w).elastic;
}

static void look_at_energy(watch *o) {
    flow *f = o->out;
    if (o->plan->hopper->solid) return;
    double error = (energy_of_world(o->world) + o->carried - o->start) / f->bed_energy;
    f->energy_error = error;
    if (!(fabs(error) <= f->energy_worst)) f->energy_worst = fabs(error);
    if (!(fabs(error) <= HEATED_AT) && isnan(f->heated)) f->heated = clast_world_time(o->world);
}

/* ---- who is where ---------------------------------------------------------------------------- */

/* A floor ends at the orifice; other walls meet. */
static bool is_over(const hopper_wall *l, double x) {
    return l->nx != 0 || (x >= l->px && x <= l->px + l->length);
}

/* How far a sphere is in a wall, of its radius; 1: its centre is on it, 2: it is wholly behind. */
double wall_overlap(const hopper_wall wall[HOPPER_WALLS], double x, double z, double radius) {
    double least = INFINITY;
    for (int k = 0; k < HOPPER_WALLS; k++)
        if (is_over(&wall[k], x))
            least = fmin(least, (x - wall[k].px) * wall[k].nx + (z - wall[k].pz) * wall[k].nz);
    return 1 - least / radius;
}

static void go(watch *o, int id, place where) {
    o->place[id] = where;
    o->inside--;
    o->mass_inside -= sphere_mass(o->plan->bed->size[id]);
    if (where == OUT) return;
    o->out->through++;
    if (isnan(o->out->first_through)) o->out->first_through = clast_world_time(o->world);
}

/* Straight on from where it was last seen inside to where it is, or would be, below. */
static void leave(watch *o, int id, double z) {
    double dt = o->plan->world.step, part = z < 0 ? o->z[id] / (o->z[id] - z) : 1;
    o->left[id] = clast_world_time(o->world) - dt + part * dt;
    go(o, id, OUT);
}

static void look_at_sphere(watch *o, int id, double x, double z) {
    const hopper *h = o->plan->hopper;
    if (z < 0 && (!h->flat || fabs(x) <= 0.5 * h->orifice)) {
        leave(o, id, z);
        return;
    }
    double radius = sphere_radius(o->plan->bed->size[id]);
    double overlap = wall_overlap(o->wall, x, z, radius);
    if (!(overlap <= o->out->overlap)) o->out->overlap = overlap;
    if (!(overlap <= OVERLAP_LIMIT)) go(o, id, THROUGH);
}

/* Fell out of the world since the last look. Where it is gone below the orifice at once, it was
 * inside until now; what is gone from higher up went over the top. */
static void let_go(watch *o, int id) {
    double below = o->z[id] + o->plan->world.step * o->vz[id];
    o->gone[id] = true;
    o->carried += o->energy[id];
    if (o->place[id] != INSIDE) return;
    if (o->z[id] < o->plan->hopper->funnel)
        leave(o, id, below);
    else
        go(o, id, THROUGH);
}

static void look_at_spheres(watch *o) {
    clast_bodies b = clast_world_bodies(o->world);
    o->looks++;
    for (size_t i = 0; i < b.count; i++) {
        int id = (int)b.id[i];
        if (o->place[id] == INSIDE) look_at_sphere(o, id, b.x[i], b.z[i]);
        double v2 = b.vx[i] * b.vx[i] + b.vz[i] * b.vz[i];
        o->energy[id] = b.mass[i] * (0.5 * v2 + GRAVITY * (b.z[i] - o->ground));
        o->z[id] = b.z[i], o->vz[id] = b.vz[i], o->seen[id] = o->looks;
    }
    for (int id = 0; id < o->plan->bed->count; id++)
        if (!o->gone[id] && o->seen[id] != o->looks) let_go(o, id);
}

/* ---- a step ---------------------------------------------------------------------------------- */

static void count_span(watch *o, double spent) {
    flow *f = o->out;
    if (o->mass_inside < (1 - SPAN_PART) * o->mass) return;
    clast_counters c = clast_world_counters(o->world);
    f->cpu += spent;
    f->span = clast_world_time(o->world);
    f->evaluations = (double)c.force_evaluations;
    f->newton = (double)c.newton_iterations;
    f->linear = (double)c.linear_iterations;
    f->steps = (double)c.steps;
}

static bool fail(watch *o, failure what) {
    o->out->failed = what;
    o->out->stopped = clast_world_time(o->world);
    return false;
}

static bool step(watch *o) {
    double since = processor_time();
    clast_status status = clast_world_step(o->world);
    double spent = processor_time() - since;
    look_at_spheres(o);
    count_span(o, spent);
    if (status && !clast_world_newton(o->world).converged) return fail(o, FAILED_NEWTON);
    if (status) return fail(o, FAILED_SPHERE);
    if (o->out->through >= MANY_THROUGH * o->plan->bed->count) return fail(o, FAILED_WALL);
    return o->out->energy_worst < HOPELESS || fail(o, FAILED_ENERGY);
}

/* ---- a run ----------------------------------------------------------------------------------- */

/* By mass, of those that have left. */
static double mean_residence(const watch *o, bool tracers, double *sd) {
    const bed *b = o->plan->bed;
    double mass = 0, sum = 0, square = 0;
    for (int i = 0; i < b->count; i++) {
        if (o->place[i] != OUT || (tracers && !b->tracer[i])) continue;
        double m = sphere_mass(b->size[i]);
        mass += m, sum += m * o->left[i], square += m * o->left[i] * o->left[i];
    }
    double mean = sum / mass;
    if (sd) *sd = sqrt(fmax(0, square / mass - mean * mean));
    return mean;
}

static void begin(watch *o, const flow_plan *plan, flow *out) {
    const bed *b = plan->bed;
    *out = (flow){.heated = NAN, .stopped = NAN, .first_through = NAN, .overlap = -INFINITY};
    *o = (watch){.plan = plan, .out = out, .inside = b->count};
    o->world = world_open(plan->hopper, b, &plan->world);
    o->ground = clast_world_definition(o->world)->domain_min.z;
    hopper_walls(plan->hopper, o->wall);
    for (int i = 0; i < b->count; i++) o->z[i] = b->z[i];
    o->mass = o->mass_inside = bed_mass(b);
    o->start = energy_of_world(o->world);
    out->bed_energy = energy_of_bed(o->world, b);
}

void flow_run(const flow_plan *plan, flow *out) {
    CLAST_ASSERT(plan && plan->hopper && plan->bed && plan->until > 0 && out);
    static watch o; /* too large for a stack */
    begin(&o, plan, out);
    double next = LOOK_EVERY;
    bool runs = true;
    while (runs && o.inside > 0 && clast_world_time(o.world) < plan->until) {
        runs = step(&o);
        if (clast_world_time(o.world) >= next) look_at_energy(&o), next += LOOK_EVERY;
    }
    look_at_energy(&o);
    out->trapped = o.inside;
    if (plan->hopper->solid) out->energy_error = out->energy_worst = NAN;
    bool late = plan->until >= RESIDENCE_LATEST;
    if (runs && late && o.inside > MANY_THROUGH * plan->bed->count) fail(&o, FAILED_LEFT);
    bool whole = late && out->failed == FAILED_NOT;
    out->residence = mean_residence(&o, true, &out->residence_sd);
    out->residence_all = mean_residence(&o, false, NULL);
    if (!whole) out->residence = out->residence_sd = out->residence_all = NAN;
    out->unconverged = (double)clast_world_counters(o.world).unconverged;
    clast_world_free(o.world);
}

const char *flow_failure(const flow *f) {
    bool heated_first = !isnan(f->heated) && !(f->stopped <= f->heated);
    return heated_first ? FAILURE_NAME[FAILED_ENERGY] : FAILURE_NAME[f->failed];
}
