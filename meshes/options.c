#include "meshes/status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    double metres;
} UNITS[] = {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"inch", 0.0254}, {"in", 0.0254}};

mesh_options mesh_options_default(void) {
    return (mesh_options){.unit = 1, .axis = {1, 2, 3}, .weld = 1e-6, .mend_winding = true};
}

mesh_status mesh_unit_parse(const char *text, double *unit) {
    MESH_ASSERT(text && unit);
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++)
        if (strcmp(text, UNITS[i].name) == 0) {
            *unit = UNITS[i].metres;
            return MESH_OK;
        }
    char *end;
    double number = strtod(text, &end);
    if (end == text || *end != '\0' || !(number > 0 && isfinite(number)))
        return mesh_fail(MESH_ERR_ARGUMENT,
                         "mesh unit \"%s\": expected mm, cm, m, inch, or metres above 0", text);
    *unit = number;
    return MESH_OK;
}

mesh_status mesh_axes_parse(const char *text, int axis[3]) {
    MESH_ASSERT(text && axis);
    static const char axes[] = "xyz";
    int found[3] = {0}, count = 0, seen = 0, sign = 1;
    bool good = true;
    for (const char *c = text; *c && good; c++) {
        if (strchr(" ,+", *c)) continue;
        const char *letter = strchr(axes, *c);
        if (*c == '-' && sign > 0) {
            sign = -1;
        } else if (letter && count < 3) {
            found[count++] = sign * (int)(letter - axes + 1);
            seen |= 1 << (letter - axes);
            sign = 1;
        } else {
            good = false;
        }
    }
    if (!good || count != 3 || seen != 7 || sign < 0)
        return mesh_fail(MESH_ERR_ARGUMENT,
                         "mesh axes \"%s\": expected x, y and z once each, such as \"x -z y\"",
                         text);
    memcpy(axis, found, sizeof found);
    return MESH_OK;
}
