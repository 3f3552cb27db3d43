/* xdmf.c - the collection of point clouds that ParaView and OVITO open, in XDMF 3.
 *
 * A grid per frame: element spheres as a polyvertex cloud with radius, speed and body. The heavy
 * data stay in run.h5. */
#include <stdio.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/run/archive.h"
#include "experiments/run/folder.h"

static void write_escaped(FILE *to, const char *text) {
    for (; *text; text++) {
        if (*text == '&')
            fputs("&amp;", to);
        else if (*text == '<')
            fputs("&lt;", to);
        else if (*text == '>')
            fputs("&gt;", to);
        else if (*text == '"')
            fputs("&quot;", to);
        else if ((unsigned char)*text >= 32)
            fputc(*text, to);
    }
}

static void write_data(FILE *to, const char *group, const char *name, const char *type, size_t rows,
                       int width) {
    fprintf(to, "<DataItem Dimensions=\"%zu", rows);
    if (width > 1) fprintf(to, " %d", width);
    fprintf(to,
            "\" NumberType=\"%s\" Precision=\"4\" Format=\"HDF\">" FILE_RUN
            ":%s/sphere/%s</DataItem>",
            type, group, name);
}

static void write_attribute(FILE *to, const char *group, const char *name, const char *type,
                            size_t rows) {
    fprintf(to,
            "        <Attribute Name=\"%s\" AttributeType=\"Scalar\" Center=\"Node\">\n          ",
            name);
    write_data(to, group, name, type, rows, 1);
    fputs("\n        </Attribute>\n", to);
}

static void write_grid(FILE *to, h5_file *archive, const frame_place *place) {
    char *group = frame_group(place->number), *radius = text_format("%s/sphere/radius", group);
    size_t n = h5_count(archive, radius);
    if (n > 0) { /* readers stumble over an empty grid */
        fprintf(to, "      <Grid Name=\"frame %06ld\" GridType=\"Uniform\">\n", place->number);
        fprintf(to, "        <Time Value=\"%.17g\"/>\n", place->time);
        fprintf(to, "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%zu\"/>\n",
                n);
        fputs("        <Geometry GeometryType=\"XYZ\">\n          ", to);
        write_data(to, group, "centre", "Float", n, 3);
        fputs("\n        </Geometry>\n", to);
        write_attribute(to, group, "radius", "Float", n);
        write_attribute(to, group, "speed", "Float", n);
        write_attribute(to, group, "body", "UInt", n);
        fputs("      </Grid>\n", to);
    }
    free(radius);
    free(group);
}

char *xdmf_text(h5_file *archive, const frame_list *frames, const char *title) {
    CLAST_ASSERT(archive && frames && title);
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    CLAST_ASSERT(to);
    fputs("<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n    <Grid Name=\"", to);
    write_escaped(to, title);
    fputs("\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", to);
    for (size_t i = 0; i < frames->count; i++) write_grid(to, archive, &frames->items[i]);
    fputs("    </Grid>\n  </Domain>\n</Xdmf>\n", to);
    CLAST_ASSERT(fclose(to) == 0);
    return text;
}
