/* Shared dashpots: the same bits for any number of threads, skin, instruction set and order of
 * storage, and after a restart. */
#include "tests/support/bed.h"
#include "tests/support/scene.h"

#include "engine/world.h"

enum { STEPS = 700, KINDS = 5 };

/* Laws, motions, precision and rolling friction; a kernel of its own for each. */
static bed_wish kind_of(int k) {
    static const clast_law laws[KINDS] = {CLAST_LAW_HERTZ_MINDLIN, CLAST_LAW_LINEAR, CLAST_LAW_MAW,
                                          CLAST_LAW_HERTZ_A00, CLAST_LAW_HOOKE};
    return (bed_wish){.threads = 1,
                      .law = laws[k],
                      .motion = k % 2 ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D,
                      .clump_contact = CLAST_CLUMP_SHARED,
                      .rolling = k == 2 ? 0.1 : 0,
                      .precision = k > 2 ? CLAST_PRECISION_MIXED : CLAST_PRECISION_DOUBLE};
}

static void expect(const bed_wish *wish, uint64_t want, const char *what) {
    uint64_t got = bed_hash(wish, STEPS);
    if (got != want)
        fail_msg("%s: hash %016llx, not %016llx", what, (unsigned long long)got,
                 (unsigned long long)want);
}

static void any_way_of_running(void **state) {
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        bed_wish wish = kind_of(k), other = wish;
        uint64_t want = bed_hash(&wish, STEPS);
        other.clump_contact = CLAST_CLUMP_EACH;
        assert_true(bed_hash(&other, STEPS) != want);
        for (int n = 2; n < 4; n++) wish.threads = n, expect(&wish, want, "threads");
        wish.threads = 1;
        static const double skins[2] = {1e-7, 0.02};
        for (int i = 0; i < 2; i++) wish.skin = skins[i], expect(&wish, want, "skin");
        wish.skin = 0;
        static const clast_isa isas[2] = {CLAST_ISA_BASELINE, CLAST_ISA_AVX2};
        for (int i = 0; i < 2; i++) wish.isa = isas[i], expect(&wish, want, "instruction set");
    }
}

/* The slots stirred and the lists built anew, as test_threads_determinism.c does. */
static void any_order_of_storage(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        bed_wish wish = kind_of(k);
        uint64_t want = bed_hash(&wish, STEPS);
        clast_world *w = bed_new(&wish);
        for (uint64_t i = 0; i < STEPS; i++) {
            size_t n = w->bodies.count;
            uint32_t *order = malloc(n * sizeof *order);
            for (size_t j = 0; j < n; j++) order[j] = (uint32_t)(n - 1 - j);
            if (i % 41 == 0) {
                carry_lists(w);
                body_permute(w, order);
                lists_rebuild(w);
                contacts_restore(w);
            }
            free(order);
            steps(w, 1);
        }
        assert_true(clast_world_hash(w) == want);
        clast_world_free(w);
    }
}

static void going_on_from_a_checkpoint(void **state) {
    (void)state;
    scratch_name file = scratch_file("shared.h5");
    for (int k = 0; k < KINDS; k++) {
        bed_wish wish = kind_of(k);
        uint64_t want = bed_hash(&wish, STEPS);
        clast_world *first = bed_new(&wish);
        steps(first, STEPS / 2);
        assert_int_equal(clast_checkpoint_save(first, file.text, NULL), CLAST_OK);
        clast_world_free(first);
        clast_world *second = bed_new(&wish);
        if (clast_checkpoint_load(second, file.text, NULL))
            fail_msg("%s", clast_world_error(second));
        steps(second, STEPS - STEPS / 2);
        assert_true(clast_world_hash(second) == want);
        clast_world_free(second);
        wish.clump_contact = CLAST_CLUMP_EACH;
        clast_world *other = bed_new(&wish);
        assert_int_equal(clast_checkpoint_load(other, file.text, NULL), CLAST_ERR_MISMATCH);
        clast_world_free(other);
    }
    remove(file.text);
}

/* ---- bodies with more contacts than a batch of the kernel holds ------------------------------ */

enum { LONG = 90 };

static uint64_t hash_of_long_rods(int threads, clast_isa isa, double skin) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.clump_contact = CLAST_CLUMP_SHARED;
    def.gravity = vec(0, 0, -9.81);
    def.threads = threads, def.spheres_per_thread = 1, def.isa = isa;
    def.skin = skin, def.time_step = 4e-6;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.3);
    two_materials m = add_materials(w, &pair);
    clast_vec3 centre[LONG];
    double radius[LONG], r = 0.002, mass = 2e-3;
    for (int i = 0; i < LONG; i++)
        centre[i] = vec(0.7 * r * (i - 0.5 * (LONG - 1)), 0, 0), radius[i] = r;
    clast_shape_def rod = {"rod", m.soft, LONG, centre, radius, mass, {1e-7, 3e-6, 3e-6}, 0, NULL};
    int kind = clast_shape_add(w, &rod);
    assert_true(kind >= 0);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    for (int i = 0; i < 6; i++)
        add_body(w, kind, vec(0.0002 * i, 0.0001 * (i % 2), r * (1 + 2.01 * i)),
                 vec(0, 0, -0.02 * i), vec(0, 0.3, 0.2));
    size_t most = 0;
    for (int i = 0; i < 1000; i++) {
        steps(w, 1);
        size_t now = clast_world_counters(w).contacts;
        most = now > most ? now : most;
    }
    assert_true(most > 2 * LONG);
    uint64_t hash = clast_world_hash(w);
    clast_world_free(w);
    return hash;
}

static void bodies_longer_than_a_batch(void **state) {
    (void)state;
    uint64_t want = hash_of_long_rods(1, CLAST_ISA_AUTO, 0);
    assert_true(hash_of_long_rods(3, CLAST_ISA_AUTO, 0) == want);
    assert_true(hash_of_long_rods(1, CLAST_ISA_BASELINE, 0) == want);
    assert_true(hash_of_long_rods(1, CLAST_ISA_AUTO, 1e-4) == want);
    assert_true(hash_of_long_rods(2, CLAST_ISA_AVX2, 2e-3) == want);
}

TEST_MAIN(cmocka_unit_test(any_way_of_running), cmocka_unit_test(any_order_of_storage),
          cmocka_unit_test(going_on_from_a_checkpoint),
          cmocka_unit_test(bodies_longer_than_a_batch))
