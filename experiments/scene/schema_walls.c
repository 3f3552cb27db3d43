#include "experiments/scene/schema_rows.h"

/* clang-format off */

static const char *const FITS[] = {"area", "inside", "outside", NULL};
_Static_assert(MESH_FIT_AREA == 0 && MESH_FIT_INSIDE == 1 && MESH_FIT_OUTSIDE == 2, "");

#define TARGET rotation
static const scene_key TURN_KEYS[] = {
    {"axis", KEY_VECTOR, UNIT_NUMBER, FIELD(axis), ANY, .fallback = "[0, 1, 0]",
     .meaning = "of the rotation; any length"},
    {"angle", KEY_NUMBER, UNIT_ANGLE, FIELD(angle), RANGE(-1e5, 1e5), .one_of = true,
     .meaning = "about the axis, right-handed"},
    {"quaternion", KEY_NUMBERS, UNIT_NUMBER, FIELD(quaternion), ANY, .length = 4, .one_of = true,
     .meaning = "[w, x, y, z], body to world; any length"},
};
TABLE_FOR_ALL(SCHEMA_TURN, "bodies[].orientation, walls.NAME.rotation", rotation, TURN_KEYS);

#undef TARGET
#define TARGET wall_item
static const scene_key PLANE_KEYS[] = {
    {"point", KEY_VECTOR, UNIT_LENGTH, FIELD(plane.point), ANY, .required = true,
     .meaning = "any point of the plane"},
    {"normal", KEY_VECTOR, UNIT_NUMBER, FIELD(plane.normal), ANY, .required = true,
     .meaning = "towards the bodies; any length"},
};
TABLE(PLANE, "walls.NAME.plane", wall_item, PLANE_KEYS);

static const scene_key PLATE_KEYS[] = {
    {"centre", KEY_VECTOR, UNIT_LENGTH, FIELD(plate.point), ANY, .required = true,
     .meaning = "of the rectangle"},
    {"normal", KEY_VECTOR, UNIT_NUMBER, FIELD(plate.normal), ANY, .required = true,
     .meaning = "any length; a plate pushes from both sides"},
    {"side", KEY_VECTOR, UNIT_NUMBER, FIELD(plate.side), ANY, .required = true,
     .meaning = "direction of its first side, at right angles to the normal"},
    {"half", KEY_NUMBERS, UNIT_LENGTH, FIELD(plate.half_side), ABOVE(0), .length = 2,
     .required = true, .meaning = "half lengths along side and along normal x side"},
};
TABLE(PLATE, "walls.NAME.plate", wall_item, PLATE_KEYS);

#define FIT_KEY(place)                                                                             \
    {"fit", KEY_CHOICE, FIELD(place), .choices = FITS, .fallback = "area",                         \
     .meaning = "flat sides against the round wall: the same cross-section, corners on it, or "    \
                "sides touching it from outside"}
#define THICKNESS_KEY(place)                                                                       \
    {"thickness", KEY_NUMBER, UNIT_LENGTH, FIELD(place), FROM(0), .fallback = "0 m",               \
     .meaning = "0: one surface, felt from both sides; above: a closed body around the inside"}
#define SEGMENTS_KEY(place, usual)                                                                 \
    {"segments", KEY_COUNT, FIELD(place), RANGE(3, 100000), .fallback = (usual),                   \
     .meaning = "flat sides around; the error of the radius falls with their square"}

static const scene_key BAR_KEYS[] = {
    {"mesh", KEY_FILE, FIELD(surface.bar_mesh),
     .meaning = "a bar of one's own in the place of these measures: nose at x = 0 pointing to +x, "
                "underside at z = 0, its middle at y = 0"},
    {"unit", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.bar_unit), ABOVE(0), .fallback = "1 m",
     .meaning = "of the lengths in mesh"},
    {"length", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.bar.length), ABOVE(0), .fallback = "190 mm",
     .meaning = "along x, from the back to the nose at x = 0"},
    {"height", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.bar.height), ABOVE(0), .fallback = "30 mm",
     .meaning = "along z, from the underside at z = 0"},
    {"width", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.bar.width), ABOVE(0), .fallback = "1 m",
     .meaning = "along y, half of it on each side"},
    {"nose_radius", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.bar.nose_radius), FROM(0),
     .fallback = "5 mm", .meaning = "rounding between top and front"},
    {"nose_angle", KEY_NUMBER, UNIT_ANGLE, FIELD(surface.bar.nose_angle), RANGE(-1, 1),
     .fallback = "0 deg",
     .meaning = "front against z; above 0 it leans back below, below 0 the foot is foremost"},
    {"undercut", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.bar.undercut), FROM(0), .fallback = "0 m",
     .meaning = "edge between front and underside cut off by so much in both directions"},
    {"segments", KEY_COUNT, FIELD(surface.bar.segments), RANGE(1, 1000), .fallback = "8",
     .meaning = "flat sides of the rounding"},
};
TABLE(BAR, "walls.NAME.bar", wall_item, BAR_KEYS);

static const scene_key TUBE_KEYS[] = {
    {"from", KEY_VECTOR, UNIT_LENGTH, FIELD(surface.tube.from), ANY, .required = true,
     .meaning = "centre of one end"},
    {"to", KEY_VECTOR, UNIT_LENGTH, FIELD(surface.tube.to), ANY, .required = true,
     .meaning = "centre of the other"},
    {"radius", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.tube.radius), ABOVE(0), .required = true,
     .meaning = "inner, at `from`"},
    {"end_radius", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.tube.end_radius), ABOVE(0),
     .word = "same", .fallback = "same", .meaning = "inner, at `to`: a cone, such as a funnel"},
    THICKNESS_KEY(surface.tube.thickness), SEGMENTS_KEY(surface.tube.segments, "48"),
    FIT_KEY(surface.tube.fit)};
TABLE(TUBE, "walls.NAME.tube", wall_item, TUBE_KEYS);

static const scene_key BEND_KEYS[] = {
    {"centre", KEY_VECTOR, UNIT_LENGTH, FIELD(surface.bend.centre), ANY, .required = true,
     .meaning = "of the arc that the pipe follows"},
    {"mouth", KEY_VECTOR, UNIT_LENGTH, FIELD(surface.bend.mouth), ANY, .required = true,
     .meaning = "centre of one end; its distance from `centre` is the bending radius"},
    {"axis", KEY_VECTOR, UNIT_NUMBER, FIELD(surface.bend.axis), ANY, .required = true,
     .meaning = "of the arc, at right angles to the way from centre to mouth; any length"},
    {"angle", KEY_NUMBER, UNIT_ANGLE, FIELD(surface.bend.angle), UP_TO(0, 6.283185307179586),
     .required = true, .meaning = "from the mouth, right-handed about the axis"},
    {"radius", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.bend.radius), ABOVE(0), .required = true,
     .meaning = "of the pipe, inner"},
    THICKNESS_KEY(surface.bend.thickness), SEGMENTS_KEY(surface.bend.segments, "48"),
    {"rings", KEY_COUNT, FIELD(surface.bend.rings), RANGE(1, 100000), .fallback = "24",
     .meaning = "straight pieces along the arc"},
    FIT_KEY(surface.bend.fit)};
TABLE(BEND, "walls.NAME.bend", wall_item, BEND_KEYS);

static const scene_key COPIES_KEYS[] = {
    {"count", KEY_COUNT, FIELD(copies.count), RANGE(2, 10000), .required = true,
     .meaning = "how many there are in all; named NAME-1, NAME-2, ..."},
    {"step", KEY_VECTOR, UNIT_LENGTH, FIELD(copies.step), ANY, .required = true,
     .meaning = "from each to the next"},
    {"parts", KEY_NAME_LIST, FIELD(copies.parts), .refers = "parts",
     .meaning = "the parts they move with, in turn, in place of `part`"},
};
TABLE(COPIES, "walls.NAME.copies", wall_item, COPIES_KEYS);

static const scene_key WALL_KEYS[] = {
    {"part", KEY_NAME, FIELD(part), .refers = "parts",
     .meaning = "the part it moves with; without one it never moves"},
    {"material", KEY_NAME, FIELD(material), .refers = "materials", .required = true,
     .meaning = "what it is made of"},
    {"plane", KEY_SECTION, .section = &PLANE, .one_of = true,
     .meaning = "infinite, solid behind"},
    {"plate", KEY_SECTION, .section = &PLATE, .one_of = true,
     .meaning = "rectangle without thickness"},
    {"mesh", KEY_FILE, FIELD(surface.mesh), .one_of = true,
     .meaning = "triangles (STL, OBJ, PLY, ...), felt from both sides; `clast check` says what was "
                "found and mended"},
    {"bar", KEY_SECTION, .section = &BAR, .one_of = true,
     .meaning = "of a grate (S12 Table 3.3), from measures or a file; {} takes every default"},
    {"tube", KEY_SECTION, .section = &TUBE, .one_of = true,
     .meaning = "straight pipe of triangles (S12 2.9.2)"},
    {"bend", KEY_SECTION, .section = &BEND, .one_of = true,
     .meaning = "curved pipe of triangles (S12 2.9.2)"},
    {"unit", KEY_NUMBER, UNIT_LENGTH, FIELD(surface.unit), ABOVE(0), .fallback = "1 m",
     .meaning = "of the lengths in mesh"},
    {"axes", KEY_TEXT, FIELD(surface.axes), .fallback = "x y z",
     .meaning = "our x, y and z as axes of the file: x -z y stands a file whose y is up upright"},
    {"weld", KEY_NUMBER, UNIT_NUMBER, FIELD(surface.weld), RANGE(1e-12, 1e-2), .fallback = "1e-6",
     .meaning = "vertices of mesh closer than this share of its diagonal become one"},
    {"scale", KEY_NUMBER, UNIT_NUMBER, FIELD(surface.scale), ABOVE(0), .fallback = "1",
     .meaning = "of mesh, bar, tube and bend: enlarged about the origin first"},
    {"rotation", KEY_PART, FIELD(surface.turn), .section = &SCHEMA_TURN,
     .meaning = "of the same: turned about the origin then"},
    {"at", KEY_VECTOR, UNIT_LENGTH, FIELD(surface.at), ANY, .fallback = "[0, 0, 0]",
     .meaning = "of the same: moved there last"},
    {"smooth_angle", KEY_NUMBER, UNIT_ANGLE, FIELD(surface.smooth_angle), WITHIN(0, 1.5707963),
     .word = "none", .fallback = "35 deg",
     .meaning = "flat pieces of the same that meet at a smaller angle are felt as one surface with "
                "one contact; none: every flat piece for itself"},
    {"copies", KEY_SECTION, .section = &COPIES,
     .meaning = "the same wall several times, whatever its kind"},
    {"belt", KEY_VECTOR, UNIT_SPEED, FIELD(belt), ANY, .fallback = "[0, 0, 0]",
     .meaning = "velocity of its surface without motion (conveyor)"},
};
TABLE_FOR_ALL(SCHEMA_WALL, "walls.NAME", wall_item, WALL_KEYS);
