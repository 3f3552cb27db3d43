/* impact.c - closed forms of impacts and their reference integration. */
#include "experiments/theory/impact.h"

#include <math.h>
#include <stddef.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>

#include "engine/check.h"

/* ---- linear spring-dashpot ------------------------------------------------------------------- */

/* In units of the undamped frequency w0: damping ratio z, and w = sqrt(|1 - z^2|). */
typedef struct oscillator {
    double frequency, z, w; /* 1/s, -, - */
} oscillator;

static oscillator oscillator_of(const linear_contact *c) {
    CLAST_ASSERT(c && c->mass > 0 && c->stiffness > 0 && c->dashpot >= 0);
    double z = c->dashpot / (2 * sqrt(c->stiffness * c->mass));
    return (oscillator){sqrt(c->stiffness / c->mass), z, sqrt(fabs(1 - z * z))};
}

/* sin(w tau)/w and cos(w tau), or what becomes of them at and beyond critical damping. */
static double sine_over(oscillator o, double tau) {
    if (o.w < 1e-7) return tau;
    return o.z < 1 ? sin(o.w * tau) / o.w : sinh(o.w * tau) / o.w;
}

static double cosine(oscillator o, double tau) {
    return o.z < 1 ? cos(o.w * tau) : cosh(o.w * tau);
}

/* Time of the first zero of a sin(w tau)/w - b cos(w tau), b >= 0: atan2(w b, a) / w, where the
 * printed 2.25 has an arctangent that jumps at a = 0. */
static double first_zero(oscillator o, double a, double b) {
    if (o.w < 1e-7) return b / a;
    return o.z < 1 ? atan2(o.w * b, a) / o.w : atanh(o.w * b / a) / o.w;
}

static impact_state closed_state(oscillator o, double speed, double tau) {
    double decay = exp(-o.z * tau), s = sine_over(o, tau), c = cosine(o, tau);
    return (impact_state){speed / o.frequency * decay * s, speed * decay * (c - o.z * s)};
}

/* The rate vanishes where c = z s; the force x + 2 z x' where 2 z c = (2 z^2 - 1) s. */
static double release(oscillator o, bool cut_off) {
    if (!cut_off) return M_PI / o.w;
    return o.z > 0 ? first_zero(o, 2 * o.z * o.z - 1, 2 * o.z) : M_PI;
}

impact linear_impact(const linear_contact *c, double speed) {
    oscillator o = oscillator_of(c);
    CLAST_ASSERT(speed > 0 && (c->cut_off || o.z < 1));
    double turn = o.z > 0 ? first_zero(o, o.z, 1) : M_PI / 2, end = release(o, c->cut_off);
    impact_state last = closed_state(o, speed, end);
    return (impact){.overlap_max = closed_state(o, speed, turn).overlap,
                    .time_max = turn / o.frequency,
                    .duration = end / o.frequency,
                    .overlap_end = c->cut_off ? last.overlap : 0,
                    .rebound = -last.rate};
}

static impact_state free_flight(const impact *after, double t) {
    return (impact_state){after->overlap_end - after->rebound * (t - after->duration),
                          -after->rebound};
}

impact_state linear_impact_at(const linear_contact *c, double speed, double t) {
    CLAST_ASSERT(t >= 0);
    impact all = linear_impact(c, speed);
    if (t > all.duration) return free_flight(&all, t);
    oscillator o = oscillator_of(c);
    return closed_state(o, speed, o.frequency * t);
}

static double excess_rebound(double z, void *restitution) {
    linear_contact c = {1, 1, 2 * z, true};
    return linear_impact(&c, 1).rebound - *(double *)restitution;
}

/* A zero of a function that falls from above zero at `low` to below it at `high`. */
static double falling_zero(gsl_function *f, double low, double high) {
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    gsl_root_fsolver_set(solver, f, low, high);
    for (int i = 0; i < 200; i++) {
        gsl_root_fsolver_iterate(solver);
        double a = gsl_root_fsolver_x_lower(solver), b = gsl_root_fsolver_x_upper(solver);
        if (gsl_root_test_interval(a, b, 0, 1e-14) == GSL_SUCCESS) break;
    }
    double root = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return root;
}

double linear_damping_ratio(double restitution, bool cut_off) {
    CLAST_ASSERT(restitution > 0 && restitution <= 1);
    if (restitution == 1) return 0;
    double fall = -log(restitution);
    if (!cut_off) return fall / sqrt(M_PI * M_PI + fall * fall);
    gsl_function f = {excess_rebound, &restitution};
    double high = 1;
    while (excess_rebound(high, &restitution) > 0) high *= 2;
    return falling_zero(&f, 0, high);
}

double maw_stiffness(double modulus, double radius, double mass, double speed) {
    CLAST_ASSERT(modulus > 0 && radius > 0 && mass > 0 && speed > 0);
    double k = 16.0 / 15 * sqrt(radius) * modulus;
    return k * pow(mass * speed * speed / k, 0.2);
}

double hooke_stiffness(double modulus, double radius) {
    CLAST_ASSERT(modulus > 0 && radius > 0);
    return 4.0 / 3 * modulus * radius;
}

/* ---- Hertz ----------------------------------------------------------------------------------- */

double hertz_stiffness(double modulus, double radius) {
    CLAST_ASSERT(modulus > 0 && radius > 0);
    return 4.0 / 3 * modulus * sqrt(radius);
}

/* Energy, 2.39, gives the overlap; the way in lasts overlap/v times
 * int_0^1 ds / sqrt(1 - s^(5/2)) = 2/5 B(2/5, 1/2), and the way out as long. */
impact hertz_impact(double mass, double stiffness, double speed) {
    CLAST_ASSERT(mass > 0 && stiffness > 0 && speed > 0);
    double overlap = pow(1.25 * mass * speed * speed / stiffness, 0.4);
    double in = 0.4 * tgamma(0.4) * sqrt(M_PI) / tgamma(0.9) * overlap / speed;
    return (impact){overlap, in, 2 * in, 0, speed};
}

/* ---- Walton and Braun ------------------------------------------------------------------------ */

impact hysteretic_impact(const hysteretic_contact *c, double speed) {
    CLAST_ASSERT(c && c->mass > 0 && c->loading > 0 && c->unloading >= c->loading && speed > 0);
    double in = sqrt(c->loading / c->mass), out = sqrt(c->unloading / c->mass), most = speed / in;
    return (impact){.overlap_max = most,
                    .time_max = M_PI / 2 / in,
                    .duration = M_PI / 2 / in + M_PI / 2 / out,
                    .overlap_end = (1 - c->loading / c->unloading) * most,
                    .rebound = speed * in / out};
}

impact_state hysteretic_impact_at(const hysteretic_contact *c, double speed, double t) {
    CLAST_ASSERT(t >= 0);
    impact all = hysteretic_impact(c, speed);
    if (t > all.duration) return free_flight(&all, t);
    if (t <= all.time_max) {
        double in = sqrt(c->loading / c->mass);
        return (impact_state){speed / in * sin(in * t), speed * cos(in * t)};
    }
    double out = sqrt(c->unloading / c->mass), phase = out * (t - all.time_max);
    double way = all.overlap_max - all.overlap_end;
    return (impact_state){all.overlap_end + way * cos(phase), -way * out * sin(phase)};
}

/* ---- laws without closed forms --------------------------------------------------------------- */

double hertz_force(const void *hertz, double overlap, double rate) {
    const hertz_contact *c = hertz;
    double x = overlap > 0 ? overlap : 0;
    return c->stiffness * x * sqrt(x) + c->dashpot * sqrt(sqrt(x)) * rate;
}

double viscous_force(const void *viscous, double overlap, double rate) {
    const viscous_contact *c = viscous;
    double x = overlap > 0 ? overlap : 0;
    return c->stiffness * sqrt(x) * (x + c->dissipation * rate);
}

double linear_force(const void *linear, double overlap, double rate) {
    const linear_contact *c = linear;
    return c->stiffness * overlap + c->dashpot * rate;
}

/* ---- reference integration ------------------------------------------------------------------- */

/* In units of the speed and the scale of time: y[0] overlap, y[1] rate. */
typedef struct reference {
    impact_law *law;
    const void *constants;
    double mass, speed, scale;
    gsl_odeiv2_driver *driver;
} reference;

static double force_of(const reference *r, const double y[2]) {
    return r->law(r->constants, y[0] * r->speed * r->scale, y[1] * r->speed);
}

static int rates(double t, const double y[], double dydt[], void *params) {
    const reference *r = params;
    (void)t;
    dydt[0] = y[1];
    dydt[1] = -force_of(r, y) * r->scale / (r->mass * r->speed);
    return GSL_SUCCESS;
}

typedef bool event(const reference *r, const double y[2]);

static bool has_turned(const reference *r, const double y[2]) {
    (void)r;
    return y[1] <= 0;
}

static bool is_released(const reference *r, const double y[2]) {
    return y[1] < 0 && (y[0] <= 0 || force_of(r, y) <= 0);
}

static void advance(const reference *r, double from, double to, double y[2]) {
    gsl_odeiv2_driver_reset(r->driver);
    int status = gsl_odeiv2_driver_apply(r->driver, &from, to, y);
    CLAST_ASSERT(status == GSL_SUCCESS);
}

/* Bisects the event between two times; y is the state at the first and becomes that of the event.
 */
static double moment_of(const reference *r, event *happened, double from, double to, double y[2]) {
    double low = from, high = to;
    for (int i = 0; i < 50; i++) {
        double middle = 0.5 * (low + high), at[2] = {y[0], y[1]};
        if (!(middle > low && middle < high)) break;
        advance(r, from, middle, at);
        if (happened(r, at))
            high = middle;
        else
            low = middle;
    }
    advance(r, from, high, y);
    return high;
}

static void record(const reference *r, impact_trace *trace, double t, const double y[2]) {
    if (!trace || trace->count == trace->room) return;
    trace->point[trace->count++] =
        (impact_point){t * r->scale, y[0] * r->speed * r->scale, y[1] * r->speed};
}

/* From touch to release in steps of `every`. */
static impact follow(const reference *r, double every, impact_trace *trace) {
    enum { STEPS_MAX = 1000000 };
    impact all = {0};
    double y[2] = {0, 1}, t = 0;
    bool turned = false;
    record(r, trace, 0, y);
    for (int i = 1; i < STEPS_MAX; i++) {
        double next[2] = {y[0], y[1]}, until = i * every, length = r->speed * r->scale;
        advance(r, t, until, next);
        if (!turned && has_turned(r, next)) {
            double at[2] = {y[0], y[1]};
            all.time_max = r->scale * moment_of(r, has_turned, t, until, at);
            all.overlap_max = length * at[0];
            turned = true;
        }
        if (is_released(r, next)) {
            t = moment_of(r, is_released, t, until, y);
            record(r, trace, t, y);
            all.duration = r->scale * t, all.rebound = -r->speed * y[1];
            all.overlap_end = y[0] > 0 ? length * y[0] : 0;
            return all;
        }
        t = until, y[0] = next[0], y[1] = next[1];
        record(r, trace, t, y);
    }
    CLAST_ASSERT(!"the contact never ends");
    return all;
}

impact impact_integrate(impact_law *law, const void *constants, double mass, double speed,
                        double scale, impact_trace *trace) {
    CLAST_ASSERT(law && mass > 0 && speed > 0 && scale > 0);
    CLAST_ASSERT(!trace || (trace->every > 0 && trace->room > 0));
    reference r = {law, constants, mass, speed, scale, NULL};
    gsl_odeiv2_system system = {rates, NULL, 2, &r};
    r.driver = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-6, 1e-14, 1e-13);
    CLAST_ASSERT(r.driver);
    if (trace) trace->count = 0;
    impact all = follow(&r, trace ? trace->every / scale : 1.0 / 64, trace);
    gsl_odeiv2_driver_free(r.driver);
    return all;
}

typedef struct target {
    impact_law *law;
    const void *constants;
    double *parameter, mass, speed, scale, restitution;
} target;

static double excess_of_law(double parameter, void *params) {
    const target *t = params;
    *t->parameter = parameter;
    impact i = impact_integrate(t->law, t->constants, t->mass, t->speed, t->scale, NULL);
    return i.rebound / t->speed - t->restitution;
}

void impact_solve(impact_law *law, const void *constants, double *parameter, double mass,
                  double speed, double scale, double restitution) {
    CLAST_ASSERT(parameter && *parameter > 0 && restitution > 0.01 && restitution < 1);
    target t = {law, constants, parameter, mass, speed, scale, restitution};
    gsl_function f = {excess_of_law, &t};
    double high = *parameter;
    while (excess_of_law(high, &t) > 0) high *= 2;
    *parameter = falling_zero(&f, 0, high);
}
