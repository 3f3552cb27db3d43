/* Geometry and law in unoptimised scalar code against the same source in vector lanes: equal to the
 * bit, for touching, parting and missing contacts, every law, limit, unloading and speciality. */
#include "tests/engine/law_lanes.h"
#include "tests/support/check.h"

static void fill_history(lanes *l, dice *d, int i, double size, bool flat) {
    double f = l->b.k_normal[i] * size * size * 1e-3;
    l->history[0][i] = size * roll(d, 0, 0.05), l->history[1][i] = f * roll(d, 0, 1);
    for (int k = HISTORY_SPRING; k < HISTORY_PLASTIC; k++) l->history[k][i] = f * roll(d, -1, 1);
    l->history[HISTORY_PLASTIC][i] = l->history[0][i] * roll(d, 0, 1.2);
    if (flat) l->history[4][i] = 0;
}

static void fill_motion(batch *b, dice *d, int i, double size, bool flat) {
    for (int k = 0; k < 3; k++) {
        b->v[k][i] = roll(d, -2, 2), b->wa[k][i] = roll(d, -90, 90), b->wb[k][i] = roll(d, -90, 90);
        b->oa[k][i] = size * roll(d, -1, 1), b->ob[k][i] = size * roll(d, -1, 1);
    }
    if (flat)
        b->v[2][i] = b->wa[0][i] = b->wa[1][i] = b->wb[0][i] = b->wb[1][i] = b->oa[2][i] =
            b->ob[2][i] = 0;
}

static void fill(lanes *l, uint64_t seed, int count, law_need need) {
    bool flat = need.flat;
    dice d = {seed, 0};
    batch *b = &l->b;
    memset(l, 0, sizeof *l);
    for (int i = 0; i < count; i++) {
        double x = roll(&d, -1, 1), y = roll(&d, -1, 1), z = flat ? 0 : roll(&d, -1, 1);
        double n = sqrt(x * x + y * y + z * z), size = pow(10, roll(&d, -5, -1));
        bool apart = roll(&d, 0, 1) < 0.2, fresh = roll(&d, 0, 1) < 0.3;
        b->ra[i] = size, b->rb[i] = need.equal ? size : size * roll(&d, 0.3, 3);
        double gap = (apart ? 1 : -1) * size * roll(&d, 0, 0.05), way = b->ra[i] + b->rb[i] + gap;
        b->d[0][i] = way * x / n, b->d[1][i] = way * y / n, b->d[2][i] = way * z / n;
        b->ma[i] = 2000 * size * size * size,
        b->mb[i] = need.equal ? b->ma[i] : b->ma[i] * roll(&d, 0.1, 10);
        b->k_normal[i] = pow(10, roll(&d, 5, 11));
        b->k_tangent[i] = b->k_normal[i] * roll(&d, 0.1, 0.9);
        b->c_normal[i] = roll(&d, 0, 2) * sqrt(b->k_normal[i]);
        b->c_tangent[i] = roll(&d, 0, 2) * sqrt(b->k_tangent[i]);
        b->friction[i] = roll(&d, 0, 1);
        b->cohesion[i] = roll(&d, 0, 1) < 0.2 ? roll(&d, 0, 1e-3) : 0;
        b->yield[i] = roll(&d, 0, 1), b->rolling[i] = roll(&d, 0, 1);
        b->hold[i] = size * size * b->ma[i] * pow(10, roll(&d, 0, 6));
        fill_motion(b, &d, i, size, flat);
        if (!fresh) fill_history(l, &d, i, size, flat);
    }
}

/* Nothing, and what laws ask for. Yielding is of linear laws, Brilliantov's dashpot of others. */
static int around_of(int k, law_need need) {
    static const int LINEAR[AROUNDS] = {0, YIELDS, MAW, HOOKE, ROLLS | YIELDS, ROLLS | MAW};
    static const int HERTZ[AROUNDS] = {0, VISCOELASTIC, ROLLS, ROLLS | VISCOELASTIC, 0, ROLLS};
    int around = need.linear ? LINEAR[k % AROUNDS] : HERTZ[k % AROUNDS];
    return need.tangent && !need.equal ? around : around & ~ROLLS;
}

/* Every combination of limit and unloading. */
static law_choice choice_of(int mode, bool again) {
    law_choice c = {.dt = again ? 0 : 1.3e-6, .again = again, .advance = !again};
    c.limit_total = mode % 2 == 0, c.limit_elastic = mode % 2 == 1;
    c.rescale = mode / 2 == 0, c.keep_displacement = mode / 2 == 1, c.keep_force = mode / 2 == 2;
    return c;
}

static void compare(law_run *run, const char *name, uint64_t seed, int mode, int need) {
    static lanes scalar, vector;
    int count = (int)(seed % LANES) + 1;
    fill(&scalar, seed, count, need_of(need));
    memcpy(&vector, &scalar, sizeof vector);
    law_choice choice = choice_of(mode, seed % 5 == 0);
    int around = around_of((int)(seed % AROUNDS), need_of(need));
    law_run_scalar(&scalar, count, choice, need, around);
    run(&vector, count, choice, need, around);
    if (memcmp(&scalar, &vector, sizeof scalar) != 0)
        fail_msg("%s, seed %llu, mode %d, need %d: other bits than scalar code", name,
                 (unsigned long long)seed, mode, need);
}

static void compare_all(law_run *run, const char *name) {
    for (uint64_t seed = 1; seed <= 100; seed++)
        for (int need = 0; need < NEEDS; need++)
            for (int mode = 0; mode < 6; mode++) compare(run, name, seed, mode, need);
}

static void vector_lanes_have_the_bits_of_scalar_code(void **state) {
    (void)state;
    compare_all(law_run_baseline, "baseline");
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        compare_all(law_run_avx2, "avx2");
    else
        print_message("not compared: this processor has no avx2\n");
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
        compare_all(law_run_avx512, "avx512");
    else
        print_message("not compared: this processor has no avx512\n");
}

/* ---- promises -------------------------------------------------------------------------------- */

static double coulomb(const lanes *l, int i, double fn) {
    return (l->b.friction[i] * fn + l->b.cohesion[i]) * (1 + 1e-9);
}

static void check_promises(const lanes *out, int i, law_choice c, law_need need) {
    const batch *b = &out->b;
    double fn = b->f[0][i] * b->n[0][i] + b->f[1][i] * b->n[1][i] + b->f[2][i] * b->n[2][i];
    double f2 = 0;
    for (int k = 0; k < 3; k++) f2 += b->f[k][i] * b->f[k][i];
    double ft = sqrt(fmax(0, f2 - fn * fn)), size = sqrt(f2);
    assert_true(isfinite(f2) && isfinite(b->elastic[i]) && isfinite(b->dashpot[i]));
    assert_true(fn >= -1e-12 * size && out->history[1][i] >= 0); /* never pulls */
    if (b->overlap[i] <= 0) assert_true(f2 == 0 && out->history[0][i] == 0);
    if (c.limit_total > 0) assert_true(ft <= coulomb(out, i, fn) + 1e-7 * size);
    if (!need.tangent) assert_true(ft <= 1e-7 * size);
}

static void the_law_keeps_its_promises(void **state) {
    (void)state;
    static lanes in, out;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        int need = (int)(seed % NEEDS);
        fill(&in, seed, LANES, need_of(need));
        out = in;
        law_choice choice = choice_of((int)(seed % 6), false);
        law_run_scalar(&out, LANES, choice, need, around_of((int)(seed / NEEDS), need_of(need)));
        for (int i = 0; i < LANES; i++) check_promises(&out, i, choice, need_of(need));
    }
}

/* ---- what lets integer sums, specialities and restarts be exact ------------------------------ */

static void swap_columns(real (*a)[LANES], real (*b)[LANES]) {
    real keep[3][LANES];
    memcpy(keep, a, sizeof keep), memcpy(a, b, sizeof keep), memcpy(b, keep, sizeof keep);
}

static void exchange_bodies(lanes *l, bool equal) {
    batch *b = &l->b;
    for (int i = 0; i < LANES; i++) {
        for (int k = 0; k < 3; k++) {
            b->d[k][i] = -b->d[k][i], b->v[k][i] = -b->v[k][i];
            l->history[2 + k][i] = -l->history[2 + k][i];
        }
        double r = b->ra[i], m = b->ma[i];
        b->ra[i] = b->rb[i], b->rb[i] = r, b->ma[i] = b->mb[i], b->mb[i] = m;
    }
    if (!equal) swap_columns(b->wa, b->wb), swap_columns(b->oa, b->ob);
}

static void action_is_reaction_to_the_bit(void **state) {
    (void)state;
    static lanes one, other;
    for (uint64_t seed = 1; seed <= 500; seed++) {
        int need = (int)(seed % NEEDS);
        fill(&one, seed, LANES, need_of(need));
        other = one;
        exchange_bodies(&other, need_of(need).equal);
        int around = around_of((int)(seed / NEEDS), need_of(need));
        law_run_scalar(&one, LANES, choice_of((int)(seed % 6), false), need, around);
        law_run_scalar(&other, LANES, choice_of((int)(seed % 6), false), need, around);
        for (int i = 0; i < LANES; i++)
            for (int k = 0; k < 3; k++) {
                assert_true(one.b.f[k][i] == -other.b.f[k][i]);
                assert_true(one.history[2 + k][i] == -other.history[2 + k][i]);
                if (need_of(need).equal)
                    assert_true(one.b.ta[k][i] == other.b.ta[k][i]);
                else
                    assert_true(one.b.ta[k][i] == other.b.tb[k][i]);
            }
    }
}

static void forces_come_again_from_the_history(void **state) {
    (void)state;
    static lanes first, again;
    for (uint64_t seed = 1; seed <= 500; seed++) {
        int need = (int)(seed % NEEDS);
        fill(&first, seed, LANES, need_of(need));
        int around = around_of((int)(seed / NEEDS), need_of(need));
        again = first;
        law_run_scalar(&first, LANES, choice_of((int)(seed % 6), false), need, around);
        memcpy(again.history, first.history, sizeof again.history);
        law_run_scalar(&again, LANES, choice_of((int)(seed % 6), true), need, around);
        for (int i = 0; i < LANES; i++)
            for (int k = 0; k < 3; k++) {
                assert_true(first.b.f[k][i] == again.b.f[k][i]);
                assert_true(first.b.ta[k][i] == again.b.ta[k][i]);
                assert_true(first.history[2 + k][i] == again.history[2 + k][i]);
            }
    }
}

/* What a flat or a spherical scene leaves out adds nothing where it is not left out. */
static void specialities_change_no_bit(void **state) {
    (void)state;
    static lanes special, general;
    for (uint64_t seed = 1; seed <= 500; seed++) {
        int need = (int)(seed % 8); /* without clumps */
        fill(&special, seed, LANES, (law_need){.flat = true});
        memset(special.b.oa, 0, sizeof special.b.oa), memset(special.b.ob, 0, sizeof special.b.ob);
        general = special;
        int around = around_of((int)(seed / NEEDS), need_of(need));
        law_run_scalar(&special, LANES, choice_of((int)(seed % 6), false), need | 4, around);
        law_run_scalar(&general, LANES, choice_of((int)(seed % 6), false), need & ~4, around);
        for (int i = 0; i < LANES; i++)
            for (int k = 0; k < 3; k++) {
                assert_true(special.b.f[k][i] == general.b.f[k][i]);
                assert_true(special.b.ta[k][i] == general.b.ta[k][i]);
                assert_true(special.history[2 + k][i] == general.history[2 + k][i]);
            }
    }
}

TEST_MAIN(cmocka_unit_test(vector_lanes_have_the_bits_of_scalar_code),
          cmocka_unit_test(the_law_keeps_its_promises),
          cmocka_unit_test(action_is_reaction_to_the_bit),
          cmocka_unit_test(forces_come_again_from_the_history),
          cmocka_unit_test(specialities_change_no_bit))
