/* contact_user.h - one contact by the law of the user's own (clast_law.h), in the place of the
 * lanes of contact_law.h. In double precision alone. */
#ifndef CLAST_CONTACT_USER_H
#define CLAST_CONTACT_USER_H

#include "engine/contact_law.h"

/* Entry `at` of the list stands in lane i of the batch. */
void user_law_lane(const clast_world *w, const contact_place *at, batch *b, history_lanes h, int i,
                   law_choice choice, law_need need);

#endif
