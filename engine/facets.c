/* facets.c - what a sphere feels of a mesh, whose walls are flat facets: of all that it touches at
 * once, those that are surfaces of their own; and what becomes of a contact's memory when another
 * facet of the same surface takes it over.
 *
 * The facets of a smooth patch stand for one curved surface, and a sphere has one contact with it:
 * the deepest. So overlap and force are those of the distance to the surface, with fillets in its
 * hollow seams (fillet.c): they change steadily wherever the sphere goes, have a potential, and do
 * not know how the surface was cut (engine/README.md has what was rejected).
 * Places of a patch whose normals differ by more than its angle are surfaces of their own: a sphere
 * between the two sides of a tube, or on a floor and against the wall that a fillet joins to it,
 * feels both. */
#include "engine/facets.h"
#include "engine/geometry.h"
#include "engine/periodic.h"
#include "engine/world.h"

/* ---- which of them are felt ------------------------------------------------------------------ */

/* The deepest of the touches: it hides most of the others, so it is asked first. */
static size_t deepest_of(const wall_touch *touch, size_t count) {
    size_t best = 0;
    for (size_t i = 1; i < count; i++)
        if (is_deeper(&touch[i], &touch[best])) best = i;
    return best;
}

static bool is_border(wall_touch *touch, size_t count, size_t own) {
    wall_touch *t = &touch[own];
    if (t->state != TOUCH_UNKNOWN) return t->state == TOUCH_BORDER;
    t->state = TOUCH_OWN;
    for (size_t i = 0; i < count && t->state == TOUCH_OWN; i++)
        if (i != own && touch[i].overlap > 0 && is_border_of(t, &touch[i])) t->state = TOUCH_BORDER;
    return t->state == TOUCH_BORDER;
}

/* Whether a deeper place of the same surface is touched. That one may itself be hidden by a third:
 * the facets of a hollow are deeper one than the other, and only the last is felt. But it is no
 * border, which would be the place of another surface. */
static bool is_shallow(wall_touch *touch, size_t count, size_t own, size_t other) {
    return other != own && touch[other].overlap > 0 &&
           are_one_surface(&touch[own], &touch[other]) && is_deeper(&touch[other], &touch[own]) &&
           !is_border(touch, count, other);
}

static bool is_hidden(wall_touch *touch, size_t count, size_t own, size_t deepest) {
    if (touch[own].wall->family < 0 || !(touch[own].overlap > 0)) return false;
    if (is_shallow(touch, count, own, deepest)) return true;
    if (is_border(touch, count, own)) return true;
    if (touch[own].wall->smooth < 0) return false;
    for (size_t i = 0; i < count; i++)
        if (is_shallow(touch, count, own, i)) return true;
    return false;
}

/* Which touches of one sphere are not felt. What is felt hangs on what is touched alone, not on
 * its order. */
void touches_settle(wall_touch *touch, size_t count) {
    if (count < 2) return;
    size_t deepest = deepest_of(touch, count);
    for (size_t i = 0; i < count; i++) touch[i].hidden = is_hidden(touch, count, i, deepest);
}

/* ---- memory ---------------------------------------------------------------------------------- */

/* A run: the entries of one sphere. */
typedef struct run {
    const clast_world *w;
    const contact_list *l;
    size_t from, count;
    const wall_touch *touch;
} run;

static double overlap_before(const run *r, size_t i) {
    return entry_overlap(r->w, r->l, r->from + i);
}

static bool is_felt(const wall_touch *t) {
    return t->overlap > 0 && !t->hidden;
}

/* The deepest contact that has ended on a smooth patch and whose turn has not come, or count. The
 * order is one of overlaps and names. */
static size_t next_ended(const run *r, double below, const wall *behind) {
    size_t best = r->count;
    double most = 0;
    for (size_t i = 0; i < r->count; i++) {
        const wall *l = r->touch[i].wall;
        double overlap = overlap_before(r, i);
        if (l->smooth < 0 || !(overlap > 0) || is_felt(&r->touch[i])) continue;
        if (overlap > below || (overlap == below && l <= behind)) continue;
        if (overlap < most || (overlap == most && best < r->count && l > r->touch[best].wall))
            continue;
        best = i, most = overlap;
    }
    return best;
}

/* The facet of the same surface that has just come to be felt and lies most nearly along it, or
 * count. */
static size_t heir_of(const run *r, size_t ended) {
    const wall_touch *from = &r->touch[ended];
    size_t best = r->count;
    double most = from->wall->smooth_cosine;
    for (size_t i = 0; i < r->count; i++) {
        const wall_touch *to = &r->touch[i];
        if (!is_felt(to) || overlap_before(r, i) > 0 || !are_one_surface(from, to)) continue;
        double along = v3_dot(from->normal, to->normal);
        bool ahead =
            along > most || (along == most && best < r->count && to->wall < r->touch[best].wall);
        if (ahead) best = i, most = along;
    }
    return best;
}

/* What a contact remembers goes with it from facet to facet. */
static void hand_over(const run *r) {
    double overlap = INFINITY;
    const wall *behind = NULL;
    for (;;) {
        size_t from = next_ended(r, overlap, behind);
        if (from == r->count) return;
        overlap = overlap_before(r, from), behind = r->touch[from].wall;
        size_t to = heir_of(r, from);
        if (to < r->count) entry_hand_over(r->w, r->l, r->from + to, r->from + from);
    }
}

/* ---- lists ----------------------------------------------------------------------------------- */

/* Past the last entry of the same sphere. */
size_t facets_run_end(const contact_list *l, size_t from) {
    size_t to = from;
    while (to < l->count && l->a[to] == l->a[from]) to++;
    return to;
}

/* Entries from .. to - 1 of a list of walls, those of one sphere: all of its touches, and which of
 * them are hidden. `advance`: contacts go on where others have ended. */
void facets_settle(const clast_world *w, const contact_list *l, size_t from, size_t to,
                   bool advance, wall_touch *touch) {
    const centre_row *c = &w->rows.centre[l->a[from]];
    vec3 centre = from_kernel(w, centre_at(c));
    for (size_t k = from; k < to; k++) {
        const wall *met = &w->walls[l->b[k]];
        touch[k - from] = touch_of_wall(met, image_at_wall(w, met, centre), c->radius);
    }
    touches_settle(touch, to - from);
    if (advance) hand_over(&(run){w, l, from, to - from, touch});
}

/* The same of one entry alone, which touches nothing but perhaps a fillet. */
bool facets_fillet(const clast_world *w, const contact_list *l, size_t at, fillet_touch *touch) {
    const centre_row *c = &w->rows.centre[l->a[at]];
    const wall *met = &w->walls[l->b[at]];
    vec3 centre = image_at_wall(w, met, from_kernel(w, centre_at(c)));
    return fillet_at(met, centre, c->radius, touch);
}

/* Room for all walls of one sphere, or of one body where batches end with bodies. Needs the list of
 * walls. */
void facets_reserve(clast_world *w, share *s) {
    const contact_list *l = &s->walls;
    size_t most = 0;
    for (size_t from = 0, to; from < l->count; from = to) {
        size_t body = body_of_sphere(w, (size_t)l->a[from]);
        for (to = from + 1; to < l->count && body_of_sphere(w, (size_t)l->a[to]) == body;) to++;
        most = to - from > most ? to - from : most;
    }
    if (most + ENTRIES_BEHIND <= s->touch_capacity) return;
    size_t now = most + most / 4 + ENTRIES_BEHIND;
    s->touches = memory_grow(w, s->touches, s->touch_capacity, now, sizeof *s->touches);
    s->touch_capacity = now;
}
