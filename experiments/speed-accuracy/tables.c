/* tables.c - the data folder: plain CSV that figures and page are made from (README.md has the
 * columns). */
#include <stdio.h>

#include "engine/clast.h"
#include "experiments/speed-accuracy/chart.h"
#include "experiments/speed-accuracy/picks.h"
#include "experiments/study/output.h"
#include "experiments/study/published.h"

static void write_point(FILE *f, const chart_point *p) {
    fprintf(f, "%s,%s,%s,%s,%s,%.6g,%.6g,", p->part, p->scene, p->quantity, p->family, p->setting,
            p->level, p->step);
    fprintf(f, "%.6g,%.6g,%.6g,%.6g,", p->cost.median, p->cost.low, p->cost.high, p->evaluations);
    fprintf(f, "%.6g,%.6g,%.6g,%.6g,%.6g,", p->difference, p->error, p->low, p->high, p->bound);
    fprintf(f, "%d,%d,%d,%.4g,%d,%d,", chart_is_distinct(p), p->reference, p->samples, p->overlap,
            p->front_cost, p->front_evaluations);
    csv_put(f, p->message);
    fputc('\n', f);
}

static int write_points(const chart *c, const char *folder) {
    FILE *f = output_table(folder, "points.csv",
                           "part,scene,quantity,family,setting,level,step_s,cost,cost_low,"
                           "cost_high,evaluations,difference,error,low,high,bound,distinct,"
                           "reference,samples,overlap,front_cost,front_evaluations,message");
    if (!f) return 4;
    for (int i = 0; i < c->count; i++) write_point(f, &c->points[i]);
    return output_close(f);
}

static void write_sentence(FILE *f, const char *key, const chart *c, const char *part) {
    fprintf(f, "%s=", key);
    picks_say(f, c, part, TOLERANCE[1]);
    fputc('\n', f);
}

static int write_about(const chart *c, const chart_size *size, const char *discharge_note,
                       const char *folder) {
    FILE *f = output_table(folder, "about.txt", "study=speed-accuracy");
    if (!f) return 4;
    fprintf(f, "size=%s\nreplicates=%d pairs of the button hopper, %d places of a touch\n",
            size->name, size->replicates, size->places);
    fprintf(f, "hash=0x%016llx\nengine=%s\n", (unsigned long long)c->hash, CLAST_VERSION);
    fprintf(f, "pairs=%d\nplaces=%d\nbutton_step=%.3g us\n", size->replicates, size->places,
            1e6 * size->button_step);
    fprintf(f, "least=%.3g\ndischarge=%s\n", 1e3 * size->least, discharge_note);
    write_sentence(f, "say_collision", c, PART_COLLISION);
    write_sentence(f, "say_sandwich", c, PART_SANDWICH);
    write_sentence(f, "say_discharge", c, PART_DISCHARGE);
    write_sentence(f, "say_buttons", c, PART_BUTTONS);
    fputs("unseen_rate=", f);
    picks_say_unseen(f, c, PART_BUTTONS, "rate");
    fputs("\nunseen_density=", f);
    picks_say_unseen(f, c, PART_BUTTONS, "density");
    fputc('\n', f);
    advice_write(f, c);
    return output_close(f);
}

int chart_write_tables(const chart *c, const chart_size *size, const char *discharge_note,
                       const char *folder) {
    int bad = write_points(c, folder) | picks_write(c, folder);
    bad |= write_about(c, size, discharge_note, folder);
    return bad ? 4 : 0;
}
