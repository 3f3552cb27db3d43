/* Solid fraction from the profile of the bed, A00 4.3.1 (ii): the width is cut into ten sections,
 * the height of the bed is read in each, and the mean height times the width is the area of the
 * bed.
 *
 * How the height of a section is read. The outline of the bed is the highest point of any sphere
 * above each x. The experimenter read one height per section off a still picture, by eye. Two
 * estimators bracket what that can mean: the mean of the outline over the section, which counts the
 * dips between the topmost bodies as outside the bed, and its maximum, the top of the highest body.
 * The mean is the area under the outline without bias and is what `fraction` uses; `fraction_top`
 * uses the maximum and is the lower end. Which of the two the experimenter's eye was nearer to, the
 * source does not say; the difference is the error of the method and is reported as such, not
 * tuned.
 *
 * What belongs to the bed: bodies with their centre above the level, without those in flight. A
 * body is in flight when it touches nothing and hangs by more than its own height above everything
 * below it; such bodies count neither in the number nor in the outline. */
#include <math.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/run/measure.h"

enum { LINES = 64 }; /* points of the outline in a section */

typedef struct bottom {
    size_t place;
    uint32_t id;
    double low, high;
} bottom;

typedef struct bed {
    const measure *m;
    const moment *now;
    int lines;
    double *top; /* height of the outline above the level at each line */
    double count, mass;
} bed;

static void header(const measure *m, FILE *to) {
    fprintf(to, ",%s_fraction,%s_fraction_top,%s_bulk_kg_per_m2,%s_area_m2,%s_count", m->name,
            m->name, m->name, m->name, m->name);
    for (int i = 0; i < m->sections; i++) fprintf(to, ",%s_height_%d_m", m->name, i + 1);
}

static int from_below(const void *a, const void *b) {
    const bottom *x = a, *y = b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    return (x->id > y->id) - (x->id < y->id);
}

static double line_x(const bed *b, int line) {
    return b->m->x_min + (b->m->x_max - b->m->x_min) * (line + 0.5) / b->lines;
}

/* Lines that a sphere covers: [*from, *to). */
static void lines_of(const bed *b, double x, double radius, int *from, int *to) {
    double spacing = (b->m->x_max - b->m->x_min) / b->lines;
    double low = ceil((x - radius - b->m->x_min) / spacing - 0.5);
    double high = floor((x + radius - b->m->x_min) / spacing - 0.5) + 1;
    *from = low < 0 ? 0 : low > b->lines ? b->lines : (int)low;
    *to = high < 0 ? 0 : high > b->lines ? b->lines : (int)high;
}

/* Height of a sphere's surface above (sign +1) or below (-1) its centre on a line, above the level.
 */
static double surface(const bed *b, size_t sphere, int line, int sign) {
    const clast_spheres *s = &b->now->spheres;
    double dx = line_x(b, line) - s->x[sphere], r = s->radius[sphere];
    double rise2 = r * r - dx * dx;
    return s->z[sphere] - b->m->level + sign * (rise2 > 0 ? sqrt(rise2) : 0);
}

/* Smallest distance of a body from the outline below it; infinite where no line meets it. */
static double clearance(const bed *b, size_t place) {
    double least = HUGE_VAL;
    for (size_t e = b->now->first_sphere[place]; e < b->now->first_sphere[place + 1]; e++) {
        int from, to;
        lines_of(b, b->now->spheres.x[e], b->now->spheres.radius[e], &from, &to);
        for (int i = from; i < to; i++) {
            double gap = surface(b, e, i, -1) - b->top[i];
            if (gap < least) least = gap;
        }
    }
    return least;
}

static void raise_outline(bed *b, size_t place) {
    for (size_t e = b->now->first_sphere[place]; e < b->now->first_sphere[place + 1]; e++) {
        int from, to;
        lines_of(b, b->now->spheres.x[e], b->now->spheres.radius[e], &from, &to);
        for (int i = from; i < to; i++) {
            double height = surface(b, e, i, 1);
            if (height > b->top[i]) b->top[i] = height;
        }
    }
}

/* Bodies above the level with their lowest and highest point, from below; malloc'ed. */
static bottom *bodies_from_below(const bed *b, size_t *count) {
    const moment *now = b->now;
    bottom *all = malloc((now->bodies.count + 1) * sizeof *all);
    CLAST_ASSERT(all);
    *count = 0;
    for (size_t i = 0; i < now->bodies.count; i++) {
        if (!(now->bodies.z[i] > b->m->level)) continue;
        bottom body = {i, now->bodies.id[i], HUGE_VAL, -HUGE_VAL};
        for (size_t e = now->first_sphere[i]; e < now->first_sphere[i + 1]; e++) {
            body.low = fmin(body.low, now->spheres.z[e] - now->spheres.radius[e]);
            body.high = fmax(body.high, now->spheres.z[e] + now->spheres.radius[e]);
        }
        all[(*count)++] = body;
    }
    qsort(all, *count, sizeof *all, from_below);
    return all;
}

static int ascending(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Ids of all bodies that touch something, sorted; malloc'ed. */
static uint32_t *touching_ids(const moment *now, size_t *count) {
    uint32_t *ids = malloc((2 * now->contact_count + 1) * sizeof *ids);
    CLAST_ASSERT(ids);
    *count = 0;
    for (size_t i = 0; i < now->contact_count; i++) {
        ids[(*count)++] = now->contacts[i].a;
        if (now->contacts[i].b < CLAST_WALL_ID) ids[(*count)++] = now->contacts[i].b;
    }
    qsort(ids, *count, sizeof *ids, ascending);
    return ids;
}

/* Lays the bodies into the outline from below, leaving out those in flight; marks the others. */
static void build(bed *b, unsigned char *in_bed) {
    size_t count, touching;
    bottom *bodies = bodies_from_below(b, &count);
    uint32_t *ids = touching_ids(b->now, &touching);
    for (size_t i = 0; i < count; i++) {
        bool touches = bsearch(&bodies[i].id, ids, touching, sizeof *ids, ascending) != NULL;
        double gap = touches ? 0 : clearance(b, bodies[i].place);
        if (gap > bodies[i].high - bodies[i].low && gap < HUGE_VAL) continue;
        in_bed[bodies[i].place] = 1;
        raise_outline(b, bodies[i].place);
    }
    for (size_t i = 0; i < b->now->bodies.count; i++) {
        size_t place = b->now->order[i];
        if (!in_bed[place]) continue;
        b->count += 1;
        b->mass += b->now->bodies.mass[place];
    }
    free(bodies);
    free(ids);
}

/* Mean and maximum of the outline in a section. */
static void read_section(const bed *b, int section, double *mean, double *top) {
    double sum = 0, highest = 0;
    for (int i = section * LINES; i < (section + 1) * LINES; i++) {
        sum += b->top[i];
        if (b->top[i] > highest) highest = b->top[i];
    }
    *mean = sum / LINES;
    *top = highest;
}

static int values(const measure *m, measure_memory *memory, const moment *now, double *values) {
    (void)memory;
    CLAST_ASSERT(now->with_contacts && m->sections >= 1 && m->sections <= MEASURE_SECTIONS_MAX);
    CLAST_ASSERT(m->x_max > m->x_min);
    bed b = {.m = m, .now = now, .lines = LINES * m->sections};
    b.top = calloc((size_t)b.lines, sizeof *b.top);
    unsigned char *in_bed = calloc(now->bodies.count + 1, 1);
    CLAST_ASSERT(b.top && in_bed);
    build(&b, in_bed);
    double mean = 0, top = 0;
    for (int i = 0; i < m->sections; i++) {
        double section_top;
        read_section(&b, i, &values[5 + i], &section_top);
        mean += values[5 + i] / m->sections;
        top += section_top / m->sections;
    }
    double width = m->x_max - m->x_min, solid = b.count * m->body_area;
    values[0] = solid / (mean * width); /* not a number for an empty bed */
    values[1] = solid / (top * width);
    values[2] = b.mass / (mean * width);
    values[3] = mean * width;
    values[4] = b.count;
    free(b.top);
    free(in_bed);
    return 5 + m->sections;
}

const measure_class MEASURE_SOLID_FRACTION_CLASS = {.kind = MEASURE_SOLID_FRACTION,
                                                    .word = "solid fraction",
                                                    .needs_contacts = true,
                                                    .header = header,
                                                    .values = values};
