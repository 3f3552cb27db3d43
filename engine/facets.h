/* facets.h - which of the walls that a sphere touches it feels (facets.c). Private to engine/. */
#ifndef CLAST_ENGINE_FACETS_H
#define CLAST_ENGINE_FACETS_H

#include "engine/world_data.h"

struct wall_touch;
struct fillet_touch;

void facets_reserve(clast_world *w, share *s);
size_t facets_run_end(const contact_list *l, size_t from);
void facets_settle(const clast_world *w, const contact_list *l, size_t from, size_t to,
                   bool advance, struct wall_touch *touch);
bool facets_fillet(const clast_world *w, const contact_list *l, size_t at,
                   struct fillet_touch *touch);

#endif
