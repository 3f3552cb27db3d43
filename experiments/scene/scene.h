/* scene.h - a scene file, read, checked and ready to become a world.
 *
 * A scene is YAML (README.md of this folder lists every key). Reading never stops at the first
 * fault: all of them are collected with file, line, key, what was found and what was expected.
 */
#ifndef CLAST_SCENE_H
#define CLAST_SCENE_H

#include "engine/clast.h"

/* What is measured while the scene runs: one or more columns of series.csv each. */
typedef enum measure_kind {
    MEASURE_DISCHARGED,     /* kg and number of bodies whose centre has ever gone below `level` */
    MEASURE_REMAINING,      /* number and kg of bodies with their centre above `level` */
    MEASURE_SOLID_FRACTION, /* bed profile in `sections` across the width: A00 4.3.1 (ii) */
    MEASURE_BAND_VELOCITY,  /* mean and sd of the vertical velocity in a band: A00 4.3.1 (iii) */
    MEASURE_COORDINATION,   /* mean number of touching partners per body, all sub-contacts once */
    MEASURE_PART_LOAD,      /* force, torque and work of one part */
    MEASURE_LOAD_PROFILE    /* normal force on one part in `sections` of its height */
} measure_kind;

typedef struct measure {
    char *name; /* prefix of its columns */
    measure_kind kind;
    double level;        /* m, z of the orifice or floor, or of the lowest section */
    double x_min, x_max; /* m, width: solid fraction and band */
    int sections;        /* solid fraction: the experimenter's ten; load profile */
    double body_area;    /* m2, projected area of one body: solid fraction */
    double height;       /* m above level: centre of the band; upper end of the load profile */
    double thickness;    /* m, of the band */
    int part;            /* part load, load profile */
} measure;

typedef enum colour_by {
    COLOUR_SPEED,          /* continuous map */
    COLOUR_SPEED_BANDS,    /* the three bands of A00 Fig. 4.19 */
    COLOUR_INITIAL_HEIGHT, /* stripes */
    COLOUR_BODY,
    COLOUR_PROCESS /* of several, that had the body; of `clast render` alone */
} colour_by;

/* How frames are drawn; every field has a default, so a scene may leave the section out. */
typedef struct view {
    char *preset;      /* "draft" or "final" */
    int width, height; /* pixels */
    colour_by colour;
    char *map;            /* "viridis" or "cividis" */
    double speed_max;     /* m/s, top of the colour bar; 0 takes the fastest of each frame */
    clast_vec3 look_from; /* direction from the centre of the box towards the eye */
    clast_vec3 up;
    clast_vec3 box_min, box_max; /* m, what must be in the picture; equal corners = the domain */
    bool perspective;
    bool walls;               /* draw walls: planes and plates translucent, meshes opaque */
    bool planes;              /* planes and plates among them */
    double frames_per_second; /* of the animation */
} view;

/* When a run ends. */
typedef struct ending {
    double latest;     /* s */
    double rest_speed; /* m/s: ends when no body has been faster than this ... */
    double rest_for;   /* s: ... for so long; 0 turns the test off */
} ending;

typedef struct output_plan {
    double frame_every;      /* s; 0 = none */
    double series_every;     /* s */
    double checkpoint_every; /* s of simulated time; 0 = at the end only */
    bool contacts;           /* contact network in every frame */
} output_plan;

/* Contact constants of two materials, by their indices: the world does not give them back. */
typedef struct scene_pair {
    int a, b;
    clast_pair_def def;
} scene_pair;

/* A wall of triangles as it stands at t = 0: for pictures. */
typedef struct scene_mesh {
    char *name;
    int wall, walls; /* its first wall in the world, and how many it became */
    size_t vertex_count, triangle_count;
    double *vertex;    /* m, x y z x y z ... */
    int32_t *triangle; /* three vertex numbers each */
} scene_mesh;

typedef struct scene {
    char *path, *title;
    char *text;         /* the file as read, with parameters after --set: goes into run.h5 */
    clast_world *world; /* built and prepared; owned by the scene */
    measure *measures;
    int measure_count;
    view view;
    ending ending;
    output_plan output;
    bool step_given;               /* the scene states its time step */
    clast_material_def *materials; /* with names; in the order of the world */
    int material_count;
    scene_pair *pairs;
    int pair_count;
    scene_mesh *meshes;
    int mesh_count;
    char *mesh_reports;       /* what the import found, a few lines for each, "" for none */
    char *clumps;             /* how shapes were filled, a line each, "" for none */
    char *library, *function; /* of a contact law of the user's own; NULL without one */
} scene;

typedef struct scene_options {
    const char *const *set; /* "name=value" strings: override entries of `parameters` */
    int set_count;
    int threads;            /* 0 = as the scene says */
    int spheres_per_thread; /* likewise */
    clast_isa isa;          /* AUTO = as the scene says */
    bool parse_only;        /* do not prepare the world */
    bool mixed;      /* mixed precision, whatever the scene says; `clast plan` asks what it saves */
    int fit_spheres; /* > 0: fitted shapes get so many spheres; `clast plan` asks what fewer cost */
} scene_options;

/* Reads, checks and builds. NULL when anything is wrong; *faults is then a malloc'ed text with one
 * fault a line. When a scene is usable but something deserves a warning, *faults holds the
 * warnings. */
scene *scene_load(const char *path, const scene_options *options, char **faults);
void scene_free(scene *s);

#endif
