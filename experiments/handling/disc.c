/* disc.c - the rotating disc as square cells, each with the velocity of its middle: a plate can
 * have one surface velocity only. */
#include <errno.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/handling/handling.h"

static const double SIDE_CM = 100; /* BOT 20.0 100.0 20.0 100.0 99.0 */

static void write_cell(FILE *to, int i, int j, double width) {
    double x = (i + 0.5) * width - SIDE_CM / 2, y = (j + 0.5) * width - SIDE_CM / 2;
    fprintf(to,
            "  cell_%d_%d: {part: disc, material: wall, belt: [$spin * %g cm, $spin * %g cm, 0],\n",
            i, j, -y, x);
    fprintf(to,
            "    plate: {centre: [%g cm, %g cm, 0], normal: [0, 0, 1], side: [1, 0, 0], "
            "half: [%g cm, %g cm]}}\n",
            x, y, width / 2, width / 2);
}

int disc_write(const char *from, int cells, FILE *to) {
    CLAST_ASSERT(from && cells > 0 && to);
    FILE *f = fopen(from, "r");
    if (!f) {
        fprintf(stderr, "%s: %s\n", from, strerror(errno));
        return 4;
    }
    char line[1000];
    bool inside = false;
    while (fgets(line, sizeof line, f)) {
        if (strstr(line, "# cells: end")) inside = false;
        if (!inside) fputs(line, to);
        if (!strstr(line, "# cells: begin")) continue;
        inside = true;
        for (int j = 0; j < cells; j++)
            for (int i = 0; i < cells; i++) write_cell(to, i, j, SIDE_CM / cells);
    }
    fclose(f);
    return ferror(to) ? 4 : 0;
}
