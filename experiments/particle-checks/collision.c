/* collision.c - A00 3.3: the particle falls on a floor, upright (one contact) and lying (two); the
 * impulse of an elastic collision beside m v. */
#include <math.h>

#include "experiments/particle-checks/checks.h"

static setting setting_of(double damping, double step) {
    return (setting){.law = CLAST_LAW_HERTZ_A00,
                     .young = pair_young(),
                     .step = step,
                     .damping = damping,
                     .rigid_wall = true,
                     .guards_look_on = true};
}

/* Height of the centre at which the particle touches the floor. */
static double standing(const capsule *p, bool horizontal) {
    return p->radius + (horizontal ? 0 : 0.5 * p->spacing);
}

static clast_world *above_floor(const setting *s, const capsule *p, bool horizontal, double gap,
                                double speed) {
    clast_world *w = matter_new(s, p);
    floor_add(w, s);
    clast_quat turn = horizontal ? (clast_quat){1, 0, 0, 0} : upright();
    body_put(w, &(clast_body_def){.shape = 0,
                                  .position = {0, 0, standing(p, horizontal) + gap},
                                  .orientation = turn,
                                  .velocity = {0, 0, -speed}});
    return w;
}

/* ---- Fig. 3.3 -------------------------------------------------------------------------------- */

typedef struct watch {
    const drop_case *c;
    const capsule *p;
    const setting *s;
    FILE *trace;
    drop found;
    int collisions; /* so far */
    bool touching;
} watch;

static void write_point(const watch *k, clast_world *w, const touch *t, double rise) {
    const char *name = k->c->shared ? "shared" : k->c->horizontal ? "horizontal" : "vertical";
    double each = t->contacts > 0 ? t->force.z / t->contacts : 0;
    fprintf(k->trace, "%s,%.8g,%.8g,%.6g,%.6g,%d\n", name, clast_world_time(w), rise, t->force.z,
            each, k->collisions);
}

/* Of the first collision every step is drawn, of the flights every hundredth. */
static void look(watch *k, clast_world *w, int step) {
    double rise = clast_world_bodies(w).z[0] - standing(k->p, k->c->horizontal);
    touch t = {.contacts = 0};
    if (rise < 1e-6) t = touch_of(w, 0, k->s, k->p);
    bool touching = t.contacts > 0;
    if (touching && !k->touching) k->collisions++;
    k->touching = touching;
    if (k->collisions == 1) {
        double each = t.contacts ? t.force.z / t.contacts : 0;
        k->found.force_most = fmax(k->found.force_most, each);
        k->found.impulse += t.force.z * k->s->step;
        if (!touching) k->found.bounce = fmax(k->found.bounce, rise);
    }
    bool close = touching && k->collisions == 1;
    if (k->trace && (close || step % 100 == 0)) write_point(k, w, &t, rise);
}

drop drop_run(const drop_case *c, FILE *trace) {
    capsule p = pair_particle();
    setting s = setting_of(c->damping, c->step);
    s.shared = c->shared;
    clast_world *w = above_floor(&s, &p, c->horizontal, c->height, 0);
    watch k = {.c = c, .p = &p, .s = &s, .trace = trace};
    double fall = sqrt(2 * c->height / GRAVITY);
    int steps = (int)(4 * fall / c->step);
    for (int n = 1; n <= steps; n++) {
        world_step(w);
        look(&k, w, n);
    }
    world_end(w);
    return k.found;
}

/* ---- Figs 3.4 and 3.5 ------------------------------------------------------------------------ */

double elastic_impulse_error(const elastic_case *c, FILE *trace) {
    enum { MOST = 1000000 };
    capsule p = pair_particle();
    double step = c->fraction * PAIR_CRITICAL_STEP, speed = sqrt(2 * GRAVITY * c->height);
    setting s = setting_of(0, step);
    s.weightless = !c->weight, s.rigid_wall = !c->soft_floor;
    clast_world *w = above_floor(&s, &p, false, c->late * step * speed, speed);
    double area = 0, force = 1;
    if (trace) fprintf(trace, "%g,0,0\n", c->fraction);
    for (int n = 1; n <= MOST && (force > 0 || n < 3); n++) {
        world_step(w);
        force = touch_of(w, 0, &s, &p).force.z;
        area += force * step;
        if (trace) fprintf(trace, "%g,%.8g,%.8g\n", c->fraction, (n - c->late) * step, force);
    }
    world_end(w);
    return fabs(0.5 * area / (p.mass * speed) - 1);
}
