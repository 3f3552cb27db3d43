#include "experiments/scene/schema_rows.h"

/* Rows of tables read better as they stand here: */
/* clang-format off */

static const char *const LAWS[] = {"hertz-a00", "hertz-mindlin", "linear", "maw", "hooke",
                                   "hertz-brilliantov", "walton-braun", "user", NULL};
static const char *const TANGENTS[] = {"by-law", "spring", "viscous", NULL};
static const char *const LIMITS[] = {"total", "spring", NULL};
static const char *const UNLOADINGS[] = {"rescale", "as-printed", NULL};
static const char *const CLUMP_CONTACTS[] = {"each", "shared", NULL};
static const char *const MOTIONS[] = {"3d", "in-plane x", "in-plane y", "in-plane z", NULL};
static const char *const AXES[] = {"x", "y", "z", NULL};
static const char *const OUTSIDES[] = {"stop", "remove", NULL};
static const char *const GUARDS[] = {"stop", "report", NULL};
static const char *const ISAS[] = {"auto", "baseline", "avx2", "avx512", NULL};
static const char *const SCHEMES[] = {
    "leapfrog", "symplectic-euler", "taylor", "position-verlet", "velocity-verlet", "gear4",
    "backward-euler", "beeman", "newmark-beta", "bdf2", "bdf4", "adams-moulton", "trapezoid",
    "numerov-backward", "numerov-forward", "numerov-central", NULL};
static const char *const SOLVERS[] = {"conjugate-gradient", "gauss-seidel", NULL};
static const char *const PRECISIONS[] = {"double", "mixed", NULL};
static const char *const ORIENTATIONS[] = {"fixed", "random", "random-in-plane", NULL};
static const char *const MASSES[] = {"auto", "solid", "union", NULL};
static const char *const PRESETS[] = {"draft", "final", NULL};
static const char *const COLOURS[] = {"speed", "speed-bands", "initial-height", "body", NULL};
static const char *const MAPS[] = {"viridis", "cividis", NULL};
static const char *const PROJECTIONS[] = {"orthographic", "perspective", NULL};

/* Choices are stored as places in their lists: these must not drift apart. */
_Static_assert(CLAST_LAW_HERTZ_A00 == 0 && CLAST_LAW_HERTZ_MINDLIN == 1 &&
               CLAST_LAW_LINEAR == 2 && CLAST_LAW_MAW == 3 && CLAST_LAW_HOOKE == 4 &&
               CLAST_LAW_HERTZ_BRILLIANTOV == 5 && CLAST_LAW_WALTON_BRAUN == 6 &&
               CLAST_LAW_USER == 7, "");
_Static_assert(CLAST_TANGENT_BY_LAW == 0 && CLAST_TANGENT_SPRING == 1 &&
               CLAST_TANGENT_VISCOUS == 2, "");
_Static_assert(CLAST_CLUMP_EACH == 0 && CLAST_CLUMP_SHARED == 1, "");
_Static_assert(CLAST_LIMIT_TOTAL == 0 && CLAST_LIMIT_SPRING == 1, "");
_Static_assert(CLAST_UNLOAD_RESCALE == 0 && CLAST_UNLOAD_AS_PRINTED == 1, "");
_Static_assert(CLAST_OUTSIDE_STOP == 0 && CLAST_OUTSIDE_REMOVE == 1, "");
_Static_assert(CLAST_GUARD_STOP == 0 && CLAST_GUARD_REPORT == 1, "");
_Static_assert(CLAST_ISA_AUTO == 0 && CLAST_ISA_BASELINE == 1 && CLAST_ISA_AVX2 == 2 &&
               CLAST_ISA_AVX512 == 3, "");
/* a test has the names */
_Static_assert(sizeof SCHEMES / sizeof *SCHEMES == CLAST_SCHEMES + 1, "");
_Static_assert(MASS_AUTO == 0 && MASS_SOLID == 1 && MASS_UNION == 2, "");
_Static_assert(CLAST_SOLVER_CONJUGATE_GRADIENT == 0 && CLAST_SOLVER_GAUSS_SEIDEL == 1, "");
_Static_assert(CLAST_PRECISION_DOUBLE == 0 && CLAST_PRECISION_MIXED == 1, "");
_Static_assert(COLOUR_SPEED == 0 && COLOUR_SPEED_BANDS == 1 && COLOUR_INITIAL_HEIGHT == 2 &&
               COLOUR_BODY == 3, "");

/* ---- contact, materials, pairs --------------------------------------------------------------- */

#define TARGET scene_draft
static const scene_key CONTACT_KEYS[] = {
    {"law", KEY_CHOICE, FIELD(def.law), .choices = LAWS, .fallback = "hertz-mindlin",
     .meaning = "contact law of all pairs; user: a function of your own (engine/clast_law.h)"},
    {"library", KEY_FILE, FIELD(library),
     .meaning = "shared object that holds the law of your own; needed by law user alone"},
    {"function", KEY_TEXT, FIELD(function),
     .meaning = "name of its clast_law_entry in there; needed by law user alone"},
    {"tangent", KEY_CHOICE, FIELD(def.tangent), .choices = TANGENTS, .fallback = "by-law",
     .meaning = "friction before it slides: spring and dashpot, or the dashpot alone (by-law: "
                "hooke, hertz-brilliantov, walton-braun)"},
    {"friction_limit", KEY_CHOICE, FIELD(def.limit), .choices = LIMITS, .fallback = "total",
     .meaning = "Coulomb limit: friction times spring and dashpot force, or spring force alone"},
    {"unloading", KEY_CHOICE, FIELD(def.unloading), .choices = UNLOADINGS, .fallback = "rescale",
     .meaning = "tangential spring when the normal load falls; as-printed can create energy"},
    {"global_damping", KEY_NUMBER, UNIT_RATE, FIELD(def.global_damping), FROM(0),
     .fallback = "0 /s", .meaning = "damping of every motion"},
    {"clump_contact", KEY_CHOICE, FIELD(def.clump_contact), .choices = CLUMP_CONTACTS,
     .fallback = "shared",
     .meaning = "dashpots where two bodies touch at several spheres: one in each contact, so that "
                "damping grows with their number, or one shared by all; clumps of "
                "hertz-brilliantov, walton-braun and user need each"},
};
TABLE(CONTACT, "contact", scene_draft, CONTACT_KEYS);

#undef TARGET
#define TARGET material_item
static const scene_key MATERIAL_KEYS[] = {
    {"density", KEY_NUMBER, UNIT_DENSITY, FIELD(def.density), ABOVE(0), .required = true,
     .meaning = "of the solid"},
    {"young", KEY_NUMBER, UNIT_PRESSURE, FIELD(def.young), ABOVE(0), .required = true,
     .meaning = "Young's modulus"},
    {"poisson", KEY_NUMBER, UNIT_NUMBER, FIELD(def.poisson), WITHIN(-1, 0.5), .required = true,
     .meaning = "Poisson's ratio"},
};
TABLE(MATERIAL, "materials.NAME", material_item, MATERIAL_KEYS);

#undef TARGET
#define TARGET pair_item
static const scene_key PAIR_KEYS[] = {
    {"between", KEY_NAMES, FIELD(between), .refers = "materials", .required = true,
     .meaning = "the two materials; every pair that can touch must be stated, none is mixed"},
    {"restitution", KEY_NUMBER, UNIT_NUMBER, FIELD(def.restitution), UP_TO(0, 1),
     .meaning = "rebound over impact speed of a single collision; needed unless dissipation is "
                "given or the law is one of your own"},
    {"friction", KEY_NUMBER, UNIT_NUMBER, FIELD(def.friction), FROM(0), .required = true,
     .meaning = "Coulomb coefficient"},
    {"cohesion", KEY_NUMBER, UNIT_FORCE, FIELD(def.cohesion), FROM(0), .fallback = "0 N",
     .meaning = "added to the friction limit"},
    {"stiffness", KEY_NUMBER, UNIT_STIFFNESS, FIELD(def.stiffness), ABOVE(0),
     .meaning = "normal stiffness, of loading; needed by linear and walton-braun, used by no "
                "other"},
    {"tangential_ratio", KEY_NUMBER, UNIT_NUMBER, FIELD(def.tangential_ratio), ABOVE(0),
     .word = "auto", .fallback = "auto",
     .meaning = "tangential over normal stiffness, of linear, maw, hooke and walton-braun; auto: "
                "2/7 with a tangential spring, 1 without"},
    {"tangential_restitution", KEY_NUMBER, UNIT_NUMBER, FIELD(def.tangential_restitution),
     UP_TO(0, 1), .word = "auto", .fallback = "auto",
     .meaning = "e_t of S12 2.34 for the tangential dashpot, of all laws but hertz-brilliantov; "
                "auto: its normal damping ratio"},
    {"rolling_friction", KEY_NUMBER, UNIT_NUMBER, FIELD(def.rolling_friction), FROM(0),
     .fallback = "0", .meaning = "couple over normal force times effective radius (S12 2.53)"},
    {"dissipation", KEY_NUMBER, UNIT_TIME, FIELD(def.dissipation), ABOVE(0),
     .meaning = "A of hertz-brilliantov (S12 2.37), in place of restitution"},
    {"reference_speed", KEY_NUMBER, UNIT_SPEED, FIELD(def.reference_speed), ABOVE(0),
     .word = "auto", .fallback = "auto",
     .meaning = "impact speed at which hertz-brilliantov rebounds with restitution; auto: "
                "time.impact_speed"},
    {"parameters", KEY_VALUES, FIELD(def.parameter), .length = CLAST_LAW_PARAMETERS,
     .meaning = "numbers of a law of your own, in the order in which it reads them; those left out "
                "are 0"},
};
TABLE(PAIR, "pairs[]", pair_item, PAIR_KEYS);

/* ---- shapes ---------------------------------------------------------------------------------- */

#undef TARGET
#define TARGET element_item
static const scene_key ELEMENT_KEYS[] = {
    {"centre", KEY_VECTOR, UNIT_LENGTH, FIELD(centre), ANY, .required = true,
     .meaning = "in the body frame: origin at the centre of mass, principal axes"},
    {"radius", KEY_NUMBER, UNIT_LENGTH, FIELD(radius), ABOVE(0), .required = true,
     .meaning = "of the sphere"},
};
TABLE(ELEMENT, "shapes.NAME.spheres[]", element_item, ELEMENT_KEYS);

#undef TARGET
#define TARGET shape_item
static const scene_key FIT_KEYS[] = {
    {"ellipse", KEY_NUMBERS, UNIT_LENGTH, FIELD(ellipse), ABOVE(0), .length = 2, .required = true,
     .meaning = "half axes a >= b of the profile, a along x of the body"},
    {"spheres", KEY_COUNT, FIELD(fit_spheres), RANGE(1, 1000), .required = true,
     .meaning = "number of spheres along the major axis, each touching the profile"},
};
TABLE(FIT, "shapes.NAME.fit", shape_item, FIT_KEYS);

static const scene_key CHAIN_KEYS[] = {
    {"spheres", KEY_COUNT, FIELD(chain_spheres), RANGE(1, 1000), .required = true,
     .meaning = "number of equal spheres along x of the body"},
    {"radius", KEY_NUMBER, UNIT_LENGTH, FIELD(radius), ABOVE(0), .required = true,
     .meaning = "of each"},
    {"spacing", KEY_NUMBER, UNIT_LENGTH, FIELD(chain_spacing), ABOVE(0), .required = true,
     .meaning = "between neighbouring centres; below two radii they overlap"},
};
TABLE(CHAIN, "shapes.NAME.chain", shape_item, CHAIN_KEYS);

#undef TARGET
#define TARGET size_rule
static const scene_key SIZE_KEYS[] = {
    {"uniform", KEY_NUMBERS, UNIT_NUMBER, FIELD(uniform), ABOVE(0), .length = 2, .one_of = true,
     .meaning = "smallest and largest scale factor"},
    {"normal", KEY_NUMBERS, UNIT_NUMBER, FIELD(normal), ABOVE(0), .length = 2, .one_of = true,
     .meaning = "mean and standard deviation of the scale factor; needs between"},
    {"log_normal", KEY_NUMBERS, UNIT_NUMBER, FIELD(log_normal), ABOVE(0), .length = 2,
     .one_of = true,
     .meaning = "median and geometric standard deviation (> 1) of the scale factor"},
    {"table", KEY_FILE, FIELD(table), .one_of = true,
     .meaning = "grading curve, columns size,number or size,mass: scale factor and the share, from "
                "0 to 1, of bodies or of mass up to it; straight between rows"},
    {"between", KEY_NUMBERS, UNIT_NUMBER, FIELD(between), ABOVE(0), .length = 2,
     .meaning = "cuts normal and log_normal off"},
    {"classes", KEY_COUNT, FIELD(classes), RANGE(1, 1000), .fallback = "20",
     .meaning = "templates that stand for equally many bodies each, scaled by the median of their "
                "class; no share is off by more than 1 / (2 classes)"},
};
TABLE(SIZE, "shapes.NAME.size", size_rule, SIZE_KEYS);

#undef TARGET
#define TARGET shape_item
#define MEASURE(name, place, text)                                                                 \
    {name, KEY_NUMBER, UNIT_LENGTH, FIELD(solid[place]), ABOVE(0), .required = true,               \
     .meaning = (text)}
#define SOLID(name) TABLE(name##_SOLID, "shapes.NAME.solid." #name, shape_item, name##_KEYS_OF)

/* Measures stand in the order of shapes/solid.c; a test compares the names. */
static const scene_key sphere_KEYS_OF[] = {MEASURE("radius", 0, "of the sphere")};
static const scene_key ellipsoid_KEYS_OF[] = {MEASURE("a", 0, "half axis along x"),
                                              MEASURE("b", 1, "half axis along y"),
                                              MEASURE("c", 2, "half axis along z")};
static const scene_key cylinder_KEYS_OF[] = {MEASURE("radius", 0, "across x"),
                                             MEASURE("length", 1, "along x")};
static const scene_key cube_KEYS_OF[] = {MEASURE("edge", 0, "along x, y and z")};
static const scene_key block_KEYS_OF[] = {MEASURE("length", 0, "along x"),
                                          MEASURE("height", 1, "along y"),
                                          MEASURE("width", 2, "along z")};
static const scene_key parallelepiped_KEYS_OF[] = {MEASURE("length", 0, "along x"),
                                                   MEASURE("side", 1, "along y and z")};
static const scene_key tetrahedron_KEYS_OF[] = {MEASURE("edge", 0, "of all six")};
static const scene_key cone_KEYS_OF[] = {MEASURE("radius", 0, "of the base"),
                                         MEASURE("length", 1, "from the base to the tip, along x")};
static const scene_key double_cone_KEYS_OF[] = {MEASURE("radius", 0, "in the middle"),
                                                MEASURE("length", 1, "from tip to tip, along x")};
static const scene_key hyperboloid_KEYS_OF[] = {MEASURE("end_radius", 0, "not below the next"),
                                                MEASURE("waist_radius", 1, "in the middle"),
                                                MEASURE("length", 2, "along x")};
static const scene_key barrel_KEYS_OF[] = {MEASURE("end_radius", 0, "not above the next"),
                                           MEASURE("middle_radius", 1, "in the middle"),
                                           MEASURE("length", 2, "along x")};
static const scene_key disc_KEYS_OF[] = {
    MEASURE("outer_radius", 0, "across x"),
    {"inner_radius", KEY_NUMBER, UNIT_LENGTH, FIELD(solid[1]), FROM(0), .required = true,
     .meaning = "of the hole; 0: none"},
    MEASURE("thickness", 2, "along x")};
static const scene_key torus_KEYS_OF[] = {MEASURE("tube_radius", 0, "not above the next"),
                                          MEASURE("ring_radius", 1, "about z")};
SOLID(sphere);
SOLID(ellipsoid);
SOLID(cylinder);
SOLID(cube);
SOLID(block);
SOLID(parallelepiped);
SOLID(tetrahedron);
SOLID(cone);
TABLE(double_cone_SOLID, "shapes.NAME.solid.double-cone", shape_item, double_cone_KEYS_OF);
SOLID(hyperboloid);
SOLID(barrel);
SOLID(disc);
SOLID(torus);

#define ONE_SOLID(word, table)                                                                     \
    {word, KEY_SECTION, .section = &table##_SOLID, .one_of = true,                                 \
     .meaning = "S12 2.9; centre of mass and axes of the body are those of the solid"}
static const scene_key THIRTEEN_KEYS[] = {
    ONE_SOLID("sphere", sphere),
    ONE_SOLID("ellipsoid", ellipsoid),
    ONE_SOLID("cylinder", cylinder),
    ONE_SOLID("cube", cube),
    ONE_SOLID("block", block),
    ONE_SOLID("parallelepiped", parallelepiped),
    ONE_SOLID("tetrahedron", tetrahedron),
    ONE_SOLID("cone", cone),
    ONE_SOLID("double-cone", double_cone),
    ONE_SOLID("hyperboloid", hyperboloid),
    ONE_SOLID("barrel", barrel),
    ONE_SOLID("disc", disc),
    ONE_SOLID("torus", torus),
};
TABLE(THIRTEEN, "shapes.NAME.solid", shape_item, THIRTEEN_KEYS);

static const scene_key FILL_KEYS[] = {
    {"density", KEY_NUMBER, UNIT_NUMBER, FIELD(fill.density), RANGE(1, 100),
     .meaning = "sub-shape packing density: as near as a row of equal spheres with so many centres "
                "to a diameter is to its cylinder; 2 when nothing is asked for"},
    {"spheres", KEY_COUNT, FIELD(fill.spheres), RANGE(1, 1000),
     .meaning = "so many; fewer where rings and mirror images do not come out even"},
    {"levels", KEY_VALUES, FIELD(fill.levels), .length = 8,
     .meaning = "numbers of spheres of the levels of detail, in place of spheres"},
    {"level", KEY_COUNT, FIELD(fill.level), RANGE(1, 8), .fallback = "1",
     .meaning = "which of them, from 1"},
    {"deviation", KEY_NUMBER, UNIT_LENGTH, FIELD(fill.deviation), ABOVE(0),
     .meaning = "no place of the surface is farther from the spheres"},
    {"smallest", KEY_NUMBER, UNIT_LENGTH, FIELD(fill.smallest), ABOVE(0),
     .meaning = "no sphere has a smaller radius"},
};
TABLE(FILL, "shapes.NAME.fill", shape_item, FILL_KEYS);

static const scene_key SHAPE_KEYS[] = {
    {"material", KEY_NAME, FIELD(material), .refers = "materials", .required = true,
     .meaning = "what it is made of"},
    {"radius", KEY_NUMBER, UNIT_LENGTH, FIELD(radius), ABOVE(0), .one_of = true,
     .meaning = "a single sphere"},
    {"spheres", KEY_LIST, FIELD(spheres), .section = &ELEMENT, .one_of = true,
     .meaning = "a rigid clump of spheres"},
    {"fit", KEY_SECTION, .section = &FIT, .one_of = true,
     .meaning = "spheres fitted to an elliptic profile (A00 2.2.2)"},
    {"chain", KEY_SECTION, .section = &CHAIN, .one_of = true,
     .meaning = "a straight row of equal spheres"},
    {"solid", KEY_SECTION, .section = &THIRTEEN, .one_of = true,
     .meaning = "one of thirteen solids, filled with spheres"},
    {"profile", KEY_FILE, FIELD(profile), .one_of = true,
     .meaning = "table x,radius: the outline of a body of revolution, with spheres on its axis "
                "(A00 2.2.2)"},
    {"mesh", KEY_FILE, FIELD(mesh), .one_of = true,
     .meaning = "closed surface (STL, OBJ, PLY, ...), filled with spheres"},
    {"unit", KEY_NUMBER, UNIT_LENGTH, FIELD(file_unit), ABOVE(0), .fallback = "1 m",
     .meaning = "of the lengths in profile or mesh"},
    {"fill", KEY_SECTION, .section = &FILL,
     .meaning = "how many spheres for solid, profile or mesh: until the first of these is met"},
    {"mass_from", KEY_CHOICE, FIELD(mass_from), .choices = MASSES, .fallback = "auto",
     .meaning = "whose mass, centre and axes: of the solid, or of the union of the spheres; auto: "
                "of the solid where there is one"},
    {"mass", KEY_NUMBER, UNIT_MASS, FIELD(mass), ABOVE(0), .word = "auto", .fallback = "auto",
     .meaning = "auto: from the density; overlapping spheres need a number, or mass_from"},
    {"inertia", KEY_VECTOR, UNIT_INERTIA, FIELD(inertia), ABOVE(0), .word = "auto",
     .fallback = "auto",
     .meaning = "principal moments about x, y, z of the body; auto as for mass"},
    {"outline", KEY_POINTS, UNIT_LENGTH, FIELD(outline), ANY,
     .meaning = "[[x, z], ...] of the profile, for drawing; a fit brings its ellipse"},
    {"size", KEY_PART, FIELD(size), .section = &SIZE,
     .meaning = "bodies of many sizes: scale factors of the shape as it stands here, mass with the "
                "cube, inertia with the fifth power"},
};
TABLE(SHAPE, "shapes.NAME", shape_item, SHAPE_KEYS);

/* ---- bodies ---------------------------------------------------------------------------------- */

#undef TARGET
#define TARGET mixture_item
static const scene_key MIXTURE_KEYS[] = {
    {"shape", KEY_NAME, FIELD(shape), .refers = "shapes", .required = true,
     .meaning = "one of those that are mixed"},
    {"number", KEY_NUMBER, UNIT_NUMBER, FIELD(number), UP_TO(0, 1), .one_of = true,
     .meaning = "its share of the bodies; all shares add up to 100 %, counts are exact (largest "
                "remainder)"},
    {"mass", KEY_NUMBER, UNIT_NUMBER, FIELD(mass), UP_TO(0, 1), .one_of = true,
     .meaning = "its share of the mass, of all entries or of none; exact to one body"},
};
TABLE_FOR_ALL(SCHEMA_MIXTURE, "bodies[].grid.mixture[], feeds.NAME.mixture[]", mixture_item,
              MIXTURE_KEYS);

#undef TARGET
#define TARGET generator
static const scene_key REGION_KEYS[] = {
    {"min", KEY_VECTOR, UNIT_LENGTH, FIELD(region_min), ANY, .required = true,
     .meaning = "lowest corner"},
    {"max", KEY_VECTOR, UNIT_LENGTH, FIELD(region_max), ANY, .required = true,
     .meaning = "highest corner; equal to min in a direction: centres lie there, one layer"},
};
TABLE(REGION, "bodies[].grid.region", generator, REGION_KEYS);

#define SHAPE_KEY                                                                                  \
    {"shape", KEY_NAME, FIELD(shape), .refers = "shapes", .one_of = true,                          \
     .meaning = "of every body placed"},                                                           \
    {"mixture", KEY_LIST, FIELD(mixture), .section = &SCHEMA_MIXTURE, .one_of = true, \
     .meaning = "several shapes with their shares"}
#define REGION_KEY                                                                                 \
    {"region", KEY_SECTION, .section = &REGION, .required = true,                                  \
     .meaning = "box that holds their bounding spheres"}
#define MOTION_KEYS(rule)                                                                          \
    {"orientation", KEY_CHOICE, FIELD(orientation), .choices = ORIENTATIONS, .fallback = (rule),   \
     .meaning = "random: uniform on all rotations, in-plane motion: about its normal"},  \
    {"turn", KEY_PART, FIELD(turn),                                                                \
     .section = &SCHEMA_TURN, .meaning = "of orientation fixed"},                                  \
    {"velocity", KEY_VECTOR, UNIT_SPEED, FIELD(velocity), ANY, .fallback = "[0, 0, 0]",            \
     .meaning = "of every body"},                                                                  \
    {"spin", KEY_VECTOR, UNIT_SPIN, FIELD(spin), ANY, .fallback = "[0, 0, 0]",                     \
     .meaning = "of every body, world frame"}
#define COUNT_KEY                                                                                  \
    {"count", KEY_COUNT, FIELD(count), RANGE(1, 10000000), .word = "all", .fallback = "all",       \
     .meaning = "all: as many as the region holds"}
#define SPACING_KEY                                                                                \
    {"spacing", KEY_SPACING, UNIT_LENGTH, FIELD(spacing), ABOVE(0), .required = true,              \
     .meaning = "between neighbouring centres; one length, or one for each of x, y, z"}
#define JITTER_KEY                                                                                 \
    {"jitter", KEY_NUMBER, UNIT_NUMBER, FIELD(jitter), RANGE(0, 1), .fallback = "0",               \
     .meaning = "random shift, as a fraction of the gap between bounding spheres"}

static const scene_key GRID_KEYS[] = {SHAPE_KEY,   COUNT_KEY,  REGION_KEY,
                                      SPACING_KEY, JITTER_KEY, MOTION_KEYS("fixed")};
TABLE(GRID, "bodies[].grid", generator, GRID_KEYS);

static const scene_key HEXAGONAL_KEYS[] = {
    SHAPE_KEY, COUNT_KEY, REGION_KEY,
    {"spacing", KEY_NUMBER, UNIT_LENGTH, FIELD(spacing.x), ABOVE(0), .required = true,
     .meaning = "between neighbouring centres"},
    JITTER_KEY, MOTION_KEYS("fixed")};
TABLE(HEXAGONAL, "bodies[].hexagonal", generator, HEXAGONAL_KEYS);

static const scene_key RANDOM_KEYS[] = {
    SHAPE_KEY,
    {"count", KEY_COUNT, FIELD(count), RANGE(1, 10000000), .required = true,
     .meaning = "fewer than these placed is a fault"},
    REGION_KEY,
    {"gap", KEY_NUMBER, UNIT_LENGTH, FIELD(gap), FROM(0), .fallback = "0 m",
     .meaning = "least gap between bounding spheres, those of earlier entries too"},
    {"attempts", KEY_COUNT, FIELD(attempts), RANGE(1, 1000000), .fallback = "1000",
     .meaning = "tries for one body before giving up"},
    MOTION_KEYS("random")};
TABLE(RANDOM, "bodies[].random", generator, RANDOM_KEYS);

#undef TARGET
#define TARGET body_item
static const scene_key BODY_KEYS[] = {
    {"shape", KEY_NAME, FIELD(shape), .refers = "shapes", .one_of = true,
     .meaning = "a single body, with the next four keys"},
    {"position", KEY_VECTOR, UNIT_LENGTH, FIELD(position), ANY,
     .meaning = "of its centre of mass; needed by a single body"},
    {"orientation", KEY_PART, FIELD(turn),
     .section = &SCHEMA_TURN, .meaning = "default: not turned"},
    {"velocity", KEY_VECTOR, UNIT_SPEED, FIELD(velocity), ANY, .fallback = "[0, 0, 0]",
     .meaning = "of its centre of mass"},
    {"spin", KEY_VECTOR, UNIT_SPIN, FIELD(spin), ANY, .fallback = "[0, 0, 0]",
     .meaning = "world frame"},
    {"grid", KEY_PART, FIELD(grid), .section = &GRID, .one_of = true,
     .meaning = "many bodies on a rectangular grid, filled along x, then y, then z"},
    {"hexagonal", KEY_PART, FIELD(hexagonal), .section = &HEXAGONAL, .one_of = true,
     .meaning = "many bodies, closest packing of spheres (of discs, in one layer)"},
    {"random", KEY_PART, FIELD(random), .section = &RANDOM, .one_of = true,
     .meaning = "many bodies, one after the other where there is room"},
    {"csv", KEY_FILE, FIELD(csv), .one_of = true,
     .meaning =
         "table with columns shape, x, y, z and, if given, qw qx qy qz vx vy vz wx wy wz; SI"},
    {"from", KEY_FILE, FIELD(from), .one_of = true,
     .meaning =
         "folder of an earlier run, or its checkpoint: bodies with motion and contact history"},
};
TABLE(BODY, "bodies[]", body_item, BODY_KEYS);

/* ---- time, domain, guards, engine, output ---------------------------------------------------- */

#undef TARGET
#define TARGET scene_draft
static const scene_key REST_KEYS[] = {
    {"speed", KEY_NUMBER, UNIT_SPEED, FIELD(ending.rest_speed), ABOVE(0), .required = true,
     .meaning = "no body faster than this ..."},
    {"for", KEY_NUMBER, UNIT_TIME, FIELD(ending.rest_for), ABOVE(0), .required = true,
     .meaning = "... for so long ends the run"},
};
TABLE(REST, "time.at_rest", scene_draft, REST_KEYS);

static const scene_key NEWTON_KEYS[] = {
    {"tolerance", KEY_NUMBER, UNIT_NUMBER, FIELD(def.newton_tolerance), WITHIN(0, 1),
     .fallback = "1e-10",
     .meaning = "no body moves farther in the last iteration, of the smallest radius"},
    {"iterations", KEY_COUNT, FIELD(def.newton_iterations), RANGE(1, 10000), .fallback = "200",
     .meaning = "most in a step; more are a failure for the guards"},
    {"solver", KEY_CHOICE, FIELD(def.linear_solver), .choices = SOLVERS,
     .fallback = "conjugate-gradient", .meaning = "of the linear system of an iteration"},
};
TABLE(NEWTON, "time.newton", scene_draft, NEWTON_KEYS);

static const scene_key TIME_KEYS[] = {
    {"end", KEY_NUMBER, UNIT_TIME, FIELD(ending.latest), ABOVE(0), .required = true,
     .meaning = "simulated time at which the run ends at the latest"},
    {"at_rest", KEY_SECTION, .section = &REST, .meaning = "ends the run earlier; default: never"},
    {"step", KEY_NUMBER, UNIT_TIME, FIELD(def.time_step), ABOVE(0), .word = "auto",
     .fallback = "auto", .meaning = "auto: the smaller of the next two limits"},
    {"rayleigh_fraction", KEY_NUMBER, UNIT_NUMBER, FIELD(def.rayleigh_fraction), UP_TO(0, 1),
     .fallback = "0.2", .meaning = "of the Rayleigh step of the smallest sphere"},
    {"contact_resolution", KEY_NUMBER, UNIT_NUMBER, FIELD(def.contact_resolution), FROM(5),
     .fallback = "30", .meaning = "steps in the shortest expected contact"},
    {"impact_speed", KEY_NUMBER, UNIT_SPEED, FIELD(def.impact_speed), ABOVE(0), .word = "auto",
     .fallback = "auto", .meaning = "fastest expected impact; auto: of a fall through the domain"},
    {"scheme", KEY_CHOICE, FIELD(def.scheme), .choices = SCHEMES, .fallback = "leapfrog",
     .meaning = "of integration; all but leapfrog are for studies and slow"},
    {"newton", KEY_SECTION, .section = &NEWTON, .meaning = "implicit schemes alone"},
};
TABLE(TIME, "time", scene_draft, TIME_KEYS);

static const scene_key DOMAIN_KEYS[] = {
    {"min", KEY_VECTOR, UNIT_LENGTH, FIELD(def.domain_min), ANY,
     .fallback = "[-10 m, -10 m, -10 m]", .meaning = "lowest corner of where bodies may be"},
    {"max", KEY_VECTOR, UNIT_LENGTH, FIELD(def.domain_max), ANY,
     .fallback = "[10 m, 10 m, 10 m]", .meaning = "highest corner"},
    {"outside", KEY_CHOICE, FIELD(def.outside), .choices = OUTSIDES, .fallback = "stop",
     .meaning = "what happens when the centre of a body leaves"},
    {"periodic", KEY_AXES, FIELD(def.periodic), .choices = AXES,
     .meaning = "the two faces across these axes are one: what leaves by one comes in by the other "
                "and is felt across it; default: none"},
};
TABLE(DOMAIN, "domain", scene_draft, DOMAIN_KEYS);

static const scene_key GUARD_KEYS[] = {
    {"mode", KEY_CHOICE, FIELD(def.guards), .choices = GUARDS, .fallback = "stop",
     .meaning = "a guard that trips stops the run, or is only reported"},
    {"overlap", KEY_NUMBER, UNIT_NUMBER, FIELD(def.max_overlap), ABOVE(0), .fallback = "0.05",
     .meaning = "largest overlap, of the smaller radius"},
    {"displacement", KEY_NUMBER, UNIT_NUMBER, FIELD(def.max_displacement), ABOVE(0),
     .fallback = "0.1", .meaning = "largest motion in one step, of the smallest radius"},
    {"residual", KEY_NUMBER, UNIT_NUMBER, FIELD(def.max_residual), ABOVE(0), .fallback = "0.05",
     .meaning = "largest error of the energy balance, of the energy put in"},
};
TABLE(GUARD, "guards", scene_draft, GUARD_KEYS);

static const scene_key ENGINE_KEYS[] = {
    {"threads", KEY_COUNT, FIELD(def.threads), RANGE(1, 1024), .word = "auto", .fallback = "auto",
     .meaning = "at most (auto: the cores); as many as pay for the spheres are used"},
    {"spheres_per_thread", KEY_COUNT, FIELD(def.spheres_per_thread), RANGE(1, 1000000),
     .fallback = "500", .meaning = "so many spheres pay for a thread; 1: all threads are used"},
    {"isa", KEY_CHOICE, FIELD(def.isa), .choices = ISAS, .fallback = "auto",
     .meaning = "vector lanes"},
    {"skin", KEY_NUMBER, UNIT_LENGTH, FIELD(def.skin), ABOVE(0), .word = "auto", .fallback = "auto",
     .meaning = "extra reach of the list of neighbours"},
};
TABLE(ENGINE, "engine", scene_draft, ENGINE_KEYS);

static const scene_key OUTPUT_KEYS[] = {
    {"frames", KEY_INTERVAL, UNIT_TIME, FIELD(output.frame_every), ABOVE(0), .word = "none",
     .fallback = "25 /s", .meaning = "frames in run.h5"},
    {"series", KEY_INTERVAL, UNIT_TIME, FIELD(output.series_every), ABOVE(0), .fallback = "100 /s",
     .meaning = "lines in series.csv"},
    {"checkpoint", KEY_INTERVAL, UNIT_TIME, FIELD(output.checkpoint_every), ABOVE(0),
     .word = "end", .fallback = "end", .meaning = "checkpoints; end: only one, at the end"},
    {"contacts", KEY_SWITCH, FIELD(output.contacts), .fallback = "false",
     .meaning = "contact network in every frame"},
};
TABLE(OUTPUT, "output", scene_draft, OUTPUT_KEYS);

/* ---- measures -------------------------------------------------------------------------------- */

#undef TARGET
#define TARGET measure_item
static const scene_key DISCHARGED_KEYS[] = {
    {"level", KEY_NUMBER, UNIT_LENGTH, FIELD(discharged.level), ANY, .required = true,
     .meaning = "height z of the orifice"},
};
TABLE(DISCHARGED, "measures.NAME.discharged", measure_item, DISCHARGED_KEYS);

static const scene_key REMAINING_KEYS[] = {
    {"level", KEY_NUMBER, UNIT_LENGTH, FIELD(remaining.level), ANY, .required = true,
     .meaning = "height z of the orifice"},
};
TABLE(REMAINING, "measures.NAME.remaining", measure_item, REMAINING_KEYS);

static const scene_key SOLID_KEYS[] = {
    {"level", KEY_NUMBER, UNIT_LENGTH, FIELD(solid_fraction.level), ANY, .required = true,
     .meaning = "height z of the floor"},
    {"x", KEY_NUMBERS, UNIT_LENGTH, FIELD(bed_x), ANY, .length = 2, .required = true,
     .meaning = "from, to: the width of the bed"},
    {"sections", KEY_COUNT, FIELD(solid_fraction.sections), RANGE(1, 10000), .fallback = "10",
     .meaning = "columns that the surface is read in"},
    {"body_area", KEY_NUMBER, UNIT_AREA, FIELD(solid_fraction.body_area), ABOVE(0),
     .required = true, .meaning = "projected area of one body"},
};
TABLE(SOLID, "measures.NAME.solid_fraction", measure_item, SOLID_KEYS);

static const scene_key BAND_KEYS[] = {
    {"level", KEY_NUMBER, UNIT_LENGTH, FIELD(band_velocity.level), ANY, .required = true,
     .meaning = "height z of the orifice"},
    {"height", KEY_NUMBER, UNIT_LENGTH, FIELD(band_velocity.height), ANY, .required = true,
     .meaning = "of the middle of the band above the level"},
    {"thickness", KEY_NUMBER, UNIT_LENGTH, FIELD(band_velocity.thickness), ABOVE(0),
     .required = true, .meaning = "of the band"},
    {"x", KEY_NUMBERS, UNIT_LENGTH, FIELD(band_x), ANY, .length = 2, .required = true,
     .meaning = "from, to: the width of the band"},
};
TABLE(BAND, "measures.NAME.band_velocity", measure_item, BAND_KEYS);

static const key_section COORDINATION = {.title = "measures.NAME.coordination",
                                         .size = sizeof(measure_item)};

static const scene_key LOAD_KEYS[] = {
    {"part", KEY_NAME, FIELD(part_load.part), .refers = "parts", .required = true,
     .meaning = "whose walls are pushed"},
};
TABLE(LOAD, "measures.NAME.part_load", measure_item, LOAD_KEYS);

static const scene_key PROFILE_KEYS[] = {
    {"part", KEY_NAME, FIELD(load_profile.part), .refers = "parts", .required = true,
     .meaning = "whose walls are pushed"},
    {"level", KEY_NUMBER, UNIT_LENGTH, FIELD(load_profile.level), ANY, .required = true,
     .meaning = "z of the lower end of the lowest section"},
    {"height", KEY_NUMBER, UNIT_LENGTH, FIELD(load_profile.height), ABOVE(0), .required = true,
     .meaning = "of all sections together"},
    {"sections", KEY_COUNT, FIELD(load_profile.sections), RANGE(1, 64), .fallback = "10",
     .meaning = "equal ones, from below"},
};
TABLE(PROFILE, "measures.NAME.load_profile", measure_item, PROFILE_KEYS);

static const scene_key MEASURE_KEYS[] = {
    {"discharged", KEY_SECTION, .section = &DISCHARGED, .one_of = true,
     .meaning = "mass and number that have ever been below a level"},
    {"remaining", KEY_SECTION, .section = &REMAINING, .one_of = true,
     .meaning = "number and mass above a level"},
    {"solid_fraction", KEY_SECTION, .section = &SOLID, .one_of = true,
     .meaning = "area of the bodies over that below the surface of the bed (A00 4.3.1)"},
    {"band_velocity", KEY_SECTION, .section = &BAND, .one_of = true,
     .meaning = "mean and deviation of the vertical velocity in a band"},
    {"coordination", KEY_SECTION, .section = &COORDINATION, .one_of = true,
     .meaning = "mean number of touching partners; {}"},
    {"part_load", KEY_SECTION, .section = &LOAD, .one_of = true,
     .meaning = "force, torque, work and power of a part"},
    {"load_profile", KEY_SECTION, .section = &PROFILE, .one_of = true,
     .meaning = "normal force on a part, by sections of its height (A00 5.3.3.1)"},
};
TABLE(MEASURE, "measures.NAME", measure_item, MEASURE_KEYS);

/* ---- view and the whole ---------------------------------------------------------------------- */

#undef TARGET
#define TARGET scene_draft
static const scene_key BOX_KEYS[] = {
    {"min", KEY_VECTOR, UNIT_LENGTH, FIELD(view.box_min), ANY, .required = true,
     .meaning = "lowest corner"},
    {"max", KEY_VECTOR, UNIT_LENGTH, FIELD(view.box_max), ANY, .required = true,
     .meaning = "highest corner"},
};
TABLE(BOX, "view.box", scene_draft, BOX_KEYS);

static const scene_key VIEW_KEYS[] = {
    {"preset", KEY_TEXT, FIELD(preset), .choices = PRESETS, .fallback = "final",
     .meaning = "fast or fine"},
    {"size", KEY_NUMBERS, UNIT_NUMBER, FIELD(size), RANGE(16, 16384), .length = 2,
     .fallback = "[1280, 720]", .meaning = "width and height in pixels"},
    {"colour", KEY_CHOICE, FIELD(view.colour), .choices = COLOURS, .fallback = "speed",
     .meaning = "what the colour of a body shows"},
    {"map", KEY_TEXT, FIELD(map), .choices = MAPS, .fallback = "viridis",
     .meaning = "colour map of speed"},
    {"speed_max", KEY_NUMBER, UNIT_SPEED, FIELD(view.speed_max), ABOVE(0), .word = "auto",
     .fallback = "auto", .meaning = "top of the colour bar; auto: the fastest of each frame"},
    {"look_from", KEY_VECTOR, UNIT_NUMBER, FIELD(view.look_from), ANY, .fallback = "[0, -1, 0]",
     .meaning = "direction towards the eye"},
    {"up", KEY_VECTOR, UNIT_NUMBER, FIELD(view.up), ANY, .fallback = "[0, 0, 1]",
     .meaning = "what is up in the picture"},
    {"box", KEY_SECTION, .section = &BOX,
     .meaning = "what must be in the picture; default: the domain"},
    {"projection", KEY_CHOICE, FIELD(projection), .choices = PROJECTIONS,
     .fallback = "orthographic", .meaning = "parallel, or from a point"},
    {"walls", KEY_SWITCH, FIELD(view.walls), .fallback = "true",
     .meaning = "draws walls: planes and plates translucent, triangles opaque and tinted by part"},
    {"planes", KEY_SWITCH, FIELD(view.planes), .fallback = "true",
     .meaning = "draws planes and plates among them"},
    {"fps", KEY_NUMBER, UNIT_RATE, FIELD(view.frames_per_second), ABOVE(0), .fallback = "25",
     .meaning = "frames per second of the animation"},
};
TABLE(VIEW, "view", scene_draft, VIEW_KEYS);

static const scene_key SCENE_KEYS[] = {
    {"scene", KEY_TEXT, FIELD(title), .required = true, .meaning = "title"},
    {"parameters", KEY_PARAMETERS,
     .meaning = "name: value; used as $name below, replaced by `--set name=value`"},
    {"gravity", KEY_VECTOR, UNIT_ACCELERATION, FIELD(def.gravity), ANY,
     .fallback = "[0, 0, -9.81 m/s2]", .meaning = "acceleration of free fall"},
    {"motion", KEY_CHOICE, FIELD(motion), .choices = MOTIONS, .fallback = "3d",
     .meaning = "in-plane y: no velocity along y, spin about y alone"},
    {"contact", KEY_SECTION, .section = &CONTACT, .meaning = "how bodies push each other"},
    {"materials", KEY_NAMED, FIELD(materials), .section = &MATERIAL, .required = true,
     .meaning = "elastic constants"},
    {"pairs", KEY_LIST, FIELD(pairs), .section = &PAIR, .required = true,
     .meaning = "contact constants"},
    {"shapes", KEY_NAMED, FIELD(shapes), .section = &SHAPE, .required = true,
     .meaning = "templates of bodies"},
    {"parts", KEY_NAMED, FIELD(parts), .section = &SCHEMA_PART, .meaning = "groups of walls"},
    {"walls", KEY_NAMED, FIELD(walls),
     .section = &SCHEMA_WALL, .meaning = "what bodies bounce off"},
    {"bodies", KEY_LIST, FIELD(bodies), .section = &BODY,
     .meaning = "what moves; ids count up in this order; needed unless there are feeds"},
    {"feeds", KEY_NAMED, FIELD(feeds), .section = &SCHEMA_FEED,
     .meaning = "bodies that come while the scene runs, at a rate"},
    {"outlets", KEY_NAMED, FIELD(outlets), .section = &SCHEMA_OUTLET,
     .meaning = "where bodies leave: by their centre, at the end of a step"},
    {"seed", KEY_SEED, FIELD(seed), RANGE(0, 9007199254740992.0), .fallback = "1",
     .meaning = "of everything random"},
    {"time", KEY_SECTION, .section = &TIME, .required = true, .meaning = "end and step"},
    {"domain", KEY_SECTION, .section = &DOMAIN, .meaning = "where bodies may be"},
    {"guards", KEY_SECTION, .section = &GUARD, .meaning = "when a run has failed"},
    {"precision", KEY_CHOICE, FIELD(def.precision), .choices = PRECISIONS, .fallback = "double",
     .meaning = "of numbers at contacts; mixed: forces, springs and velocities there single"},
    {"turn_spheres", KEY_SWITCH, FIELD(def.turn_spheres), .fallback = "false",
     .meaning = "orientations of single spheres are followed; their spins always are"},
    {"engine", KEY_SECTION, .section = &ENGINE, .meaning = "speed; never changes a result"},
    {"output", KEY_SECTION, .section = &OUTPUT, .meaning = "what is written"},
    {"measures", KEY_NAMED, FIELD(measures), .section = &MEASURE,
     .meaning = "columns of series.csv, prefixed with the name"},
    {"view", KEY_SECTION, .section = &VIEW, .meaning = "pictures"},
};

const key_section SCHEMA_SCENE = {.title = "the scene", .size = sizeof(scene_draft),
                                  .keys = SCENE_KEYS,
                                  .count = (int)(sizeof SCENE_KEYS / sizeof *SCENE_KEYS)};
