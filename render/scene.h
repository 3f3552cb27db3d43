/* scene.h: looking over the caller's arrays before anything is drawn. */
#ifndef RENDER_SCENE_H
#define RENDER_SCENE_H

#include "render/lens.h"

/* Refuses not-finite numbers, radii <= 0 and the like, naming the array and the index. */
render_status render_scene_check(const render_scene *scene);

/* Nearest and farthest view depth of everything; near < far, and near > 0 if perspective. The range
 * is the whole scene's, seen or not, so that it does not depend on what is culled. */
void render_scene_depths(const render_scene *scene, const render_lens *lens, double *near_m,
                         double *far_m);

#endif
