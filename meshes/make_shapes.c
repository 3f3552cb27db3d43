/* clast_mesh_shapes: shapes of a few measures as binary STL files. */
#include "meshes/shapes.h"

#include <stdlib.h>
#include <string.h>

static const char USAGE[] =
    "usage: clast_mesh_shapes cylinder FILE.stl [radius=0.1] [height=1.2] [segments=80] "
    "[bands=12]\n"
    "       clast_mesh_shapes box FILE.stl [x=0.19] [y=1] [z=0.03]\n"
    "Lengths in metres. The cylinder stands on z = 0, is open at the top and faces inwards; the "
    "box\n"
    "lies around the origin. Without measures: the silo of the benchmark, a bar of the grates.\n";

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

static struct {
    const char *name;
    mesh_status (*make)(const measure *, mesh_surface *);
    int count;
    measure measures[4];
} SHAPES[] = {
    {"cylinder",
     make_cylinder,
     4,
     {{"radius", 0.1, false}, {"height", 1.2, false}, {"segments", 80, true}, {"bands", 12, true}}},
    {"box", make_box, 3, {{"x", 0.19, false}, {"y", 1, false}, {"z", 0.03, false}}},
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
