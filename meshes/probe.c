#include "meshes/status.h"
#include "meshes/work.h"

#include <errno.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { HEADER = 84, FACET = 50, SAMPLE = 512 };

typedef struct sample {
    const char *path;
    long long size;             /* of the file, bytes */
    unsigned char head[SAMPLE]; /* of the file, zeros behind its end */
    unsigned char tail[SAMPLE + 1];
} sample;

static bool is_text(const sample *s) {
    size_t n = s->size < SAMPLE ? (size_t)s->size : SAMPLE, spaces = 0;
    for (size_t i = 0; i < n; i++)
        if (s->head[i] == 0 || s->head[i] > 126) return false;
    while (spaces < n && strchr(" \t\r\n", s->head[spaces])) spaces++;
    return strncasecmp((const char *)s->head + spaces, "solid", 5) == 0;
}

/* Binary: an 80-byte title, the number of facets, 50 bytes each. Text: solid ... endsolid. */
static mesh_status probe_stl(const sample *s) {
    const unsigned char *n = s->head + HEADER - 4;
    long long facets = n[0] | n[1] << 8 | n[2] << 16 | (long long)n[3] << 24;
    long long whole = HEADER + FACET * facets;
    if (s->size == whole && facets == 0)
        return mesh_fail(MESH_ERR_FORMAT, "%s: a binary STL of 0 triangles", s->path);
    if (s->size == whole) return MESH_OK;
    if (is_text(s)) {
        if (strstr((const char *)s->tail, "endsolid")) return MESH_OK;
        return mesh_fail(MESH_ERR_FORMAT, "%s: cut off: a text STL that does not end in endsolid",
                         s->path);
    }
    if (s->size < HEADER)
        return mesh_fail(
            MESH_ERR_FORMAT,
            "%s: not an STL file: %lld bytes that neither start with solid nor hold the "
            "%d bytes of a binary header",
            s->path, s->size, HEADER);
    return mesh_fail(
        MESH_ERR_FORMAT,
        "%s: cut off or not an STL file: its header announces %lld triangles, %lld bytes, "
        "but it has %lld bytes",
        s->path, facets, whole, s->size);
}

static bool take_sample(FILE *file, sample *s) {
    size_t got = fread(s->head, 1, SAMPLE, file);
    if (ferror(file)) return false;
    if (s->size <= SAMPLE) {
        memcpy(s->tail, s->head, got);
        return true;
    }
    return fseek(file, -SAMPLE, SEEK_END) == 0 && fread(s->tail, 1, SAMPLE, file) == SAMPLE;
}

static mesh_status probe_open(const char *path, FILE *file, sample *s) {
    if (!file || !take_sample(file, s))
        return mesh_fail(MESH_ERR_OPEN, "%s: cannot be read: %s", path, strerror(errno));
    const char *dot = strrchr(path, '.');
    if (dot && strcasecmp(dot, ".stl") == 0) return probe_stl(s);
    if (dot && strcasecmp(dot, ".ply") == 0) return mesh_probe_ply(path, file, s->size);
    return MESH_OK;
}

mesh_status mesh_probe(const char *path) {
    struct stat about;
    if (stat(path, &about) != 0) /* before opening: a pipe would keep us waiting */
        return mesh_fail(MESH_ERR_OPEN, "%s: cannot be opened: %s", path, strerror(errno));
    if (!S_ISREG(about.st_mode))
        return mesh_fail(MESH_ERR_OPEN, "%s: not a file but a %s", path,
                         S_ISDIR(about.st_mode) ? "folder" : "device or pipe");
    if (about.st_size == 0) return mesh_fail(MESH_ERR_FORMAT, "%s: empty, 0 bytes", path);
    sample s = {.path = path, .size = about.st_size};
    FILE *file = fopen(path, "rb");
    mesh_status status = probe_open(path, file, &s);
    if (file) fclose(file);
    return status;
}
