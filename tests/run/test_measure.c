/* Measures against small cases worked out by hand. The moments are made by hand, without a world,
 * but for what asks a wall for its part. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/run/measure.h"
#include "tests/run/fixture.h"

enum { MOST = 16 };

/* Single spheres of 1 kg, stored in the order given. */
typedef struct pile {
    size_t count;
    uint32_t id[MOST];
    int32_t body[MOST];
    double x[MOST], z[MOST], radius[MOST], vz[MOST], mass[MOST], zero[MOST];
    size_t order[MOST], first[MOST + 1];
    clast_contact contacts[MOST];
    size_t contact_count;
} pile;

static void put(pile *p, uint32_t id, double x, double z, double radius, double vz) {
    size_t i = p->count++;
    p->id[i] = id;
    p->body[i] = (int32_t)i;
    p->x[i] = x, p->z[i] = z, p->radius[i] = radius, p->vz[i] = vz, p->mass[i] = 1;
}

static void touch_each_other(pile *p, uint32_t a, uint32_t b) {
    p->contacts[p->contact_count++] = (clast_contact){.a = a, .b = b};
}

static moment moment_of(pile *p) {
    size_t n = 0;
    for (uint32_t id = 0; id < 100; id++)
        for (size_t i = 0; i < p->count; i++)
            if (p->id[i] == id) p->order[n++] = i;
    for (size_t i = 0; i <= p->count; i++) p->first[i] = i;
    return (moment){.bodies = {.count = p->count,
                               .id = p->id,
                               .x = p->x,
                               .y = p->zero,
                               .z = p->z,
                               .vx = p->zero,
                               .vy = p->zero,
                               .vz = p->vz,
                               .mass = p->mass},
                    .spheres = {p->count, p->x, p->zero, p->z, p->radius, p->body},
                    .order = p->order,
                    .first_sphere = p->first,
                    .with_contacts = true,
                    .contacts = p->contacts,
                    .contact_count = p->contact_count};
}

static int take(const measure *m, measure_memory *memory, pile *p, double *values) {
    moment now = moment_of(p);
    return measure_class_of(m->kind)->values(m, memory, &now, values);
}

static void discharged_counts_what_fell_or_left(void **state) {
    (void)state;
    measure m = {.name = "out", .kind = MEASURE_DISCHARGED, .level = 0};
    pile start = {0}, later = {0}, last = {0};
    for (uint32_t id = 0; id < 5; id++) put(&start, id, 0, 1, 0.1, 0);
    moment now = moment_of(&start);
    measure_memory memory;
    measure_start(&memory, &now, 6); /* id 5 had left before */
    double v[2];
    assert_int_equal(take(&m, &memory, &start, v), 2);
    assert_true(v[0] == 0 && v[1] == 0);
    put(&later, 4, 0, -0.2, 0.1, 0);
    put(&later, 0, 0, 0.5, 0.1, 0);
    put(&later, 3, 0, 0.5, 0.1, 0); /* 1 and 2 have left the world */
    take(&m, &memory, &later, v);
    assert_true(v[0] == 3 && v[1] == 3);
    put(&last, 4, 0, 0.2, 0.1, 0); /* jumps back: stays discharged */
    put(&last, 0, 0, 0.5, 0.1, 0);
    put(&last, 3, 0, 0.5, 0.1, 0);
    take(&m, &memory, &last, v);
    assert_true(v[0] == 3 && v[1] == 3);
    measure_stop(&memory);
}

static void remaining_counts_above_the_level(void **state) {
    (void)state;
    measure m = {.name = "left", .kind = MEASURE_REMAINING, .level = 0.5};
    pile p = {0};
    put(&p, 0, 0, 0.4, 0.1, 0);
    put(&p, 1, 0, 0.6, 0.1, 0);
    put(&p, 2, 0, 0.9, 0.1, 0);
    double v[2];
    take(&m, NULL, &p, v);
    assert_true(v[0] == 2 && v[1] == 2);
}

static void band_velocity_is_mean_and_deviation(void **state) {
    (void)state;
    measure m = {.name = "band",
                 .kind = MEASURE_BAND_VELOCITY,
                 .level = 0.1,
                 .height = 0.4,
                 .thickness = 0.1,
                 .x_min = 0,
                 .x_max = 1};
    measure_memory memory = {0};
    pile p = {0};
    double v[3];
    take(&m, &memory, &p, v);
    assert_true(v[0] != v[0] && v[1] != v[1] && v[2] == 0);
    put(&p, 0, 0.5, 0.5, 0.1, -1);
    take(&m, &memory, &p, v);
    assert_true(v[0] == -1 && v[1] != v[1] && v[2] == 1);
    put(&p, 1, 0.5, 0.54, 0.1, -2);
    put(&p, 2, 0.5, 0.46, 0.1, -6);
    put(&p, 3, 0.5, 0.56, 0.1, -100); /* above */
    put(&p, 4, 1.5, 0.5, 0.1, -100);  /* beside */
    take(&m, &memory, &p, v);
    assert_true(v[2] == 3);
    assert_float_equal(v[0], -3, 1e-12);
    assert_float_equal(v[1], sqrt(7), 1e-12); /* (4 + 1 + 9) / 2 */
}

static void coordination_counts_partners_once(void **state) {
    (void)state;
    measure m = {.name = "z", .kind = MEASURE_COORDINATION};
    pile p = {0};
    for (uint32_t id = 0; id < 4; id++) put(&p, id, 0, 0, 0.1, 0);
    touch_each_other(&p, 0, 1);
    touch_each_other(&p, 0, 1); /* a second sub-contact */
    touch_each_other(&p, 0, CLAST_WALL_ID);
    touch_each_other(&p, 1, 2);
    double v[2];
    take(&m, NULL, &p, v);
    assert_float_equal(v[0], 1, 1e-12);    /* 2 pairs, 4 ends, 4 bodies */
    assert_float_equal(v[1], 1.25, 1e-12); /* and one wall */
}

/* Ten spheres of radius 0.05 side by side on the level, a section each: the outline is a row of
 * half circles on half squares. */
static void solid_fraction_of_a_row(void **state) {
    (void)state;
    const double pi = 3.14159265358979323846;
    measure m = {.name = "bed",
                 .kind = MEASURE_SOLID_FRACTION,
                 .level = 0.2,
                 .x_min = 0,
                 .x_max = 1,
                 .sections = 10,
                 .body_area = pi * 0.0025};
    pile p = {0};
    for (uint32_t id = 0; id < 10; id++) {
        put(&p, 9 - id, 0.05 + 0.1 * id, 0.25, 0.05, 0);
        touch_each_other(&p, id, CLAST_WALL_ID);
    }
    double v[MEASURE_COLUMNS_MAX];
    assert_int_equal(take(&m, NULL, &p, v), 15);
    double height = 0.05 + pi * 0.05 / 4; /* centre, and the mean height of a half circle */
    for (int i = 0; i < 10; i++) assert_float_equal(v[5 + i], height, 5e-4 * height);
    assert_float_equal(v[3], height, 5e-4 * height);
    assert_float_equal(v[0], pi * 0.0025 * 10 / height, 1e-3);
    assert_float_equal(v[1], pi / 4, 1e-3); /* against the tops: the square lattice */
    assert_float_equal(v[2], 10 / height, 0.05);
    assert_true(v[4] == 10);
}

/* One in flight far above counts for nothing; one that hangs by less than its height belongs to the
 * bed; and so does one that touches a wall, wherever it is. */
static void solid_fraction_leaves_flying_bodies_out(void **state) {
    (void)state;
    measure m = {.name = "bed",
                 .kind = MEASURE_SOLID_FRACTION,
                 .level = 0,
                 .x_min = 0,
                 .x_max = 1,
                 .sections = 2,
                 .body_area = 0.01};
    pile p = {0};
    put(&p, 0, 0.25, 0.1, 0.1, 0);
    put(&p, 1, 0.25, 0.9, 0.1, 0);  /* flies: 0.6 above the first */
    put(&p, 2, 0.75, 0.25, 0.1, 0); /* 0.15 above the level, less than its height of 0.2 */
    touch_each_other(&p, 0, CLAST_WALL_ID);
    double v[MEASURE_COLUMNS_MAX];
    take(&m, NULL, &p, v);
    assert_true(v[4] == 2);
    assert_true(v[5] < 0.2);
    touch_each_other(&p, 1, CLAST_WALL_ID + 1);
    take(&m, NULL, &p, v);
    assert_true(v[4] == 3);
    assert_true(v[5] > 0.2);
    pile nothing = {0};
    take(&m, NULL, &nothing, v);
    assert_true(v[0] != v[0] && v[4] == 0 && v[3] == 0);
}

/* The plug is a plate that lies flat: all that it carries is normal, and its part says how much. */
static void load_profile_adds_up_to_the_load_of_the_part(void **state) {
    (void)state;
    enum { PLUG = 1, SECTIONS = 5 };
    clast_world *w = bed_world(&(bed_options){0});
    assert_int_equal(clast_world_run(w, 0.15), CLAST_OK);
    moment now = {0};
    moment_take(&now, w, true);
    measure m = {.name = "press",
                 .kind = MEASURE_LOAD_PROFILE,
                 .part = PLUG,
                 .level = -0.025,
                 .height = 0.05,
                 .sections = SECTIONS};
    double v[MEASURE_COLUMNS_MAX], load = -clast_world_part_load(w, PLUG).force.z;
    assert_true(load > 0);
    assert_int_equal(measure_class_of(m.kind)->values(&m, NULL, &now, v), SECTIONS);
    for (int i = 0; i < SECTIONS; i++) /* in the middle section, at z = 0 */
        assert_float_equal(v[i], i == SECTIONS / 2 ? load : 0, 1e-9 * load);
    m.level = 0.01; /* above all that touches it */
    measure_class_of(m.kind)->values(&m, NULL, &now, v);
    for (int i = 0; i < SECTIONS; i++) assert_true(v[i] == 0);
    moment_free(&now);
    clast_world_free(w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discharged_counts_what_fell_or_left),
        cmocka_unit_test(remaining_counts_above_the_level),
        cmocka_unit_test(band_velocity_is_mean_and_deviation),
        cmocka_unit_test(coordination_counts_partners_once),
        cmocka_unit_test(solid_fraction_of_a_row),
        cmocka_unit_test(solid_fraction_leaves_flying_bodies_out),
        cmocka_unit_test(load_profile_adds_up_to_the_load_of_the_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
