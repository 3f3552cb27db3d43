/* mixture.c - which template every body of a generator gets. Shares become whole numbers by the
 * largest remainder, classes of size share evenly, so counts are exact for every seed; the seed
 * decides only which body gets which.
 */
#include "experiments/scene/build.h"

#include <math.h>
#include <stdlib.h>

#define FAULT(node, key, ...) scene_fault_at(r->arena, r->faults, (node), (key), __VA_ARGS__)

static const double ROUNDING = 1e-9; /* of shares written with a few digits */

/* So many bodies of one template. */
typedef struct lot {
    int shape, count;
    double reach;
} lot;

/* ---- families -------------------------------------------------------------------------------- */

/* The k-th template of a shape of the scene. */
static int template_of(const crowd *c, int shape, int k) {
    return c->families ? c->families[shape].templates[k] : shape;
}

static int template_count(const crowd *c, int shape) {
    return c->families ? c->families[shape].count : 1;
}

static int member_count(const generator *g) {
    return g->mixture.count > 0 ? g->mixture.count : 1;
}

static int member_shape(const generator *g, int member) {
    const mixture_item *items = g->mixture.items;
    return g->mixture.count > 0 ? items[member].shape : g->shape;
}

double scene_pick_reach(const crowd *c, const generator *g) {
    SCENE_ASSERT(c && g);
    double reach = 0;
    for (int m = 0; m < member_count(g); m++) {
        int shape = member_shape(g, m);
        for (int k = 0; k < template_count(c, shape); k++)
            reach = fmax(reach, c->shape_reach[template_of(c, shape, k)]);
    }
    return reach;
}

/* ---- shares ---------------------------------------------------------------------------------- */

static double mean_mass(const crowd *c, int shape) {
    int count = template_count(c, shape);
    double sum = 0;
    for (int k = 0; k < count; k++) sum += c->shape_mass[template_of(c, shape, k)];
    return sum / count;
}

/* Shares of the number of bodies, up to a factor. */
static void weigh(const crowd *c, const generator *g, double *weight) {
    const mixture_item *items = g->mixture.items;
    for (int m = 0; m < g->mixture.count; m++)
        weight[m] =
            items[m].number > 0 ? items[m].number : items[m].mass / mean_mass(c, items[m].shape);
    if (g->mixture.count == 0) weight[0] = 1;
}

/* Whole numbers that add up to count: what is left after rounding down goes to the largest
 * remainders, of equal ones to the first. */
static void share_out(scene_arena *arena, const double *weight, int members, int count, int *out) {
    double *left = scene_alloc(arena, (size_t)members * sizeof *left), sum = 0;
    int missing = count;
    for (int m = 0; m < members; m++) sum += weight[m];
    for (int m = 0; m < members; m++) {
        double exact = count * (weight[m] / sum);
        out[m] = (int)floor(exact + ROUNDING);
        left[m] = exact - out[m];
        missing -= out[m];
    }
    for (; missing > 0; missing--) {
        int most = 0;
        for (int m = 1; m < members; m++)
            if (left[m] > left[most] + ROUNDING) most = m;
        out[most]++;
        left[most] -= 1;
    }
}

/* ---- picking --------------------------------------------------------------------------------- */

/* Body j of n stands for the quantile (j + 1/2) / n, so few bodies are spread over all classes. */
static int add_lots(const crowd *c, int shape, int count, lot *lots) {
    int classes = template_count(c, shape);
    for (int k = 0; k < classes; k++) {
        int one = template_of(c, shape, k);
        lots[k] = (lot){one, 0, c->shape_reach[one]};
    }
    for (int64_t j = 0; j < count; j++) lots[(2 * j + 1) * classes / (2 * (int64_t)count)].count++;
    return classes;
}

static int larger_first(const void *a, const void *b) {
    const lot *x = a, *y = b;
    if (x->reach != y->reach) return x->reach > y->reach ? -1 : 1;
    return (x->shape > y->shape) - (x->shape < y->shape);
}

static void shuffle(const crowd *c, int source, int *shapes, int count) {
    for (int i = count - 1; i > 0; i--) {
        int j = (int)(crowd_draw(c, source, DRAW_SHAPE, (uint64_t)i) * (i + 1));
        int kept = shapes[i];
        shapes[i] = shapes[j], shapes[j] = kept;
    }
}

static int count_templates(const crowd *c, const generator *g) {
    int count = 0;
    for (int m = 0; m < member_count(g); m++) count += template_count(c, member_shape(g, m));
    return count;
}

int scene_shares(scene_reader *r, const crowd *c, const generator *g, int **shape, double **share) {
    SCENE_ASSERT(r && c && g && shape && share);
    int members = member_count(g), count = count_templates(c, g), n = 0;
    double *weight = scene_alloc(r->arena, (size_t)members * sizeof *weight);
    *shape = scene_alloc(r->arena, (size_t)count * sizeof **shape);
    *share = scene_alloc(r->arena, (size_t)count * sizeof **share);
    weigh(c, g, weight);
    for (int m = 0; m < members; m++) {
        int one = member_shape(g, m), classes = template_count(c, one);
        for (int k = 0; k < classes; k++, n++) {
            (*shape)[n] = template_of(c, one, k);
            (*share)[n] = weight[m] / classes;
        }
    }
    return n;
}

static void warn_of_none(scene_reader *r, const generator *g, int member, int count) {
    const mixture_item *items = g->mixture.items;
    if (g->mixture.count == 0) return;
    const tree_node *node = items[member].item.node;
    scene_warn(r->faults, node->line, tree_path(r->arena, node, NULL), "gets none of %d bodies",
               count);
}

const int *scene_pick(scene_reader *r, const crowd *c, const generator *g, int source, int count,
                      pick_order order) {
    SCENE_ASSERT(r && c && g && count >= 0);
    int members = member_count(g), lot_count = 0, picked = 0;
    double *weight = scene_alloc(r->arena, (size_t)members * sizeof *weight);
    int *wanted = scene_alloc(r->arena, (size_t)members * sizeof *wanted);
    lot *lots = scene_alloc(r->arena, (size_t)count_templates(c, g) * sizeof *lots);
    int *shapes = scene_alloc(r->arena, ((size_t)count + 1) * sizeof *shapes);
    weigh(c, g, weight);
    share_out(r->arena, weight, members, count, wanted);
    for (int m = 0; m < members; m++) {
        if (wanted[m] == 0) warn_of_none(r, g, m, count);
        lot_count += add_lots(c, member_shape(g, m), wanted[m], &lots[lot_count]);
    }
    if (order == PICK_LARGE_FIRST) qsort(lots, (size_t)lot_count, sizeof *lots, larger_first);
    for (int l = 0; l < lot_count; l++)
        for (int k = 0; k < lots[l].count; k++) shapes[picked++] = lots[l].shape;
    SCENE_ASSERT(picked == count);
    if (order == PICK_SHUFFLED && lot_count > 1) shuffle(c, source, shapes, count);
    return shapes;
}

/* ---- faults ---------------------------------------------------------------------------------- */

void scene_check_mixture(scene_reader *r, const tree_node *node, const generator *g) {
    SCENE_ASSERT(r && node && g);
    const tree_node *mixture = tree_get(node, "mixture");
    if (!mixture) return;
    const mixture_item *items = g->mixture.items;
    double number = 0, mass = 0;
    int by_number = 0, by_mass = 0;
    for (int m = 0; m < g->mixture.count; m++) {
        number += items[m].number, mass += items[m].mass;
        by_number += items[m].number > 0, by_mass += items[m].mass > 0;
    }
    if (g->mixture.count == 0)
        FAULT(node, "mixture", "found no shapes, expected a list of {shape, number or mass}");
    else if (by_number + by_mass < g->mixture.count)
        return; /* an entry could not be read, and has been reported */
    else if (by_number > 0 && by_mass > 0)
        FAULT(node, "mixture", "found shares of number and of mass, expected one of the two");
    else if (fabs(number + mass - 1) > ROUNDING)
        FAULT(node, "mixture", "found shares that add up to %.10g %%, expected 100 %%",
              100 * (number + mass));
}
