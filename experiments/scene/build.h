/* build.h - from a draft without faults to a world: the stages behind scene_load(). */
#ifndef CLAST_SCENE_BUILD_H
#define CLAST_SCENE_BUILD_H

#include "experiments/scene/reader.h"

/* Never without spheres, but for an ellipse that cannot be fitted. */
sphere_set scene_shape_spheres(scene_arena *arena, const shape_item *shape);

/* size.c: scale factors of the classes of a shape, smallest first; {1} without `size`. */
typedef struct size_set {
    int count;
    double *scale;
} size_set;

size_set scene_shape_sizes(scene_reader *r, const shape_item *shape);
void scene_check_size(scene_reader *r, const shape_item *shape, const tree_node *size);

/* The templates in the world of one shape of the scene: one, or one for each class of size. */
typedef struct shape_family {
    int count;
    int *templates;      /* indices of shapes of the world */
    const double *scale; /* of each */
} shape_family;

/* fill.c: spheres, mass and inertia of shapes that are given as a solid, a profile or a mesh, or
 * whose mass is that of the union of their spheres. */
void scene_fill_shapes(scene_reader *r, scene_draft *draft);

/* check.c: what one key cannot tell alone. */
void scene_check(scene_reader *r, const scene_draft *draft);

/* surface.c: walls of triangles. `copy` counts from 0; each goes to the part that is its turn. */
bool scene_is_surface(const wall_item *wall);
void scene_add_surface(scene_reader *r, clast_world *w, scene_draft *draft, const wall_item *wall,
                       int still);
/* build.c: names and parts of the copies of a wall of any kind, and how far each is moved. */
int scene_copies(const wall_item *wall); /* 1 without `copies` */
const char *scene_copy_name(scene_arena *arena, const wall_item *wall, int copy);
int scene_copy_part(const wall_item *wall, int copy, int still);
clast_vec3 scene_copy_shift(const wall_item *wall, int copy);

/* Bodies on their way into the world, with what placing the next one needs to know. */
typedef struct crowd {
    clast_body_def *bodies;
    double *reach; /* m */
    int *source;   /* index of the entry of `bodies:` that asked for it */
    int count, room;
    int inherited; /* the first so many came with a checkpoint and are in the world already */
    const double *shape_reach;    /* m, by shape of the world */
    const double *shape_mass;     /* kg, likewise */
    const shape_family *families; /* by shape of the scene; NULL: each is its own template */
    int plane_axis;               /* -1: 3-D */
    uint64_t seed;
} crowd;

void crowd_add(crowd *c, const clast_body_def *body, int source);
void crowd_free(crowd *c);

/* A number in [0, 1) of the entry `source`, of a stream for each purpose. */
typedef enum draw_purpose { DRAW_PLACE, DRAW_TURN, DRAW_JITTER, DRAW_SHAPE } draw_purpose;
double crowd_draw(const crowd *c, int source, draw_purpose purpose, uint64_t counter);

/* mixture.c: the template of each of `count` bodies of a generator, in the order of placing. */
typedef enum pick_order {
    PICK_SHUFFLED,
    PICK_LARGE_FIRST /* small bodies find room between large ones, not the other way round */
} pick_order;
/* Templates of a generator and their shares of the number of bodies, up to a factor. */
int scene_shares(scene_reader *r, const crowd *c, const generator *g, int **shape, double **share);
const int *scene_pick(scene_reader *r, const crowd *c, const generator *g, int source, int count,
                      pick_order order);
double scene_pick_reach(const crowd *c, const generator *g); /* m, of the largest template */
void scene_check_mixture(scene_reader *r, const tree_node *node, const generator *g);

/* place.c: one generator of an entry of `bodies:`. */
void scene_place_grid(scene_reader *r, crowd *c, const tree_node *node, const generator *g,
                      int source);
void scene_place_hexagonal(scene_reader *r, crowd *c, const tree_node *node, const generator *g,
                           int source);
void scene_place_random(scene_reader *r, crowd *c, const tree_node *node, const generator *g,
                        int source);
clast_quat scene_turn(const rotation *turn, const tree_node *node); /* node may be NULL: no turn */

/* start_csv.c: a table of bodies. */
void scene_place_csv(scene_reader *r, crowd *c, const scene_draft *draft, const char *path,
                     const tree_node *node, int source);

/* check.c: what every generator has. `node` may be no map: then it has been reported. */
void scene_check_generator(scene_reader *r, const scene_draft *d, const tree_node *node,
                           const generator *g);

/* flow.c: parts with their tables of motion, feeds, outlets. */
void scene_check_part(scene_reader *r, const part_item *part);
void scene_check_feed(scene_reader *r, const scene_draft *d, const feed_item *feed);
void scene_add_parts(scene_reader *r, clast_world *w, const scene_draft *d);
void scene_add_flow(scene_reader *r, clast_world *w, const scene_draft *d, const crowd *c);

/* build.c: NULL with faults. */
clast_world *scene_build(scene_reader *r, scene_draft *draft, bool prepare);

#endif
