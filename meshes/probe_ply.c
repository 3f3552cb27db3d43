/* assimp reads a PLY file that ends early and repeats the last face that it saw. A text body has
 * one line per element; a binary one has at least the bytes of its elements, three corners per
 * face. */
#include "meshes/status.h"
#include "meshes/work.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct header {
    bool text, whole;   /* whole: end_header was there */
    long long elements; /* of all kinds */
    long long count;    /* of the kind at hand */
    double bytes;       /* of the body, at least; a double cannot overflow */
} header;

static int bytes_of(const char *type) {
    static const struct {
        const char *names;
        int bytes;
    } TYPES[] = {{" char uchar int8 uint8 ", 1},
                 {" short ushort int16 uint16 ", 2},
                 {" int uint float int32 uint32 float32 ", 4},
                 {" double float64 ", 8}};
    char word[32];
    snprintf(word, sizeof word, " %s ", type);
    for (size_t i = 0; i < sizeof TYPES / sizeof *TYPES; i++)
        if (strstr(TYPES[i].names, word)) return TYPES[i].bytes;
    return 0;
}

static void read_line(header *h, const char *line) {
    char a[17] = "", b[17] = "", c[17] = "", d[17] = "";
    int words = sscanf(line, "%16s %16s %16s %16s", a, b, c, d);
    if (strcmp(a, "format") == 0) h->text = strcmp(b, "ascii") == 0;
    if (strcmp(a, "end_header") == 0) h->whole = true;
    if (strcmp(a, "element") == 0 && words >= 3) {
        h->count = atoll(c);
        if (h->count < 0) h->count = 0;
        h->elements += h->count;
    }
    if (strcmp(a, "property") != 0) return;
    bool list = strcmp(b, "list") == 0, corners = list && strstr(line, "ind");
    h->bytes +=
        (double)h->count * (list ? bytes_of(c) + (corners ? 3 * bytes_of(d) : 0) : bytes_of(b));
}

/* Lines with something on them. */
static long long count_lines(FILE *file) {
    char block[1 << 14];
    long long lines = 0;
    bool something = false;
    for (size_t got; (got = fread(block, 1, sizeof block, file)) > 0;)
        for (size_t i = 0; i < got; i++) {
            bool end = block[i] == '\n' || block[i] == '\r';
            lines += end && something;
            something = !end && (something || !strchr(" \t", block[i]));
        }
    return lines + something;
}

mesh_status mesh_probe_ply(const char *path, FILE *file, long long size) {
    header h = {0};
    char line[1024];
    rewind(file);
    if (!fgets(line, sizeof line, file) || strncasecmp(line, "ply", 3) != 0)
        return mesh_fail(MESH_ERR_FORMAT, "%s: not a PLY file: it does not start with ply", path);
    while (!h.whole && fgets(line, sizeof line, file)) read_line(&h, line);
    if (!h.whole) return mesh_fail(MESH_ERR_FORMAT, "%s: cut off: no end_header", path);
    long long rest = size - ftell(file);
    if (!h.text && (double)rest < h.bytes)
        return mesh_fail(MESH_ERR_FORMAT,
                         "%s: cut off: its header announces %.0f bytes or more, but %lld follow",
                         path, h.bytes, rest);
    long long lines = h.text ? count_lines(file) : h.elements;
    if (lines < h.elements)
        return mesh_fail(MESH_ERR_FORMAT,
                         "%s: cut off: its header announces %lld lines, but %lld follow", path,
                         h.elements, lines);
    return MESH_OK;
}
