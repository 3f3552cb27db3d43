/* part.c - parts: groups of walls that move as the scene prescribes. Where a part is and how fast
 * is a function of the clock, never a sum of steps: a restart, or a step tried twice, puts it in
 * the very same place. Walls are put where their part is in wall.c. */
#include "engine/numbers.h"
#include "engine/part.h"
#include "engine/world.h"

#define WHOLE_TURN (2 * NUMBER_PI)

/* ---- what a part may be told ----------------------------------------------------------------- */

static bool is_nothing(vec3 a) {
    return a.x == 0 && a.y == 0 && a.z == 0;
}

static bool is_finite(vec3 a) {
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

static bool is_phase(double phase) {
    return phase >= 0 && phase < 1;
}

static bool is_rate(double frequency) {
    return frequency > 0 && isfinite(frequency);
}

static const char *stroke_fault(const clast_stroke *s) {
    if (!is_finite(s->travel)) return "stroke: travel is not finite";
    if (is_nothing(s->travel)) return NULL;
    if (!is_rate(s->speed)) return "stroke: speed is not above zero";
    if (!(s->pause >= 0) || !isfinite(s->pause)) return "stroke: pause is below zero";
    return is_phase(s->phase) ? NULL : "stroke: phase is not in [0, 1)";
}

static const char *oscillation_fault(const clast_oscillation *o) {
    if (!is_finite(o->amplitude)) return "oscillation: amplitude is not finite";
    if (is_nothing(o->amplitude)) return NULL;
    if (!is_rate(o->frequency)) return "oscillation: frequency is not above zero";
    return is_phase(o->phase) ? NULL : "oscillation: phase is not in [0, 1)";
}

static const char *rotation_fault(const clast_part_def *d) {
    const clast_rotation *r = &d->rotation;
    if (!is_finite(r->point) || !is_finite(r->axis)) return "rotation: point or axis is not finite";
    if (!isfinite(r->speed)) return "rotation: speed is not finite";
    if (!isfinite(r->swing)) return "rotation: swing is not finite";
    bool turns = r->speed != 0 || r->swing != 0 || d->table.angle;
    if (turns && !(v3_norm(r->axis) > 0)) return "rotation: has no axis";
    if (r->swing == 0) return NULL;
    if (!is_rate(r->frequency)) return "rotation: frequency is not above zero";
    return is_phase(r->phase) ? NULL : "rotation: phase is not in [0, 1)";
}

static const char *table_fault(const clast_motion_table *t) {
    if (t->rows < 0) return "table: has less than no rows";
    if (t->rows == 0) return NULL;
    if (!t->time || !t->offset) return "table: has no times or no offsets";
    for (int i = 0; i < t->rows; i++) {
        if (!isfinite(t->time[i]) || !is_finite(t->offset[i]))
            return "table: holds no finite number";
        if (t->angle && !isfinite(t->angle[i])) return "table: holds no finite angle";
        if (i > 0 && !(t->time[i] > t->time[i - 1])) return "table: times do not rise";
    }
    return NULL;
}

static const char *fault_of(const clast_part_def *d) {
    if (!is_finite(d->velocity)) return "velocity is not finite";
    if (isnan(d->move_from) || isnan(d->removed_at)) return "a time is not a number";
    if (d->move_until != 0 && !(d->move_until > d->move_from))
        return "move_until is not after move_from";
    const char *fault = stroke_fault(&d->stroke);
    if (!fault) fault = oscillation_fault(&d->oscillation);
    if (!fault) fault = rotation_fault(d);
    return fault ? fault : table_fault(&d->table);
}

static clast_motion_table own_table(clast_world *w, const clast_motion_table *t) {
    if (t->rows == 0) return (clast_motion_table){0};
    size_t n = (size_t)t->rows;
    return (clast_motion_table){.rows = t->rows,
                                .time = memory_copy(w, t->time, n, sizeof *t->time),
                                .offset = memory_copy(w, t->offset, n, sizeof *t->offset),
                                .angle = t->angle ? memory_copy(w, t->angle, n, sizeof *t->angle)
                                                  : NULL};
}

int clast_part_add(clast_world *w, const clast_part_def *def) {
    CLAST_ASSERT(w && def && !w->prepared);
    const char *fault = fault_of(def);
    if (fault)
        return world_fail(w, CLAST_ERR_ARGUMENT, "part %s: %s", def->name ? def->name : "?", fault),
               -1;
    int n = w->part_count;
    w->parts = memory_grow(w, w->parts, (size_t)n, (size_t)n + 1, sizeof *w->parts);
    part *p = &w->parts[n];
    *p = (part){.name = memory_text(w, def->name), .def = *def, .present = true};
    p->def.name = p->name;
    p->def.table = own_table(w, &def->table);
    p->turns = def->rotation.speed != 0 || def->rotation.swing != 0 || def->table.angle;
    bool varies = !is_nothing(def->stroke.travel) || !is_nothing(def->oscillation.amplitude) ||
                  def->table.rows > 0;
    p->shifts = !is_nothing(def->velocity) || varies;
    p->steady = !varies && !p->turns;
    if (p->turns) p->axis = v3_scale(1 / v3_norm(def->rotation.axis), def->rotation.axis);
    p->at = part_at(p, 0);
    w->part_count++;
    return n;
}

void parts_free(clast_world *w) {
    for (int i = 0; i < w->part_count; i++) {
        part *p = &w->parts[i];
        memory_release(p->name), memory_release(p->walls), memory_release(p->near);
        memory_release(p->tree.wall), memory_release(p->tree.box), memory_release(p->tree.plane);
        memory_release((void *)p->def.table.time), memory_release((void *)p->def.table.offset);
        memory_release((void *)p->def.table.angle);
    }
    memory_release(w->parts);
}

/* ---- where it is ----------------------------------------------------------------------------- */

bool part_is_running(const clast_part_def *d, double t) {
    return t >= d->move_from && !(d->move_until > 0 && t >= d->move_until);
}

/* Seconds that a part has been running until t. */
static double running_time(const clast_part_def *d, double t) {
    double until = d->move_until > 0 && d->move_until < t ? d->move_until : t;
    return until > d->move_from ? until - d->move_from : 0;
}

static double fraction(double turns) {
    return turns - floor(turns);
}

/* Sine of so many turns, and its rate per turn. */
static void swing(double turns, double *sine, double *rate) {
    clast_sincos(WHOLE_TURN * fraction(turns), sine, rate);
    *rate *= WHOLE_TURN;
}

/* Out, pause, back, pause. */
static void add_stroke(const clast_stroke *s, double t, part_place *at) {
    if (is_nothing(s->travel)) return;
    double leg = v3_norm(s->travel) / s->speed, half = leg + s->pause;
    double since = 2 * half * fraction(t / (2 * half) + s->phase);
    bool back = since >= half;
    double gone = (back ? since - half : since) / leg;
    double out = gone < 1 ? gone : 1, rate = gone < 1 ? 1 / leg : 0;
    at->offset = v3_add(at->offset, v3_scale(back ? 1 - out : out, s->travel));
    at->velocity = v3_add(at->velocity, v3_scale(back ? -rate : rate, s->travel));
}

static void add_oscillation(const clast_oscillation *o, double t, part_place *at) {
    if (is_nothing(o->amplitude)) return;
    double sine, rate;
    swing(o->frequency * t + o->phase, &sine, &rate);
    at->offset = v3_add(at->offset, v3_scale(sine, o->amplitude));
    at->velocity = v3_add(at->velocity, v3_scale(o->frequency * rate, o->amplitude));
}

static void add_rotation(const clast_rotation *r, double t, part_place *at) {
    at->angle += r->speed * t;
    at->spin += r->speed;
    if (r->swing == 0) return;
    double sine, rate;
    swing(r->frequency * t + r->phase, &sine, &rate);
    at->angle += r->swing * sine;
    at->spin += r->swing * r->frequency * rate;
}

/* The last row that is not after t, or -1. */
static int row_before(const clast_motion_table *m, double t) {
    int from = -1, to = m->rows;
    while (to - from > 1) {
        int middle = from + (to - from) / 2;
        if (m->time[middle] <= t)
            from = middle;
        else
            to = middle;
    }
    return from;
}

/* Straight from row to row; before the first and behind the last it stands. */
static void add_table(const clast_motion_table *m, double t, part_place *at) {
    if (m->rows == 0) return;
    int row = row_before(m, t);
    bool between = row >= 0 && row + 1 < m->rows;
    int i = row < 0 ? 0 : row, j = between ? i + 1 : i;
    double length = between ? m->time[j] - m->time[i] : 1;
    double part_of = between ? (t - m->time[i]) / length : 0;
    vec3 way = v3_sub(m->offset[j], m->offset[i]);
    at->offset = v3_add(at->offset, v3_add(m->offset[i], v3_scale(part_of, way)));
    at->velocity = v3_add(at->velocity, v3_scale(1 / length, way));
    if (!m->angle) return;
    double turn = m->angle[j] - m->angle[i];
    at->angle += m->angle[i] + part_of * turn;
    at->spin += turn / length;
}

part_place part_at(const part *p, double time) {
    const clast_part_def *d = &p->def;
    double t = running_time(d, time);
    part_place at = {.offset = v3_scale(t, d->velocity), .velocity = d->velocity};
    if (!p->steady) {
        add_stroke(&d->stroke, t, &at);
        add_oscillation(&d->oscillation, t, &at);
        if (p->turns) add_rotation(&d->rotation, t, &at);
        add_table(&d->table, t, &at);
    }
    if (!part_is_running(d, time)) at.velocity = v3(0, 0, 0), at.spin = 0;
    return at;
}

/* Whole turns come off first: sin and cos have a range. */
quat part_turn(const part *p, double angle) {
    if (!p->turns) return (quat){1, 0, 0, 0};
    return clast_quat_axis_angle(p->axis, WHOLE_TURN * fraction(angle / WHOLE_TURN));
}

/* ---- bounds ---------------------------------------------------------------------------------- */

/* m/s, that the table moves at most; rad/s, that it turns at most. */
static double table_speed(const clast_motion_table *m, double *spin) {
    double most = 0;
    *spin = 0;
    for (int i = 1; i < m->rows; i++) {
        double length = m->time[i] - m->time[i - 1];
        most = fmax(most, v3_norm(v3_sub(m->offset[i], m->offset[i - 1])) / length);
        if (m->angle) *spin = fmax(*spin, fabs(m->angle[i] - m->angle[i - 1]) / length);
    }
    return most;
}

/* m/s, that no place within `reach` (m) of the axis is faster than; velocity apart. */
double part_speed_bound(const part *p, double reach) {
    const clast_part_def *d = &p->def;
    double spin, speed = table_speed(&d->table, &spin);
    if (!is_nothing(d->stroke.travel)) speed += d->stroke.speed;
    speed += WHOLE_TURN * d->oscillation.frequency * v3_norm(d->oscillation.amplitude);
    spin += fabs(d->rotation.speed) + WHOLE_TURN * fabs(d->rotation.frequency * d->rotation.swing);
    return p->turns ? speed + spin * reach : speed;
}

/* Whether it stays in the plane of motion, whatever its walls are (kernel frame: z is across). */
bool part_is_flat(const clast_world *w, const part *p) {
    const clast_part_def *d = &p->def;
    double across = fabs(to_kernel(w, d->velocity).z) + fabs(to_kernel(w, d->stroke.travel).z) +
                    fabs(to_kernel(w, d->oscillation.amplitude).z);
    for (int i = 0; i < d->table.rows; i++) across += fabs(to_kernel(w, d->table.offset[i]).z);
    vec3 axis = to_kernel(w, p->axis);
    return across == 0 && axis.x == 0 && axis.y == 0;
}

/* ---- readers --------------------------------------------------------------------------------- */

clast_pose clast_world_part_pose(const clast_world *w, int index) {
    CLAST_ASSERT(w && index >= 0 && index < w->part_count);
    const part *p = &w->parts[index];
    clast_pose pose = {part_turn(p, p->at.angle), p->at.offset};
    if (!p->turns) return pose;
    vec3 pivot = p->def.rotation.point;
    pose.shift = v3_add(pose.shift, v3_sub(pivot, m3_apply(&p->turn, pivot)));
    return pose;
}

clast_vec3 clast_pose_apply(clast_pose pose, clast_vec3 place) {
    mat3 turn = q_matrix(pose.turn);
    return v3_add(m3_apply(&turn, place), pose.shift);
}

bool clast_world_part_present(const clast_world *w, int index) {
    CLAST_ASSERT(w && index >= 0 && index < w->part_count);
    return w->parts[index].present;
}

clast_vec3 clast_world_part_offset(const clast_world *w, int index) {
    CLAST_ASSERT(w && index >= 0 && index < w->part_count);
    return w->parts[index].at.offset;
}
