/* Force and torque of the bodies on one part (about the point of its rotation as it stands then, or
 * the origin), the work that the part has done on them and its power now. */
#include "experiments/run/measure.h"

static void header(const measure *m, FILE *to) {
    static const char *const COLUMNS[] = {"force_x_N",   "force_y_N",   "force_z_N", "torque_x_Nm",
                                          "torque_y_Nm", "torque_z_Nm", "work_J",    "power_W"};
    for (int i = 0; i < 8; i++) fprintf(to, ",%s_%s", m->name, COLUMNS[i]);
}

static int values(const measure *m, measure_memory *memory, const moment *now, double *values) {
    (void)memory;
    clast_part_load load = clast_world_part_load(now->world, m->part);
    const double all[] = {load.force.x,  load.force.y,  load.force.z, load.torque.x,
                          load.torque.y, load.torque.z, load.work,    load.power};
    for (int i = 0; i < 8; i++) values[i] = all[i];
    return 8;
}

const measure_class MEASURE_PART_LOAD_CLASS = {
    .kind = MEASURE_PART_LOAD, .word = "part load", .header = header, .values = values};
