/* draft.h - a scene between the YAML tree and the world: plain structs, every value in SI, every
 * name replaced by an index. The tables of schema.c say which key goes into which field.
 */
#ifndef CLAST_SCENE_DRAFT_H
#define CLAST_SCENE_DRAFT_H

#include "experiments/scene/scene.h"
#include "experiments/scene/tree.h"
#include "meshes/shapes.h"

/* An entry of a list or of a map of names; the first member of every item below. */
typedef struct item {
    const tree_node *node;
    const char *name; /* "" in a list */
} item;

typedef struct item_list {
    void *items;
    int count;
} item_list;

typedef struct material_item {
    item item;
    clast_material_def def;
} material_item;

typedef struct pair_item {
    item item;
    int between[2]; /* materials */
    clast_pair_def def;
} pair_item;

typedef struct element_item {
    item item;
    clast_vec3 centre;
    double radius;
} element_item;

typedef struct point_list {
    double *xz;
    int count;
} point_list;

/* Scale factors of a shape, as the file gives them. */
typedef struct size_rule {
    double uniform[2];    /* from, to */
    double normal[2];     /* mean, standard deviation */
    double log_normal[2]; /* median, geometric standard deviation */
    double between[2];    /* where the last two are cut off; {0}: nowhere */
    const char *table;
    int classes;
} size_rule;

/* The element spheres of a shape, however it was given. */
typedef struct sphere_set {
    int count;
    clast_vec3 *centre;
    double *radius;
    double reach; /* m, of the bounding sphere about the origin of the body */
} sphere_set;

typedef enum mass_choice { MASS_AUTO, MASS_SOLID, MASS_UNION } mass_choice;

/* How many spheres stand for a solid; 0: not asked for. */
typedef struct fill_rule {
    double density, deviation, smallest;
    double levels[8];
    int spheres, level;
} fill_rule;

typedef struct shape_item {
    item item;
    int material;
    double solid[3]; /* m, measures of whichever solid the file gives */
    const char *profile, *mesh;
    double file_unit; /* m */
    fill_rule fill;
    mass_choice mass_from;
    sphere_set made;     /* by scene_fill_shapes(); count 0: the spheres are those of the file */
    const char *made_of; /* for `clast check`: masses of union and solid, what was reached */
    double radius;       /* of a sphere, or of every sphere of a chain */
    double chain_spacing;
    int chain_spheres;
    item_list spheres; /* element_item */
    double ellipse[2];
    int fit_spheres;
    double mass;
    clast_vec3 inertia;
    point_list outline;
    size_rule size;
} shape_item;

typedef struct part_item {
    item item;
    clast_part_def def;
    const char *table; /* of its motion */
} part_item;

typedef struct rotation {
    clast_vec3 axis;
    double angle;
    double quaternion[4];
} rotation;

typedef struct name_list {
    int *index;
    int count;
} name_list;

/* The same wall several times; count 0: once. */
typedef struct copies_rule {
    int count;
    clast_vec3 step;
    name_list parts; /* in turn; empty: the part of the wall */
} copies_rule;

/* A wall of triangles, from a file or made from measures, and where it is put. */
typedef struct surface_rule {
    const char *mesh, *axes;
    double unit, weld, scale, smooth_angle;
    mesh_bar bar;         /* whichever the file gives */
    const char *bar_mesh; /* in the place of its measures, or NULL */
    double bar_unit;
    mesh_tube tube;
    mesh_bend bend;
    rotation turn;
    clast_vec3 at;
} surface_rule;

typedef struct wall_item {
    item item;
    int part; /* -1: a part of its own that never moves, shared by all such walls */
    clast_wall_def plane, plate; /* whichever the file gives */
    surface_rule surface;
    copies_rule copies;
    int material;
    clast_vec3 belt;
} wall_item;

typedef enum orientation_rule {
    ORIENT_FIXED,
    ORIENT_RANDOM,         /* uniform on the rotation group */
    ORIENT_RANDOM_IN_PLANE /* about the normal of the plane of motion */
} orientation_rule;

typedef struct mixture_item {
    item item;
    int shape;
    double number, mass; /* shares; 0: not given */
} mixture_item;

/* grid, hexagonal and random share one struct: each fills what it has keys for. */
typedef struct generator {
    int shape, count;
    item_list mixture; /* mixture_item; empty: `shape` alone */
    clast_vec3 region_min, region_max;
    clast_vec3 spacing;
    double jitter;
    double gap;
    int attempts;
    int orientation;
    rotation turn; /* of ORIENT_FIXED */
    clast_vec3 velocity, spin;
} generator;

typedef struct body_item {
    item item;
    int shape;
    clast_vec3 position;
    rotation turn;
    clast_vec3 velocity, spin;
    generator grid, hexagonal, random;
    const char *csv, *from;
} body_item;

typedef struct feed_item {
    item item;
    generator from;           /* what and where */
    double rate, number_rate; /* kg/s, 1/s; one of the two is given */
    double begins, ends;      /* s */
    int full;
} feed_item;

typedef struct outlet_item {
    item item;
    clast_outlet_def def;
} outlet_item;

typedef struct measure_item {
    item item;
    measure discharged, remaining, solid_fraction, band_velocity, part_load, load_profile;
    double bed_x[2], band_x[2];
} measure_item;

typedef struct scene_draft {
    const char *title;
    clast_world_def def;
    int motion;                     /* 0 3-D, 1 + axis in plane */
    const char *library, *function; /* of a contact law of the user's own; NULL: not given */
    uint64_t seed;
    item_list materials, pairs, shapes, parts, walls, bodies, feeds, outlets, measures;
    scene_mesh *meshes; /* by scene_build(): walls of triangles as they stand in the world */
    int mesh_count;
    const char *mesh_reports; /* what was found in each file or shape, a few lines each */
    ending ending;
    output_plan output;
    view view;
    double size[2];
    int projection; /* 0 orthographic, 1 perspective */
    const char *preset, *map;
} scene_draft;

#endif
