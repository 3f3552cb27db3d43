/* A world that is saved, loaded and goes on is the world that never stopped, to the bit. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/hdf5_io.h"
#include "tests/run/fixture.h"

static char *folder;

static const char *in_folder(const char *name) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void step_to(clast_world *w, uint64_t step) {
    while (clast_world_steps(w) < step)
        if (clast_world_step(w) != CLAST_OK) fail_msg("%s", clast_world_error(w));
}

static uint64_t whole_run(uint64_t steps) {
    clast_world *w = bed_world(&(bed_options){0});
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    step_to(w, steps);
    uint64_t hash = clast_world_hash(w);
    clast_world_free(w);
    return hash;
}

static void going_on_is_never_having_stopped(void **state) {
    (void)state;
    clast_world *a = bed_world(&(bed_options){0});
    assert_int_equal(clast_world_prepare(a), CLAST_OK);
    uint64_t end = (uint64_t)(0.23 / clast_world_time_step(a));
    uint64_t want = whole_run(end);
    for (int i = 0; i <= 4; i++) {
        uint64_t at = end * (uint64_t)i / 4;
        step_to(a, at);
        assert_int_equal(clast_checkpoint_save(a, in_folder("c.h5"), "a note\nof two lines"),
                         CLAST_OK);
        clast_world *b = bed_world(&(bed_options){.threads = 1 + i % 3});
        char *note;
        if (clast_checkpoint_load(b, in_folder("c.h5"), &note))
            fail_msg("%s", clast_world_error(b));
        assert_string_equal(note, "a note\nof two lines");
        free(note);
        assert_int_equal(clast_world_steps(b), at);
        assert_int_equal(clast_world_hash(b), clast_world_hash(a));
        clast_energy ea = clast_world_energy(a), eb = clast_world_energy(b);
        assert_memory_equal(&ea, &eb, sizeof ea);
        clast_part_load la = clast_world_part_load(a, 0), lb = clast_world_part_load(b, 0);
        assert_memory_equal(&la, &lb, sizeof la);
        step_to(b, end);
        if (clast_world_hash(b) != want) fail_msg("stopped at step %llu", (unsigned long long)at);
        clast_world_free(b);
    }
    assert_int_equal(clast_world_hash(a), want);
    clast_world_free(a);
}

static void another_scene_is_refused(void **state) {
    (void)state;
    clast_world *a = bed_world(&(bed_options){0});
    assert_int_equal(clast_world_prepare(a), CLAST_OK);
    assert_int_equal(clast_checkpoint_save(a, in_folder("c.h5"), NULL), CLAST_OK);
    clast_world_free(a);
    clast_world *b = bed_world(&(bed_options){.friction = 0.3});
    assert_int_equal(clast_checkpoint_load(b, in_folder("c.h5"), NULL), CLAST_ERR_MISMATCH);
    assert_non_null(strstr(clast_world_error(b), "friction 0.4"));
    assert_non_null(strstr(clast_world_error(b), "friction 0.29999999999999999"));
    clast_world_free(b);
    clast_world *c = bed_world(&(bed_options){.empty = true});
    assert_int_equal(clast_checkpoint_load(c, in_folder("c.h5"), NULL), CLAST_ERR_MISMATCH);
    assert_non_null(strstr(clast_world_error(c), "bodies added 24"));
    clast_world_free(c);
}

static void put(const char *path, const char *bytes, size_t length) {
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, length, f), length);
    assert_int_equal(fclose(f), 0);
}

/* Cut anywhere, or with any byte changed, a file is refused with a message or loads the right state
 * (a byte that says nothing); it never brings the program down. */
static void damaged_files_are_refused(void **state) {
    (void)state;
    clast_world *a = bed_world(&(bed_options){0});
    assert_int_equal(clast_world_prepare(a), CLAST_OK);
    step_to(a, 900);
    uint64_t want = clast_world_hash(a);
    assert_int_equal(clast_checkpoint_save(a, in_folder("c.h5"), "note"), CLAST_OK);
    clast_world_free(a);
    size_t length;
    char *whole = slurp(in_folder("c.h5"), &length);
    int refused = 0;
    for (int i = 0; i < 60; i++) {
        char *bytes = malloc(length);
        memcpy(bytes, whole, length);
        size_t at = (size_t)(clast_random(11, 1, (uint64_t)i) * (double)length), kept = length;
        if (i % 3 == 0)
            kept = at;
        else
            bytes[at] = (char)(bytes[at] ^ (1 << (i % 8)));
        put(in_folder("damaged.h5"), bytes, kept);
        free(bytes);
        clast_world *b = bed_world(&(bed_options){0});
        clast_status s = clast_checkpoint_load(b, in_folder("damaged.h5"), NULL);
        if (s != CLAST_OK)
            refused++, assert_true(strlen(clast_world_error(b)) > 10);
        else
            assert_int_equal(clast_world_hash(b), want);
        clast_world_free(b);
    }
    assert_true(refused >= 20); /* all that were cut, at least */
    free(whole);
}

static void missing_and_foreign_files_are_named(void **state) {
    (void)state;
    clast_world *w = bed_world(&(bed_options){0});
    assert_int_equal(clast_checkpoint_load(w, in_folder("none.h5"), NULL), CLAST_ERR_OPEN);
    assert_non_null(strstr(clast_world_error(w), "none.h5"));
    assert_non_null(strstr(clast_world_error(w), "No such file"));
    put(in_folder("text.h5"), "not hdf5", 8);
    assert_int_equal(clast_checkpoint_load(w, in_folder("text.h5"), NULL), CLAST_ERR_FORMAT);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    assert_int_equal(clast_frame_write(w, in_folder("frame.h5"), true), CLAST_OK);
    assert_int_equal(clast_checkpoint_load(w, in_folder("frame.h5"), NULL), CLAST_ERR_FORMAT);
    assert_non_null(strstr(clast_world_error(w), "clast frame"));
    clast_world_free(w);
}

/* Bodies, their motion and the springs of their contacts go over; the clock starts anew. */
static void another_scene_inherits(void **state) {
    (void)state;
    clast_world *a = bed_world(&(bed_options){0});
    assert_int_equal(clast_world_prepare(a), CLAST_OK);
    step_to(a, (uint64_t)(0.19 / clast_world_time_step(a)));
    assert_int_equal(clast_checkpoint_save(a, in_folder("c.h5"), NULL), CLAST_OK);
    clast_world *b = bed_world(&(bed_options){.empty = true});
    if (clast_checkpoint_inherit(b, in_folder("c.h5"))) fail_msg("%s", clast_world_error(b));
    assert_int_equal(clast_world_prepare(b), CLAST_OK);
    assert_int_equal(clast_world_steps(b), 0);
    clast_bodies ba = clast_world_bodies(a), bb = clast_world_bodies(b);
    assert_int_equal(bb.count, ba.count);
    assert_true(ba.count > 0);
    double kinetic_a = clast_world_energy(a).kinetic, kinetic_b = clast_world_energy(b).kinetic;
    assert_true(kinetic_a > 0);
    assert_float_equal(kinetic_b / kinetic_a, 1, 1e-2);
    clast_contact ca[200], cb[200];
    size_t na = clast_world_contacts(a, ca, 200), nb = clast_world_contacts(b, cb, 200);
    assert_true(na >= 8 && na <= 200 && nb + 4 >= na && nb <= na); /* the pusher is back */
    size_t kept = 0;
    for (size_t i = 0, k = 0; i < nb; i++, k++) {
        while (k < na && (ca[k].a != cb[i].a || ca[k].b != cb[i].b ||
                          ca[k].sphere_a != cb[i].sphere_a || ca[k].sphere_b != cb[i].sphere_b))
            k++;
        assert_true(k < na);
        clast_vec3 f = ca[k].force, g = cb[i].force;
        double size = fabs(f.x) + fabs(f.z), off = fabs(f.x - g.x) + fabs(f.z - g.z);
        kept += fabs(ca[k].overlap - cb[i].overlap) <= 1e-12 && off <= 0.02 * size;
    }
    assert_true(kept == nb);
    clast_world_free(a);
    clast_world_free(b);
}

/* More bodies may follow inherited ones, and may touch each other. */
static void bodies_follow_inherited_ones(void **state) {
    (void)state;
    clast_world *a = bed_world(&(bed_options){0});
    assert_int_equal(clast_world_prepare(a), CLAST_OK);
    step_to(a, 100);
    assert_int_equal(clast_checkpoint_save(a, in_folder("c.h5"), NULL), CLAST_OK);
    clast_world *b = bed_world(&(bed_options){.empty = true});
    assert_int_equal(clast_checkpoint_inherit(b, in_folder("c.h5")), CLAST_OK);
    int before = (int)clast_world_bodies(b).count;
    for (int i = 0; i < 200; i++) {
        clast_vec3 at = {1e-4 * i, 0, 50};
        assert_int_equal(clast_body_add(b, &(clast_body_def){.shape = 0, .position = at}),
                         before + i);
    }
    assert_int_equal(clast_world_prepare(b), CLAST_ERR_ARGUMENT); /* they overlap, far outside */
    assert_non_null(strstr(clast_world_error(b), "outside the domain"));
    clast_world_free(a);
    clast_world_free(b);
}

static int make_folder(void **state) {
    (void)state;
    folder = test_folder("checkpoint");
    return 0;
}

static int drop_folder(void **state) {
    (void)state;
    remove_folder(folder);
    free(folder);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(going_on_is_never_having_stopped),
        cmocka_unit_test(another_scene_is_refused),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(missing_and_foreign_files_are_named),
        cmocka_unit_test(another_scene_inherits),
        cmocka_unit_test(bodies_follow_inherited_ones),
    };
    return cmocka_run_group_tests(tests, make_folder, drop_folder);
}
