/* clast_mesh_shapes: shapes of a few measures as binary STL files. */
#include "meshes/shapes.h"

#include <stdlib.h>
#include <string.h>

static const char USAGE[] =
    "usage: clast_mesh_shapes SHAPE FILE.stl [MEASURE=VALUE]...\n"
    "  cylinder radius=0.1 height=1.2 segments=80 bands=12   stands on z = 0, open at the top, "
    "faces\n"
    "                                                        inwards: the silo of the benchmark\n"
    "  box      x=0.19 y=1 z=0.03                            around the origin\n"
    "  bar      length=0.19 height=0.03 width=1 nose_radius=0.005 nose_angle=0 undercut=0 "
    "segments=8\n"
    "                                                        of a grate: along x, its nose at x = "
    "0\n"
    "  tube     radius=0.1 end_radius=0.1 length=1 thickness=0 segments=48\n"
    "                                                        from the origin along z\n"
    "  bend     bending_radius=0.3 radius=0.1 angle=90 thickness=0 segments=48 rings=24\n"
    "                                                        about y, from x = bending_radius\n"
    "Lengths in metres, angles in degrees; the values shown are those of measures left out.\n"
    "example: clast_mesh_shapes bar bar.stl nose_radius=0.008 segments=16\n";

static const double DEGREE = 3.141592653589793 / 180;

typedef struct measure {
    const char *name;
    double value;
    bool whole; /* a number of things */
} measure;

static bool set(measure *m, const char *text) {
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value > -1e9 && value < 1e9)) return false;
    if (m->whole && value != (double)(int)value) return false;
    m->value = value;
    return true;
}

/* name=value words into the measures; false with a message when one does not fit. */
static bool read_words(measure *measures, int count, char **words) {
    for (; *words; words++) {
        const char *equals = strchr(*words, '=');
        bool done = false;
        for (int i = 0; i < count && equals; i++) {
            size_t length = strlen(measures[i].name);
            if (length == (size_t)(equals - *words) && !strncmp(*words, measures[i].name, length))
                done = set(&measures[i], equals + 1);
        }
        if (!done) {
            fprintf(stderr, "clast_mesh_shapes: \"%s\" is no measure of this shape\n%s", *words,
                    USAGE);
            return false;
        }
    }
    return true;
}

static mesh_status make_cylinder(const measure *m, mesh_surface *surface) {
    return mesh_make_cylinder(
        &(mesh_cylinder){m[0].value, m[1].value, (int)m[2].value, (int)m[3].value}, surface);
}

static mesh_status make_box(const measure *m, mesh_surface *surface) {
    return mesh_make_box((double[3]){m[0].value, m[1].value, m[2].value}, surface);
}

static mesh_status make_bar(const measure *m, mesh_surface *surface) {
    return mesh_make_bar(&(mesh_bar){.length = m[0].value,
                                     .height = m[1].value,
                                     .width = m[2].value,
                                     .nose_radius = m[3].value,
                                     .nose_angle = DEGREE * m[4].value,
                                     .undercut = m[5].value,
                                     .segments = (int)m[6].value},
                         surface);
}

static mesh_status make_tube(const measure *m, mesh_surface *surface) {
    return mesh_make_tube(&(mesh_tube){.to = {0, 0, m[2].value},
                                       .radius = m[0].value,
                                       .end_radius = m[1].value,
                                       .thickness = m[3].value,
                                       .segments = (int)m[4].value},
                          surface);
}

static mesh_status make_bend(const measure *m, mesh_surface *surface) {
    return mesh_make_bend(&(mesh_bend){.mouth = {m[0].value, 0, 0},
                                       .axis = {0, -1, 0},
                                       .radius = m[1].value,
                                       .angle = DEGREE * m[2].value,
                                       .thickness = m[3].value,
                                       .segments = (int)m[4].value,
                                       .rings = (int)m[5].value},
                          surface);
}

enum { MEASURES_MAX = 7 };

static struct {
    const char *name;
    mesh_status (*make)(const measure *, mesh_surface *);
    int count;
    measure measures[MEASURES_MAX];
} SHAPES[] = {
    {"cylinder",
     make_cylinder,
     4,
     {{"radius", 0.1, false}, {"height", 1.2, false}, {"segments", 80, true}, {"bands", 12, true}}},
    {"box", make_box, 3, {{"x", 0.19, false}, {"y", 1, false}, {"z", 0.03, false}}},
    {"bar",
     make_bar,
     7,
     {{"length", 0.19, false},
      {"height", 0.03, false},
      {"width", 1, false},
      {"nose_radius", 0.005, false},
      {"nose_angle", 0, false},
      {"undercut", 0, false},
      {"segments", 8, true}}},
    {"tube",
     make_tube,
     5,
     {{"radius", 0.1, false},
      {"end_radius", 0.1, false},
      {"length", 1, false},
      {"thickness", 0, false},
      {"segments", 48, true}}},
    {"bend",
     make_bend,
     6,
     {{"bending_radius", 0.3, false},
      {"radius", 0.1, false},
      {"angle", 90, false},
      {"thickness", 0, false},
      {"segments", 48, true},
      {"rings", 24, true}}},
};

int main(int count, char **words) {
    mesh_surface surface = {0};
    for (size_t i = 0; count > 2 && i < sizeof SHAPES / sizeof *SHAPES; i++) {
        if (strcmp(words[1], SHAPES[i].name) != 0) continue;
        if (!read_words(SHAPES[i].measures, SHAPES[i].count, words + 3)) return 2;
        mesh_status status = SHAPES[i].make(SHAPES[i].measures, &surface);
        if (status == MESH_OK) status = mesh_write_stl(&surface, words[2]);
        if (status != MESH_OK) fprintf(stderr, "clast_mesh_shapes: %s\n", mesh_error_text());
        mesh_free(&surface);
        return status == MESH_OK ? 0 : status == MESH_ERR_ARGUMENT ? 2 : 1;
    }
    bool help = count == 2 && strcmp(words[1], "--help") == 0;
    fputs(USAGE, help ? stdout : stderr);
    return help ? 0 : 2;
}
