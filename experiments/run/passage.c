#include "experiments/run/passage.h"

#include <math.h>
#include <stdio.h>

#include "engine/check.h"

bool passage_has_feeds(const scene *s) {
    return clast_world_feed_count(s->world) > 0;
}

bool passage_has_outlets(const scene *s) {
    bool removes = clast_world_definition(s->world)->outside == CLAST_OUTSIDE_REMOVE;
    return clast_world_outlet_count(s->world) > 0 || (removes && passage_has_feeds(s));
}

double passage_diameter(const scene *s, int shape) {
    CLAST_ASSERT(s && shape >= 0 && shape < clast_world_shape_count(s->world));
    clast_shape_def d = clast_world_shape(s->world, shape);
    if (d.spheres == 1) return 2 * d.radius[0];
    double volume = d.mass / s->materials[d.material].density;
    return cbrt(6 * volume / 3.14159265358979323846);
}

static const char *gate_name(const scene *s, const clast_passage *p, bool in) {
    if (in) return clast_world_feed(s->world, p->gate).name;
    return p->gate == CLAST_OUTLET_DOMAIN ? "domain" : clast_world_outlet(s->world, p->gate).name;
}

static void write_row(const scene *s, table *t, const clast_passage *p, bool in) {
    table_begin(t, p->time, p->step);
    table_number(t, p->id);
    table_word(t, gate_name(s, p, in));
    table_word(t, clast_world_shape(s->world, p->shape).name);
    table_number(t, p->mass);
    table_number(t, passage_diameter(s, p->shape));
    table_end(t);
}

enum { AT_ONCE = 64 };
typedef size_t read_passages(clast_world *w, clast_passage *to, size_t room);

static int write_rows(const scene *s, read_passages *read, table *t, bool in) {
    clast_passage some[AT_ONCE];
    if (read(s->world, NULL, 0) == 0) return 0;
    for (size_t n; (n = read(s->world, some, AT_ONCE)) > 0;)
        for (size_t i = 0; i < n && t->descriptor >= 0; i++) write_row(s, t, &some[i], in);
    return t->failure;
}

int passage_write(const scene *s, table *feeds, table *outlets) {
    CLAST_ASSERT(s && feeds && outlets);
    int failure = write_rows(s, clast_world_arrivals, feeds, true);
    int other = write_rows(s, clast_world_departures, outlets, false);
    return failure ? failure : other;
}

static void report_outlet(const scene *s, int index, const char *name) {
    clast_flow f = clast_world_outlet_flow(s->world, index);
    if (index == CLAST_OUTLET_DOMAIN && f.bodies == 0) return;
    printf("outlet  %s: %llu bodies, %.6g kg\n", name, (unsigned long long)f.bodies, f.mass);
}

void passage_report(const scene *s) {
    CLAST_ASSERT(s);
    for (int i = 0; i < clast_world_feed_count(s->world); i++) {
        clast_feed_def d = clast_world_feed(s->world, i);
        clast_flow f = clast_world_feed_flow(s->world, i);
        printf("feed    %s: %llu bodies, %.6g kg", d.name, (unsigned long long)f.bodies, f.mass);
        if (f.refused > 0)
            printf("; %llu times no room in %d attempts, %.3g %s owed",
                   (unsigned long long)f.refused, d.attempts, f.owed,
                   d.mass_rate > 0 ? "kg" : "bodies");
        putchar('\n');
    }
    for (int i = 0; i < clast_world_outlet_count(s->world); i++)
        report_outlet(s, i, clast_world_outlet(s->world, i).name);
    if (passage_has_outlets(s)) report_outlet(s, CLAST_OUTLET_DOMAIN, "domain");
}
