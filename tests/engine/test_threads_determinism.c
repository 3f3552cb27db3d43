/* The same bits: threads, skin, vector lanes, order of storage, repetition. */
#include "tests/support/bed.h"
#include "tests/support/check.h"

#include "engine/world.h"

enum { STEPS = 1800 };

static const clast_motion MOTIONS[2] = {CLAST_MOTION_3D, CLAST_MOTION_IN_PLANE};

static void expect(const bed_wish *wish, uint64_t want, const char *what) {
    uint64_t got = bed_hash(wish, STEPS);
    if (got != want)
        fail_msg("%s: hash %016llx, not %016llx", what, (unsigned long long)got,
                 (unsigned long long)want);
}

static bed_wish base(int motion, int law) {
    return (bed_wish){.threads = 1, .law = (clast_law)law, .motion = MOTIONS[motion]};
}

/* The bed must be worth comparing: contacts, rebuilds, bodies gone, parts moved and removed. */
static void the_bed_has_everything_in_it(void **state) {
    (void)state;
    for (int motion = 0; motion < 2; motion++) {
        bed_wish wish = base(motion, 1);
        clast_world *w = bed_new(&wish);
        size_t most = 0;
        for (int i = 0; i < STEPS; i++) {
            if (clast_world_step(w)) fail_msg("%s", clast_world_error(w));
            size_t now = clast_world_counters(w).contacts;
            most = now > most ? now : most;
        }
        clast_counters c = clast_world_counters(w);
        print_message("bed: %.4f s, %zu contacts at most, %llu rebuilds, %zu bodies left\n",
                      clast_world_time(w), most, (unsigned long long)c.rebuilds, c.removed);
        assert_true(most > 30 && c.rebuilds > 20 && c.removed > 0);
        assert_false(clast_world_part_present(w, 2));
        assert_true(clast_world_part_load(w, 3).work > 0 && clast_world_energy(w).global > 0);
        clast_world_free(w);
    }
}

static void any_number_of_threads(void **state) {
    (void)state;
    for (int run = 0; run < 3; run++) {
        int motion = run % 2;
        bed_wish wish = base(motion, run < 2 ? 1 + motion : CLAST_LAW_WALTON_BRAUN);
        if (run == 2) wish.rolling = 0.1;
        uint64_t want = bed_hash(&wish, STEPS);
        expect(&wish, want, "repeated");
        static const int threads[4] = {2, 3, 4, 7};
        for (int i = 0; i < 4; i++) {
            wish.threads = threads[i];
            expect(&wish, want, "threads");
        }
    }
}

static void any_skin(void **state) {
    (void)state;
    for (int motion = 0; motion < 2; motion++) {
        bed_wish wish = base(motion, 0);
        uint64_t want = bed_hash(&wish, STEPS);
        static const double skins[3] = {1e-7, 0.003, 0.02};
        for (int i = 0; i < 3; i++) {
            wish.skin = skins[i];
            expect(&wish, want, "skin");
        }
    }
}

/* What this processor and this build have: the comparison below must not be of one with itself. */
static const char *best_isa(void) {
    bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    if (wide && strstr(BUILT_ISA, "avx512")) return "avx512";
    return __builtin_cpu_supports("avx2") && strstr(BUILT_ISA, "avx2") ? "avx2" : "baseline";
}

static void the_best_instruction_set_is_taken(void **state) {
    (void)state;
    bed_wish wish = base(0, 1);
    clast_world *w = bed_new(&wish);
    assert_string_equal(clast_world_plan(w).isa, best_isa());
    clast_world_free(w);
}

static void any_instruction_set(void **state) {
    (void)state;
    static const clast_isa isas[2] = {CLAST_ISA_AVX2, CLAST_ISA_AVX512};
    static const char *const names[2] = {"avx2", "avx512"};
    for (int run = 0; run < 9; run++) {
        int law = run < 7 ? run : run == 7 ? CLAST_LAW_WALTON_BRAUN : CLAST_LAW_HERTZ_MINDLIN;
        bed_wish wish = base(run % 2, law);
        wish.rolling = run < 3 ? 0 : 0.05 * run;
        wish.precision = run < 7 ? CLAST_PRECISION_DOUBLE : CLAST_PRECISION_MIXED;
        wish.isa = CLAST_ISA_BASELINE;
        uint64_t want = bed_hash(&wish, STEPS);
        for (int i = 0; i < 2; i++) {
            wish.isa = isas[i];
            clast_world *w = bed_new(&wish);
            bool there = strcmp(clast_world_plan(w).isa, names[i]) == 0;
            clast_world_free(w);
            if (there)
                expect(&wish, want, names[i]);
            else
                print_message("not compared: this processor has no %s\n", names[i]);
        }
    }
}

/* Bodies stored backwards before the first step: names, not places, decide. */
static void check_order_of_storage(int law) {
    bed_wish wish = base(0, law);
    wish.rolling = law == CLAST_LAW_WALTON_BRAUN ? 0.1 : 0;
    uint64_t want = bed_hash(&wish, 900);
    clast_world *w = bed_new(&wish);
    for (int i = 0; i < 900; i++) {
        if (i % 57 == 0) { /* stir the slots and have the list built anew */
            size_t n = w->bodies.count;
            uint32_t *order = malloc(n * sizeof *order);
            for (size_t k = 0; k < n; k++) order[k] = (uint32_t)((k * 37 + (size_t)i) % n);
            if (n % 37 == 0) fail_msg("37 must not divide %zu", n);
            carry_lists(w);
            body_permute(w, order);
            lists_rebuild(w);
            contacts_restore(w);
            free(order);
        }
        if (clast_world_step(w)) fail_msg("%s", clast_world_error(w));
    }
    assert_true(clast_world_hash(w) == want);
    clast_world_free(w);
}

static void any_order_of_storage(void **state) {
    (void)state;
    check_order_of_storage(CLAST_LAW_HERTZ_MINDLIN);
    check_order_of_storage(CLAST_LAW_WALTON_BRAUN);
}

/* Looking does not touch. */
static void readers_change_nothing(void **state) {
    (void)state;
    bed_wish wish = base(0, 1);
    uint64_t want = bed_hash(&wish, 300);
    clast_world *w = bed_new(&wish);
    for (int i = 0; i < 300; i++) {
        if (clast_world_step(w)) fail_msg("%s", clast_world_error(w));
        clast_world_energy(w), clast_world_bodies(w), clast_world_contacts(w, NULL, 0);
        clast_world_part_load(w, 1), clast_world_hash(w), clast_world_spheres(w);
    }
    assert_true(clast_world_hash(w) == want);
    clast_world_free(w);
}

/* One bit anywhere in the state changes the hash. */
static void the_hash_sees_every_column(void **state) {
    (void)state;
    bed_wish wish = base(0, 1);
    clast_world *w = bed_new(&wish);
    for (int i = 0; i < 1500; i++) clast_world_step(w);
    uint64_t h = clast_world_hash(w);
#define X(type, name)                                                                              \
    {                                                                                              \
        unsigned char *byte = (unsigned char *)&w->bodies.name[3];                                 \
        *byte ^= 1;                                                                                \
        if (strcmp(#name, "id") != 0 && clast_world_hash(w) == h) fail_msg("column " #name);       \
        *byte ^= 1;                                                                                \
    }
    BODY_COLUMNS(X)
#undef X
    assert_true(clast_world_hash(w) == h);
    for (size_t c = 0; c < w->shares[0].contacts.count; c++)
        if (contact_touches(w, &w->shares[0].contacts, c)) {
            ((double *)w->shares[0].contacts.column[3])[c] += 1e-12;
            break;
        }
    assert_true(clast_world_hash(w) != h);
    clast_world_free(w);
}

TEST_MAIN(cmocka_unit_test(the_bed_has_everything_in_it), cmocka_unit_test(any_number_of_threads),
          cmocka_unit_test(any_skin), cmocka_unit_test(the_best_instruction_set_is_taken),
          cmocka_unit_test(any_instruction_set), cmocka_unit_test(any_order_of_storage),
          cmocka_unit_test(readers_change_nothing), cmocka_unit_test(the_hash_sees_every_column))
