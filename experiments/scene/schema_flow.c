#include "experiments/scene/schema_rows.h"

/* clang-format off */

#define PHASE .range = {0, 1, false, true}

static const char *const FULLS[] = {"wait", "stop", NULL};
static const char *const ORIENTATIONS[] = {"fixed", "random", NULL};
_Static_assert(CLAST_FULL_WAIT == 0 && CLAST_FULL_STOP == 1, "");
_Static_assert(ORIENT_FIXED == 0 && ORIENT_RANDOM == 1, "");

/* ---- how parts move -------------------------------------------------------------------------- */

#define TARGET part_item
static const scene_key STROKE_KEYS[] = {
    {"travel", KEY_VECTOR, UNIT_LENGTH, FIELD(def.stroke.travel), ANY, .required = true,
     .meaning = "from one end to the other"},
    {"speed", KEY_NUMBER, UNIT_SPEED, FIELD(def.stroke.speed), ABOVE(0), .required = true,
     .meaning = "on the way, out and back"},
    {"pause", KEY_NUMBER, UNIT_TIME, FIELD(def.stroke.pause), FROM(0), .fallback = "0 s",
     .meaning = "at each end"},
    {"phase", KEY_NUMBER, UNIT_NUMBER, FIELD(def.stroke.phase), PHASE, .fallback = "0",
     .meaning = "where it starts, as a share of out, pause, back, pause"},
};
TABLE(STROKE, "parts.NAME.stroke", part_item, STROKE_KEYS);

static const scene_key OSCILLATION_KEYS[] = {
    {"amplitude", KEY_VECTOR, UNIT_LENGTH, FIELD(def.oscillation.amplitude), ANY, .required = true,
     .meaning = "to either side"},
    {"frequency", KEY_NUMBER, UNIT_RATE, FIELD(def.oscillation.frequency), ABOVE(0),
     .required = true, .meaning = "periods per second"},
    {"phase", KEY_NUMBER, UNIT_NUMBER, FIELD(def.oscillation.phase), PHASE, .fallback = "0",
     .meaning = "of a period, where it starts"},
};
TABLE(OSCILLATION, "parts.NAME.oscillation", part_item, OSCILLATION_KEYS);

static const scene_key ROTATION_KEYS[] = {
    {"point", KEY_VECTOR, UNIT_LENGTH, FIELD(def.rotation.point), ANY, .fallback = "[0, 0, 0]",
     .meaning = "of the axis, which moves with the part"},
    {"axis", KEY_VECTOR, UNIT_NUMBER, FIELD(def.rotation.axis), ANY, .required = true,
     .meaning = "its direction; any length"},
    {"speed", KEY_NUMBER, UNIT_SPIN, FIELD(def.rotation.speed), ANY, .fallback = "0 rad/s",
     .meaning = "right-handed"},
    {"swing", KEY_NUMBER, UNIT_ANGLE, FIELD(def.rotation.swing), ANY, .fallback = "0 rad",
     .meaning = "to either side, on top of the speed"},
    {"frequency", KEY_NUMBER, UNIT_RATE, FIELD(def.rotation.frequency), FROM(0),
     .fallback = "0 /s", .meaning = "of the swing, periods per second"},
    {"phase", KEY_NUMBER, UNIT_NUMBER, FIELD(def.rotation.phase), PHASE, .fallback = "0",
     .meaning = "of a period of the swing, where it starts"},
};
TABLE(ROTATION, "parts.NAME.rotation", part_item, ROTATION_KEYS);

static const scene_key PART_KEYS[] = {
    {"velocity", KEY_VECTOR, UNIT_SPEED, FIELD(def.velocity), ANY, .fallback = "[0, 0, 0]",
     .meaning = "while it moves"},
    {"stroke", KEY_SECTION, .section = &STROKE,
     .meaning = "out and back at constant speed, with pauses; all motions of a part add up"},
    {"oscillation", KEY_SECTION, .section = &OSCILLATION,
     .meaning = "amplitude sin(2 pi (frequency t + phase))"},
    {"rotation", KEY_SECTION, .section = &ROTATION, .meaning = "about an axis"},
    {"table", KEY_FILE, FIELD(table),
     .meaning = "columns time,x,y,z or time,x,y,z,angle (s, m, rad) since move_from: straight from "
                "row to row; the angle is about the axis of rotation"},
    {"move_from", KEY_NUMBER, UNIT_TIME, FIELD(def.move_from), FROM(0), .fallback = "0 s",
     .meaning = "starts to move, and its belts to run"},
    {"move_until", KEY_NUMBER, UNIT_TIME, FIELD(def.move_until), ABOVE(0), .word = "never",
     .fallback = "never", .meaning = "stops where it is then"},
    {"removed_at", KEY_NUMBER, UNIT_TIME, FIELD(def.removed_at), ABOVE(0), .word = "never",
     .fallback = "never", .meaning = "its walls vanish"},
};
TABLE_FOR_ALL(SCHEMA_PART, "parts.NAME", part_item, PART_KEYS);

/* ---- feeds and outlets ----------------------------------------------------------------------- */

#undef TARGET
#define TARGET feed_item
static const scene_key FEED_REGION_KEYS[] = {
    {"min", KEY_VECTOR, UNIT_LENGTH, FIELD(from.region_min), ANY, .required = true,
     .meaning = "lowest corner"},
    {"max", KEY_VECTOR, UNIT_LENGTH, FIELD(from.region_max), ANY, .required = true,
     .meaning = "highest corner; equal to min in a direction: one layer"},
};
TABLE(FEED_REGION, "feeds.NAME.region", feed_item, FEED_REGION_KEYS);

static const scene_key FEED_KEYS[] = {
    {"shape", KEY_NAME, FIELD(from.shape), .refers = "shapes", .one_of = true,
     .meaning = "of every body; one of many sizes: drawn by number"},
    {"mixture", KEY_LIST, FIELD(from.mixture), .section = &SCHEMA_MIXTURE, .one_of = true,
     .meaning = "several shapes with their shares, drawn body by body"},
    {"rate", KEY_NUMBER, UNIT_MASS_RATE, FIELD(rate), ABOVE(0),
     .meaning = "mass per time: the next body comes when so much is due"},
    {"number_rate", KEY_NUMBER, UNIT_RATE, FIELD(number_rate), ABOVE(0),
     .meaning = "bodies per time, in place of rate"},
    {"region", KEY_SECTION, .section = &FEED_REGION, .required = true,
     .meaning = "box for the centres of mass"},
    {"velocity", KEY_VECTOR, UNIT_SPEED, FIELD(from.velocity), ANY, .fallback = "[0, 0, 0]",
     .meaning = "on arrival"},
    {"spin", KEY_VECTOR, UNIT_SPIN, FIELD(from.spin), ANY, .fallback = "[0, 0, 0]",
     .meaning = "on arrival, world frame"},
    {"orientation", KEY_CHOICE, FIELD(from.orientation), .choices = ORIENTATIONS,
     .fallback = "random", .meaning = "random: uniform, in-plane motion: about its normal"},
    {"turn", KEY_PART, FIELD(from.turn), .section = &SCHEMA_TURN,
     .meaning = "of orientation fixed"},
    {"from", KEY_NUMBER, UNIT_TIME, FIELD(begins), FROM(0), .fallback = "0 s",
     .meaning = "the first body comes"},
    {"until", KEY_NUMBER, UNIT_TIME, FIELD(ends), ABOVE(0), .word = "never", .fallback = "never",
     .meaning = "no more is due"},
    {"attempts", KEY_COUNT, FIELD(from.attempts), RANGE(1, 1000000), .fallback = "100",
     .meaning = "places tried for a body, without overlap; then it waits for a hundred steps"},
    {"full", KEY_CHOICE, FIELD(full), .choices = FULLS, .fallback = "wait",
     .meaning = "no place for a body that is due: it is owed, or the run stops"},
};
TABLE_FOR_ALL(SCHEMA_FEED, "feeds.NAME", feed_item, FEED_KEYS);

#undef TARGET
#define TARGET outlet_item
static const scene_key OUTLET_PLANE_KEYS[] = {
    {"point", KEY_VECTOR, UNIT_LENGTH, FIELD(def.point), ANY, .required = true,
     .meaning = "any point of the plane"},
    {"normal", KEY_VECTOR, UNIT_NUMBER, FIELD(def.normal), ANY, .required = true,
     .meaning = "the way out; any length"},
};
TABLE(OUTLET_PLANE, "outlets.NAME.plane", outlet_item, OUTLET_PLANE_KEYS);

static const scene_key OUTLET_BOX_KEYS[] = {
    {"min", KEY_VECTOR, UNIT_LENGTH, FIELD(def.min), ANY, .required = true,
     .meaning = "lowest corner"},
    {"max", KEY_VECTOR, UNIT_LENGTH, FIELD(def.max), ANY, .required = true,
     .meaning = "highest corner"},
};
TABLE(OUTLET_BOX, "outlets.NAME.box", outlet_item, OUTLET_BOX_KEYS);

static const scene_key OUTLET_KEYS[] = {
    {"plane", KEY_SECTION, .section = &OUTLET_PLANE, .one_of = true,
     .meaning = "what is beyond it leaves"},
    {"box", KEY_SECTION, .section = &OUTLET_BOX, .one_of = true, .meaning = "what is in it leaves"},
};
TABLE_FOR_ALL(SCHEMA_OUTLET, "outlets.NAME", outlet_item, OUTLET_KEYS);
