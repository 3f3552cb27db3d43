/* entry.c - entries of contact lists: columns of double, or of float in a world of mixed precision.
 */
#include <string.h>

#include "engine/world.h"

size_t entry_number_size(const clast_world *w) {
    return w->def.precision == CLAST_PRECISION_MIXED ? sizeof(float) : sizeof(double);
}

/* ---- entries --------------------------------------------------------------------------------- */

static void resize(clast_world *w, contact_list *l, size_t now) {
    size_t old = l->capacity;
    l->a = memory_grow(w, l->a, old, now, sizeof *l->a);
    l->b = memory_grow(w, l->b, old, now, sizeof *l->b);
    for (int k = 0; k < w->history_columns; k++)
        l->column[k] = memory_grow(w, l->column[k], old, now, entry_number_size(w));
    l->capacity = now;
}

/* Room for `count` entries and a batch behind them. */
void entry_reserve(clast_world *w, contact_list *l, size_t count) {
    if (count + ENTRIES_BEHIND > l->capacity) resize(w, l, entry_room(count));
}

static double column_at(const clast_world *w, const contact_list *l, int k, size_t i) {
    if (w->def.precision == CLAST_PRECISION_MIXED) return (double)((const float *)l->column[k])[i];
    return ((const double *)l->column[k])[i];
}

static void set_column(const clast_world *w, const contact_list *l, int k, size_t i, double value) {
    if (w->def.precision == CLAST_PRECISION_MIXED)
        ((float *)l->column[k])[i] = (float)value;
    else
        ((double *)l->column[k])[i] = value;
}

bool contact_touches(const clast_world *w, const contact_list *l, size_t i) {
    return column_at(w, l, 0, i) > 0;
}

/* m, at the last evaluation. */
double entry_overlap(const clast_world *w, const contact_list *l, size_t i) {
    return column_at(w, l, 0, i);
}

static bool name_is_reversed(const clast_world *w, const contact_list *l, size_t i) {
    size_t a = body_of_sphere(w, (size_t)l->a[i]), b = body_of_sphere(w, (size_t)l->b[i]);
    return w->bodies.id[a] > w->bodies.id[b];
}

/* As seen by the body of lower id, or by the body where b is a wall. */
history contact_history(const clast_world *w, const contact_list *l, size_t i, bool with_wall) {
    const int s = HISTORY_SPRING;
    vec3 spring = v3(column_at(w, l, s, i), column_at(w, l, s + 1, i), column_at(w, l, s + 2, i));
    double sign = !with_wall && name_is_reversed(w, l, i) ? -1 : 1;
    spring = v3_scale(sign, from_kernel(w, spring));
    /* adding nothing makes one zero of two: the sign of a zero hangs on who was a */
    spring = v3_add(spring, v3(0, 0, 0));
    bool yields = w->history_columns > HISTORY_PLASTIC;
    double plastic = yields ? column_at(w, l, HISTORY_PLASTIC, i) : 0;
    return (history){column_at(w, l, 0, i), column_at(w, l, 1, i), spring, plastic};
}

void entry_clear_spring(clast_world *w, contact_list *l, size_t i) {
    for (int k = HISTORY_SPRING; k < HISTORY_PLASTIC; k++) set_column(w, l, k, i, 0);
}

/* As contact_history() reads it; without a spring where the law has none. */
void entry_push(clast_world *w, contact_list *l, int32_t a, int32_t b, const history *h) {
    entry_reserve(w, l, l->count + 1);
    size_t i = l->count++;
    l->a[i] = a, l->b[i] = b;
    bool remembers = w->special.spring || w->def.law == CLAST_LAW_USER;
    vec3 spring = remembers ? to_kernel(w, h->spring) : v3(0, 0, 0);
    double values[HISTORY_COLUMNS] = {h->overlap, h->normal, spring.x,
                                      spring.y,   spring.z,  h->plastic};
    for (int k = 0; k < w->history_columns; k++) set_column(w, l, k, i, values[k]);
}

void entry_clear(clast_world *w, contact_list *l, size_t i) {
    for (int k = 0; k < w->history_columns; k++) set_column(w, l, k, i, 0);
}

/* A batch behind the last entry: lanes that fill up a vector have no history. */
void entries_clear_behind(clast_world *w, contact_list *l) {
    size_t size = entry_number_size(w);
    for (int k = 0; k < w->history_columns; k++)
        memset((char *)l->column[k] + l->count * size, 0, ENTRIES_BEHIND * size);
}

/* The history of one entry becomes that of another, and none is left. */
void entry_hand_over(const clast_world *w, const contact_list *l, size_t to, size_t from) {
    for (int k = 0; k < w->history_columns; k++) {
        set_column(w, l, k, to, column_at(w, l, k, from));
        set_column(w, l, k, from, 0);
    }
}

/* a and b change places. */
void entry_turn(clast_world *w, contact_list *l, size_t i) {
    int32_t a = l->a[i];
    l->a[i] = l->b[i], l->b[i] = a;
    for (int k = HISTORY_SPRING; k < HISTORY_PLASTIC; k++)
        set_column(w, l, k, i, -column_at(w, l, k, i));
}

/* n entries from one place to another, which may overlap. */
void entry_move(const clast_world *w, contact_list *l, size_t to, size_t from, size_t n) {
    size_t size = entry_number_size(w);
    memmove(l->a + to, l->a + from, n * sizeof *l->a);
    memmove(l->b + to, l->b + from, n * sizeof *l->b);
    for (int k = 0; k < w->history_columns; k++)
        memmove((char *)l->column[k] + to * size, (char *)l->column[k] + from * size, n * size);
}

void entry_free(clast_world *w, contact_list *l) {
    size_t size = 2 * sizeof *l->a + (size_t)w->history_columns * entry_number_size(w);
    memory_return(w, l->capacity * size);
    memory_release(l->a), memory_release(l->b);
    for (int k = 0; k < HISTORY_COLUMNS; k++) memory_release(l->column[k]);
    *l = (contact_list){0};
}
