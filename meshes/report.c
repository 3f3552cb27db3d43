#include "meshes/status.h"

static void line_of(FILE *to, const mesh_finding *f, const char *what, const char *done) {
    if (f->count == 0) return;
    fprintf(to, "  %s: %zu, %s; first at triangle %zu\n", what, f->count, done, f->first);
}

static void write_vertices(const mesh_report *r, FILE *to) {
    fprintf(to, "  vertices joined within %.3g m: %zu", r->weld_distance, r->joined);
    if (r->moved > 0)
        fprintf(to, ", of which moved: %zu, at most %.3g m", r->moved, r->farthest_move);
    fputc('\n', to);
    if (r->unused > 0) fprintf(to, "  vertices in no triangle: %zu, removed\n", r->unused);
    if (r->not_faces > 0) fprintf(to, "  points and lines: %zu, left out\n", r->not_faces);
}

static void write_crossings(const mesh_report *r, FILE *to) {
    if (!r->crossings_sought) return;
    fprintf(to, "  triangles that pass through each other: ");
    if (r->crossings.count == 0)
        fprintf(to, "%s", r->crossings_given_up ? "none found" : "none");
    else
        fprintf(to, "%zu pairs, left; the first: %zu and %zu", r->crossings.count,
                r->crossings.first, r->crossings_partner);
    fprintf(to, "%s\n", r->crossings_given_up ? "; given up, too many of them lie close" : "");
}

void mesh_report_write(const mesh_report *r, const char *name, FILE *to) {
    MESH_ASSERT(r && name && to);
    fprintf(to, "%s: %zu triangles, %zu vertices read\n", name, r->triangles_read,
            r->vertices_read);
    if (r->loader_warnings > 0)
        fprintf(to, "  complaints while reading: %zu, the first: %s\n", r->loader_warnings,
                r->loader_said);
    write_vertices(r, to);
    line_of(to, &r->collapsed, "triangles with corners that coincide", "removed");
    line_of(to, &r->slivers, "triangles without a height", "removed");
    line_of(to, &r->duplicates, "triangles that are there twice", "removed");
    line_of(to, &r->against, "triangles whose stored normal opposes their corners",
            "the corners are believed");
    line_of(to, &r->flipped, "triangles that run against their neighbours",
            r->mended ? "turned" : "left");
    line_of(to, &r->open_edges, "open edges", "left");
    line_of(to, &r->branching_edges, "edges of more than two triangles", "left");
    line_of(to, &r->twisted_edges, "edges that no turning makes agree", "left");
    write_crossings(r, to);
    if (r->inward > 0) fprintf(to, "  closed pieces that face inwards: %zu, left\n", r->inward);
    fprintf(to, "  pieces: %zu, %s, area %.6g m2", r->pieces, r->closed ? "closed" : "not closed",
            r->area);
    if (r->closed) fprintf(to, ", volume %.6g m3", r->volume);
    fprintf(to, "\n  from (%g, %g, %g) to (%g, %g, %g) m\n", r->low[0], r->low[1], r->low[2],
            r->high[0], r->high[1], r->high[2]);
}
