/* solid.c - names, ranges and closed forms of the thirteen solids. */
#include "shapes/solid.h"

#include <string.h>

#include "shapes/check.h"
#include "shapes/numbers.h"

static const shape_solid_info INFOS[SHAPE_KINDS] = {
    [SHAPE_SPHERE] = {.name = "sphere", .sizes = {"radius"}},
    [SHAPE_ELLIPSOID] = {.name = "ellipsoid", .sizes = {"a", "b", "c"}},
    [SHAPE_CYLINDER] = {.name = "cylinder", .sizes = {"radius", "length"}},
    [SHAPE_CUBE] = {.name = "cube", .sizes = {"edge"}},
    [SHAPE_BLOCK] = {.name = "block", .sizes = {"length", "height", "width"}},
    [SHAPE_PARALLELEPIPED] = {.name = "parallelepiped", .sizes = {"length", "side"}},
    [SHAPE_TETRAHEDRON] = {.name = "tetrahedron", .sizes = {"edge"}},
    [SHAPE_CONE] = {.name = "cone", .sizes = {"radius", "length"}},
    [SHAPE_DOUBLE_CONE] = {.name = "double-cone", .sizes = {"radius", "length"}},
    [SHAPE_HYPERBOLOID] = {.name = "hyperboloid",
                           .sizes = {"end_radius", "waist_radius", "length"}},
    [SHAPE_BARREL] = {.name = "barrel", .sizes = {"end_radius", "middle_radius", "length"}},
    [SHAPE_DISC] = {.name = "disc",
                    .sizes = {"outer_radius", "inner_radius", "thickness"},
                    .zero = {false, true, false}},
    [SHAPE_TORUS] = {.name = "torus", .sizes = {"tube_radius", "ring_radius"}},
};

const shape_solid_info *shape_solid_info_of(shape_kind kind) {
    SHAPE_ASSERT((int)kind >= 0 && kind < SHAPE_KINDS);
    return &INFOS[kind];
}

shape_kind shape_kind_of(const char *name) {
    int kind = 0;
    while (kind < SHAPE_KINDS && strcmp(INFOS[kind].name, name) != 0) kind++;
    return (shape_kind)kind;
}

const char *shape_solid_fault(const shape_solid *s) {
    const shape_solid_info *info = shape_solid_info_of(s->kind);
    for (int k = 0; k < SHAPE_SIZES && info->sizes[k]; k++) {
        if (!isfinite(s->size[k])) return "a size that is not finite";
        if (info->zero[k] ? !(s->size[k] >= 0) : !(s->size[k] > 0))
            return "a size that is not above zero";
    }
    const double *size = s->size;
    if (s->kind == SHAPE_HYPERBOLOID && size[1] > size[0])
        return "waist_radius above end_radius: that is a barrel";
    if (s->kind == SHAPE_BARREL && size[0] > size[1])
        return "end_radius above middle_radius: that is a hyperboloid";
    if (s->kind == SHAPE_DISC && size[1] >= size[0])
        return "inner_radius not below outer_radius: nothing is left";
    if (s->kind == SHAPE_TORUS && size[0] > size[1])
        return "tube_radius above ring_radius: it would cut itself";
    return NULL;
}

/* ---- mass --------------------------------------------------------------------------------------
 */

/* Volume and integrals of x^2, y^2 and z^2 over a body whose planes of symmetry or axis make the
 * products vanish. */
typedef struct integrals {
    double volume, xx, yy, zz;
} integrals;

static integrals per_volume(double volume, double xx, double yy, double zz) {
    return (integrals){volume, volume * xx, volume * yy, volume * zz};
}

/* rho^2 = r2^2 + (r1^2 - r2^2) t^2 with t = 2 x / l. */
static integrals hyperboloid(double r1, double r2, double l) {
    double a = r2 * r2, b = (r1 - r2) * (r1 + r2);
    double across = SHAPE_PI / 4 * l * (a * a + 2 * a * b / 3 + b * b / 5);
    return (integrals){SHAPE_PI * l * (a + b / 3), SHAPE_PI / 4 * l * l * l * (a / 3 + b / 5),
                       across, across};
}

/* rho = r2 - (r2 - r1) t^2. */
static integrals barrel(double r1, double r2, double l) {
    double d = r2 - r1, p = r2 * r2, q = d * d;
    double fourth = p * p - 4 * p * r2 * d / 3 + 6 * p * q / 5 - 4 * r2 * d * q / 7 + q * q / 9;
    return (integrals){SHAPE_PI * l * (p - 2 * r2 * d / 3 + q / 5),
                       SHAPE_PI / 4 * l * l * l * (p / 3 - 2 * r2 * d / 5 + q / 7),
                       SHAPE_PI / 4 * l * fourth, SHAPE_PI / 4 * l * fourth};
}

static integrals block(double a, double b, double c) {
    return per_volume(a * b * c, a * a / 12, b * b / 12, c * c / 12);
}

static integrals ellipsoid(double a, double b, double c) {
    return per_volume(4 * SHAPE_PI / 3 * a * b * c, a * a / 5, b * b / 5, c * c / 5);
}

static integrals integrals_of(const shape_solid *s) {
    double a = s->size[0], b = s->size[1], c = s->size[2], a2 = a * a, b2 = b * b;
    switch (s->kind) {
    case SHAPE_SPHERE:
        return ellipsoid(a, a, a);
    case SHAPE_ELLIPSOID:
        return ellipsoid(a, b, c);
    case SHAPE_CYLINDER:
        return per_volume(SHAPE_PI * a2 * b, b2 / 12, a2 / 4, a2 / 4);
    case SHAPE_CUBE:
        return block(a, a, a);
    case SHAPE_BLOCK:
        return block(a, b, c);
    case SHAPE_PARALLELEPIPED:
        return block(a, b, b);
    case SHAPE_TETRAHEDRON:
        return per_volume(a2 * a / (6 * sqrt(2)), a2 / 40, a2 / 40, a2 / 40);
    case SHAPE_CONE:
        return per_volume(SHAPE_PI / 3 * a2 * b, 3 * b2 / 80, 3 * a2 / 20, 3 * a2 / 20);
    case SHAPE_DOUBLE_CONE:
        return per_volume(SHAPE_PI / 3 * a2 * b, b2 / 40, 3 * a2 / 20, 3 * a2 / 20);
    case SHAPE_HYPERBOLOID:
        return hyperboloid(a, b, c);
    case SHAPE_BARREL:
        return barrel(a, b, c);
    case SHAPE_DISC:
        return per_volume(SHAPE_PI * (a - b) * (a + b) * c, c * c / 12, (a2 + b2) / 4,
                          (a2 + b2) / 4);
    case SHAPE_TORUS:
    default:
        return per_volume(2 * SHAPE_PI * SHAPE_PI * a2 * b, (4 * b2 + 3 * a2) / 8,
                          (4 * b2 + 3 * a2) / 8, a2 / 4);
    }
}

shape_mass shape_solid_mass(const shape_solid *solid) {
    SHAPE_ASSERT(solid && !shape_solid_fault(solid));
    integrals of = integrals_of(solid);
    shape_moments m = {.volume = of.volume};
    m.second[0][0] = of.xx, m.second[1][1] = of.yy, m.second[2][2] = of.zz;
    double reach = sqrt(fmax(of.xx, fmax(of.yy, of.zz)) / of.volume);
    return shape_mass_of(&m, 16 * 0x1p-52 * of.volume, reach);
}
