/* The law in unoptimised scalar code against the same source in vector lanes: equal to the bit, for
 * touching, parting and missing contacts, every law, limit and unloading. */
#include "tests/engine/law_lanes.h"
#include "tests/support/check.h"

static void fill(batch *b, uint64_t seed, int count) {
    dice d = {seed, 0};
    memset(b, 0, sizeof *b);
    b->count = count;
    for (int i = 0; i < count; i++) {
        double x = roll(&d, -1, 1), y = roll(&d, -1, 1), z = roll(&d, -1, 1);
        double n = sqrt(x * x + y * y + z * z), size = pow(10, roll(&d, -5, -1));
        b->nx[i] = x / n, b->ny[i] = y / n, b->nz[i] = z / n;
        bool apart = roll(&d, 0, 1) < 0.2, fresh = roll(&d, 0, 1) < 0.3;
        b->overlap[i] = (apart ? -1 : 1) * size * roll(&d, 0, 0.05);
        b->radius[i] = size, b->mass[i] = 2000 * size * size * size;
        b->vx[i] = roll(&d, -2, 2), b->vy[i] = roll(&d, -2, 2), b->vz[i] = roll(&d, -2, 2);
        b->e_star[i] = pow(10, roll(&d, 5, 11)), b->g_star[i] = b->e_star[i] * roll(&d, 0.1, 0.4);
        b->stiffness[i] = pow(10, roll(&d, 2, 6)), b->tangential[i] = 0.3 * b->stiffness[i];
        b->damping[i] = roll(&d, 0, 1), b->friction[i] = roll(&d, 0, 1);
        b->cohesion[i] = roll(&d, 0, 1) < 0.2 ? roll(&d, 0, 1e-3) : 0;
        if (fresh) continue;
        double f = b->e_star[i] * size * size * 1e-3;
        b->old_overlap[i] = size * roll(&d, 0, 0.05);
        b->sx[i] = f * roll(&d, -1, 1), b->sy[i] = f * roll(&d, -1, 1),
        b->sz[i] = f * roll(&d, -1, 1);
        b->old_fx[i] = f * roll(&d, -1, 1), b->old_fy[i] = f * roll(&d, -1, 1);
        b->old_fz[i] = f * roll(&d, -1, 1);
    }
}

static void compare(law_run *run, const char *name, uint64_t seed, law_choice choice) {
    static batch scalar, lanes;
    fill(&scalar, seed, (int)(seed % LANES) + 1);
    memcpy(&lanes, &scalar, sizeof lanes);
    law_run_scalar(&scalar, choice, 1.3e-6);
    run(&lanes, choice, 1.3e-6);
    if (memcmp(&scalar, &lanes, sizeof scalar) != 0)
        fail_msg("%s, seed %llu, law %d, unloading %d, limit %d: other bits than scalar code", name,
                 (unsigned long long)seed, (int)choice.law, (int)choice.unloading,
                 (int)choice.limit);
}

static void compare_all(law_run *run, const char *name) {
    for (uint64_t seed = 1; seed <= 300; seed++)
        for (int law = 0; law < 3; law++)
            for (int mode = 0; mode < 4; mode++)
                compare(run, name, seed, (law_choice){(clast_law)law, (clast_unloading)(mode / 2),
                                                      (clast_friction_limit)(mode % 2)});
}

static void vector_lanes_have_the_bits_of_scalar_code(void **state) {
    (void)state;
    compare_all(law_run_baseline, "baseline");
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        compare_all(law_run_avx2, "avx2");
    else print_message("not compared: this processor has no avx2\n");
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
        compare_all(law_run_avx512, "avx512");
    else print_message("not compared: this processor has no avx512\n");
}

/* What must hold of every contact, whatever came before. */
static void the_law_keeps_its_promises(void **state) {
    (void)state;
    static batch b;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        fill(&b, seed, LANES);
        batch in = b;
        law_choice choice = {(clast_law)(seed % 3), (clast_unloading)(seed / 3 % 2),
                             (clast_friction_limit)(seed / 6 % 2)};
        law_run_scalar(&b, choice, 1.3e-6);
        for (int i = 0; i < LANES; i++) {
            double fn = b.fx[i] * b.nx[i] + b.fy[i] * b.ny[i] + b.fz[i] * b.nz[i];
            double f2 = b.fx[i] * b.fx[i] + b.fy[i] * b.fy[i] + b.fz[i] * b.fz[i];
            double ft = sqrt(fmax(0, f2 - fn * fn)), size = sqrt(f2);
            assert_true(isfinite(f2) && isfinite(b.work_elastic[i]) && isfinite(b.work_dashpot[i]));
            assert_true(fn >= -1e-12 * size); /* never pulls */
            if (in.overlap[i] <= 0) assert_true(f2 == 0 && b.sx[i] == 0 && b.old_overlap[i] == 0);
            if (choice.limit == CLAST_LIMIT_TOTAL) /* Coulomb */
                assert_true(ft <= (b.friction[i] * fn + b.cohesion[i]) * (1 + 1e-9) + 1e-7 * size);
        }
    }
}

TEST_MAIN(cmocka_unit_test(vector_lanes_have_the_bits_of_scalar_code),
          cmocka_unit_test(the_law_keeps_its_promises))
