/* flow.c - parts that move by a table, feeds and outlets: what is checked of them and how they come
 * into the world. */
#include "experiments/scene/build.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAULT(node, key, ...) scene_fault_at(r->arena, r->faults, (node), (key), __VA_ARGS__)
#define EACH(type, it, list)                                                                       \
    for (const type *it = (list).items, *it##_end = it + (list).count; it != it##_end; it++)

/* ---- tables of motion ------------------------------------------------------------------------ */

enum { LINE_BYTES = 400, NUMBERS = 5 };

typedef struct motion_reader {
    scene_reader *r;
    const char *path;
    int line, columns, rows, room, faults;
    double *time, *angle;
    clast_vec3 *offset;
} motion_reader;

#define TABLE_FAULT(...)                                                                           \
    (m->faults++, scene_report_in(m->r->faults, m->path, m->line, "", __VA_ARGS__))

static void *doubled(scene_arena *arena, const void *old, int count, size_t size) {
    void *all = scene_alloc(arena, (2 * (size_t)count + 64) * size);
    if (count > 0) memcpy(all, old, (size_t)count * size);
    return all;
}

static void read_heading(motion_reader *m, char *line) {
    line[strcspn(line, "\r\n")] = '\0';
    m->columns = !strcmp(line, "time,x,y,z") ? 4 : !strcmp(line, "time,x,y,z,angle") ? 5 : 0;
    if (m->columns == 0)
        TABLE_FAULT("found '%s', expected the heading time,x,y,z or time,x,y,z,angle", line);
}

/* The numbers of a line; false when there are more or fewer of them. */
static bool read_numbers(const motion_reader *m, const char *line, double n[NUMBERS]) {
    for (int k = 0; k < m->columns; k++) {
        char *end;
        n[k] = strtod(line, &end);
        end += strspn(end, " \t\r\n");
        bool last = k + 1 == m->columns;
        if (end == line || *end != (last ? '\0' : ',') || !isfinite(n[k])) return false;
        line = end + 1;
    }
    return true;
}

static void read_row(motion_reader *m, const char *line) {
    double n[NUMBERS] = {0};
    if (!read_numbers(m, line, n)) {
        TABLE_FAULT("found '%.*s', expected %d numbers", (int)strcspn(line, "\r\n"), line,
                    m->columns);
        return;
    }
    if (m->rows > 0 && !(n[0] > m->time[m->rows - 1])) {
        TABLE_FAULT("found the time %g behind %g, expected a later one", n[0],
                    m->time[m->rows - 1]);
        return;
    }
    if (m->rows == m->room) {
        scene_arena *arena = m->r->arena;
        m->time = doubled(arena, m->time, m->rows, sizeof *m->time);
        m->angle = doubled(arena, m->angle, m->rows, sizeof *m->angle);
        m->offset = doubled(arena, m->offset, m->rows, sizeof *m->offset);
        m->room = 2 * m->rows + 64;
    }
    m->time[m->rows] = n[0], m->angle[m->rows] = n[4];
    m->offset[m->rows++] = (clast_vec3){n[1], n[2], n[3]};
}

static void read_lines(motion_reader *m, FILE *file) {
    char line[LINE_BYTES];
    while (m->faults == 0 && fgets(line, sizeof line, file)) {
        m->line++;
        if (line[strspn(line, " \t\r\n")] == '\0' || line[0] == '#') continue;
        if (m->columns == 0)
            read_heading(m, line);
        else
            read_row(m, line);
    }
    if (m->faults == 0 && m->rows == 0) TABLE_FAULT("found no row, expected one at least");
}

static clast_motion_table read_motion(scene_reader *r, const part_item *part) {
    motion_reader m = {.r = r, .path = part->table};
    FILE *file = fopen(m.path, "r");
    if (!file) {
        FAULT(part->item.node, "table", "found '%s', which cannot be read: %s", m.path,
              strerror(errno));
        return (clast_motion_table){0};
    }
    read_lines(&m, file);
    fclose(file);
    return (clast_motion_table){m.rows, m.time, m.offset, m.columns == 5 ? m.angle : NULL};
}

/* ---- parts ----------------------------------------------------------------------------------- */

void scene_add_parts(scene_reader *r, clast_world *w, const scene_draft *d) {
    EACH(part_item, part, d->parts) {
        clast_part_def def = part->def;
        def.name = part->item.name;
        if (part->table) def.table = read_motion(r, part);
        bool aimless = def.table.angle && !tree_get(part->item.node, "rotation");
        if (aimless)
            FAULT(part->item.node, "rotation",
                  "missing, expected the axis that the angles of %s are about", part->table);
        else if (clast_part_add(w, &def) < 0)
            FAULT(part->item.node, NULL, "%s", clast_world_error(w));
    }
}

void scene_check_part(scene_reader *r, const part_item *part) {
    const tree_node *about = tree_get(part->item.node, "rotation");
    const clast_rotation *turn = &part->def.rotation;
    if (about && turn->swing != 0 && !(turn->frequency > 0))
        FAULT(about, "frequency", "missing, expected how often it swings per second");
    if (about && tree_get(about, "frequency") && turn->swing == 0)
        FAULT(about, "swing", "missing, expected how far it swings");
    const tree_node *stroke = tree_get(part->item.node, "stroke");
    clast_vec3 way = part->def.stroke.travel;
    if (stroke && tree_get(stroke, "travel") && way.x == 0 && way.y == 0 && way.z == 0)
        FAULT(stroke, "travel", "found [0, 0, 0], expected a way");
}

/* ---- feeds ----------------------------------------------------------------------------------- */

void scene_check_feed(scene_reader *r, const scene_draft *d, const feed_item *feed) {
    const tree_node *node = feed->item.node;
    bool mass = tree_get(node, "rate") != NULL, number = tree_get(node, "number_rate") != NULL;
    if (!mass && !number)
        FAULT(node, "rate", "missing, expected a mass per time in kg/s, > 0, or number_rate");
    if (mass && number) FAULT(node, "number_rate", "found beside rate, expected one of the two");
    if (feed->ends > 0 && feed->ends <= feed->begins)
        FAULT(node, "until", "found %g s, expected more than from, %g s", feed->ends, feed->begins);
    scene_check_generator(r, d, node, &feed->from);
}

static bool add_feed(scene_reader *r, clast_world *w, const crowd *c, const feed_item *feed) {
    const generator *g = &feed->from;
    int *shape;
    double *share;
    int kinds = scene_shares(r, c, g, &shape, &share);
    clast_feed_def def = {.name = feed->item.name,
                          .region_min = g->region_min,
                          .region_max = g->region_max,
                          .shapes = kinds,
                          .shape = shape,
                          .share = share,
                          .mass_rate = feed->rate,
                          .number_rate = feed->number_rate,
                          .from = feed->begins,
                          .until = feed->ends,
                          .velocity = g->velocity,
                          .spin = g->spin,
                          .turned = g->orientation != ORIENT_FIXED,
                          .orientation = scene_turn(&g->turn, tree_get(feed->item.node, "turn")),
                          .attempts = g->attempts,
                          .full = (clast_full)feed->full};
    return clast_feed_add(w, &def) >= 0;
}

void scene_add_flow(scene_reader *r, clast_world *w, const scene_draft *d, const crowd *c) {
    EACH(feed_item, feed, d->feeds) {
        if (!add_feed(r, w, c, feed)) FAULT(feed->item.node, NULL, "%s", clast_world_error(w));
    }
    EACH(outlet_item, outlet, d->outlets) {
        clast_outlet_def def = outlet->def;
        def.name = outlet->item.name;
        bool box = tree_get(outlet->item.node, "box") != NULL;
        def.kind = box ? CLAST_OUTLET_BOX : CLAST_OUTLET_PLANE;
        if (clast_outlet_add(w, &def) < 0)
            FAULT(outlet->item.node, NULL, "%s", clast_world_error(w));
    }
}
