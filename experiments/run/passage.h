/* passage.h - who came by a feed and who left: feeds.csv and outlets.csv of a run. */
#ifndef CLAST_RUN_PASSAGE_H
#define CLAST_RUN_PASSAGE_H

#include "experiments/run/table.h"
#include "experiments/scene/scene.h"

#define FEEDS_HEADER   "time_s,step,id,feed,shape,mass_kg,diameter_m"
#define OUTLETS_HEADER "time_s,step,id,outlet,shape,mass_kg,diameter_m"

/* Whether bodies can come, or leave, while the scene runs. */
bool passage_has_feeds(const scene *s);
bool passage_has_outlets(const scene *s);

/* Takes the records that have come up in the world and writes a row for each; 0 or errno. */
int passage_write(const scene *s, table *feeds, table *outlets);

/* m: of the sphere of the volume of a shape; that of the body itself where it is one sphere. */
double passage_diameter(const scene *s, int shape);

/* One line for each feed and outlet: how much, what is owed, how often there was no room. */
void passage_report(const scene *s);

#endif
