/* The same bits with curved patches: spheres and rods in a drum of facets that turns, whose
 * contacts go from facet to facet. And what a search for walls costs. */
#include <unistd.h>

#include "tests/support/surface.h"

#include "engine/geometry.h"
#include "engine/numbers.h"
#include "engine/world.h"

enum { STEPS = 2400 };

typedef struct drum_wish {
    int threads;
    double skin; /* m */
    clast_isa isa;
    clast_clump_contact clump_contact;
    clast_precision precision;
    clast_law law;
} drum_wish;

static const double R = 0.003, DRUM = 0.03; /* m */

static clast_world *drum_world(const drum_wish *wish) {
    clast_world_def def = bare_def(wish->law);
    def.gravity = vec(0, -60, 0);
    def.threads = wish->threads, def.spheres_per_thread = 1;
    def.skin = wish->skin, def.isa = wish->isa;
    def.clump_contact = wish->clump_contact, def.precision = wish->precision;
    def.impact_speed = 1;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.6, 0.5);
    two_materials m = add_materials(w, &pair);
    clast_shape_add_sphere(w, "ball", R, m.soft);
    add_rod(w, m.soft, R);
    clast_part_def p = {.name = "drum", .rotation = {.axis = {0.1, 0, 1}, .speed = 25}};
    mesh_on(w, clast_part_add(w, &p), m.hard, tube_surface(DRUM, 0.02, 40, true), vec(0, 0, 0));
    dice d = {17, 0};
    for (int i = 0; i < 36; i++) {
        clast_body_def b = {.shape = i % 3 == 1,
                            .position = vec(0.0125 * (i % 3 - 1), 0.0125 * (i / 3 % 4 - 1.5),
                                            0.0125 * (i / 12 - 1)),
                            .orientation = any_orientation(&d),
                            .velocity = {roll(&d, -.2, .2), -1, 0}};
        assert_true(clast_body_add(w, &b) >= 0);
    }
    if (clast_world_prepare(w)) fail_msg("%s", clast_world_error(w));
    return w;
}

static uint64_t drum_hash(const drum_wish *wish) {
    clast_world *w = drum_world(wish);
    steps(w, STEPS);
    uint64_t hash = clast_world_hash(w);
    clast_world_free(w);
    return hash;
}

static void expect(const drum_wish *wish, uint64_t want, const char *what) {
    uint64_t got = drum_hash(wish);
    if (got != want)
        fail_msg("%s: hash %016llx, not %016llx", what, (unsigned long long)got,
                 (unsigned long long)want);
}

/* Spheres that touch a fillet. */
static size_t count_on_fillets(const clast_world *w) {
    const contact_list *l = &w->shares[0].walls;
    size_t count = 0;
    for (size_t k = 0; k < l->count; k++) {
        const centre_row *c = &w->rows.centre[l->a[k]];
        vec3 centre = from_kernel(w, centre_at(c));
        wall_touch t = touch_of_wall(&w->walls[l->b[k]], centre, c->radius);
        count += t.raised && t.overlap > 0;
    }
    return count;
}

/* Contacts with facets, those that have gone on from another one, and bodies with several. */
static void the_drum_is_worth_comparing(void **state) {
    (void)state;
    drum_wish wish = {.threads = 1, .law = CLAST_LAW_HERTZ_MINDLIN};
    clast_world *w = drum_world(&wish);
    size_t touching = 0, on_fillets = 0;
    for (int i = 0; i < STEPS; i++) {
        steps(w, 1);
        records_collect(w);
        for (size_t k = 0; k < w->records.count; k++)
            touching += w->records.items[k].b >= CLAST_WALL_ID;
        on_fillets += count_on_fillets(w);
    }
    clast_counters c = clast_world_counters(w);
    print_message("drum: %.4f s, %.1f contacts with facets, %.1f on fillets, %llu rebuilds, %zu "
                  "contacts\n",
                  clast_world_time(w), (double)touching / STEPS, (double)on_fillets / STEPS,
                  (unsigned long long)c.rebuilds, c.contacts);
    assert_true(touching > 3 * STEPS && on_fillets > STEPS / 2 && c.rebuilds > 5 &&
                c.contacts > 20);
    clast_world_free(w);
}

static void the_same_bits(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        drum_wish wish = {.threads = 1,
                          .law = kind == 1 ? CLAST_LAW_LINEAR : CLAST_LAW_HERTZ_MINDLIN,
                          .isa = CLAST_ISA_BASELINE,
                          .clump_contact = kind == 1 ? CLAST_CLUMP_SHARED : CLAST_CLUMP_EACH,
                          .precision = kind == 2 ? CLAST_PRECISION_MIXED : CLAST_PRECISION_DOUBLE};
        uint64_t want = drum_hash(&wish);
        wish.threads = 3, wish.skin = 2e-4, expect(&wish, want, "threads, a narrow skin");
        wish.threads = 1, wish.isa = CLAST_ISA_AVX2, expect(&wish, want, "avx2");
        wish.isa = CLAST_ISA_AUTO, wish.skin = 4e-3, expect(&wish, want, "auto, a wide skin");
    }
}

static void a_restart_goes_on(void **state) {
    (void)state;
    drum_wish wish = {.threads = 1, .law = CLAST_LAW_HERTZ_MINDLIN};
    scratch_name path = scratch_file("drum.h5");
    clast_world *w = drum_world(&wish);
    steps(w, STEPS / 2);
    assert_int_equal(clast_checkpoint_save(w, path.text, NULL), CLAST_OK);
    steps(w, STEPS / 2);
    uint64_t want = clast_world_hash(w);
    clast_world_free(w);
    w = drum_world(&wish);
    if (clast_checkpoint_load(w, path.text, NULL)) fail_msg("%s", clast_world_error(w));
    steps(w, STEPS / 2);
    assert_true(clast_world_hash(w) == want);
    clast_world_free(w);
    unlink(path.text);
}

/* ---- far away -------------------------------------------------------------------------------- */

/* A bowl of 2 n n triangles, all in planes of their own, and some spheres in its middle: what a
 * rebuild looks at does not grow with the triangles that are far away. */
static double tests_per_rebuild(int cells) {
    surface *s = empty_surface();
    double wide = 0.004 * cells;
    add_sheet(s, vec(-wide / 2, -wide / 2, 0), vec(wide, 0, 0), vec(0, wide, 0), cells, cells,
              NULL);
    for (int v = 0; v < s->vertices; v++) s->vertex[v].z = dot(s->vertex[v], s->vertex[v]);
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81), def.skin = 1e-4, def.threads = 1;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.6, 0.5);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    mesh_on(w, clast_part_add(w, &(clast_part_def){.name = "bowl"}), m.hard, s, vec(0, 0, 0));
    for (int i = 0; i < 9; i++) {
        clast_vec3 p = vec(0.007 * (i % 3 - 1) + 0.001, 0.007 * (i / 3 - 1), 0);
        p.z = dot(p, p) + 1.001 * R;
        add_body(w, ball, p, vec(0.3, 0.1, 0), vec(0, 0, 0));
    }
    steps(w, 1200);
    clast_counters c = clast_world_counters(w);
    assert_true(c.rebuilds > 5 && c.contacts >= 9);
    double tests = (double)c.wall_tests / (double)(c.rebuilds + 1) / 9;
    clast_world_free(w);
    return tests;
}

/* Twice as deep a tree where there are four times as many: a few boxes more. */
static void far_triangles_cost_nothing(void **state) {
    (void)state;
    double few = tests_per_rebuild(24), many = tests_per_rebuild(96);
    print_message("walls and boxes looked at per sphere and rebuild: %.1f of 1152, %.1f of 18432\n",
                  few, many);
    CHECK_BELOW(many, few + 40);
}

/* ---- many walls ------------------------------------------------------------------------------ */

enum { TEETH = 30 };

/* A row of spheres between planes and above another one, on the edge of a plate that stands askew,
 * in a world that has facets as well. */
static clast_world *rake_world(double skin) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0.2, 0.3, -9.81), def.skin = skin, def.threads = 1;
    def.clump_contact = CLAST_CLUMP_SHARED;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.6, 0.5);
    two_materials m = add_materials(w, &pair);
    clast_vec3 centre[TEETH];
    double radius[TEETH];
    for (int i = 0; i < TEETH; i++)
        centre[i] = vec((i - 0.5 * (TEETH - 1)) * 2 * R, 0, 0), radius[i] = R;
    clast_shape_def rake = {"rake", m.soft, TEETH, .centre = centre, .radius = radius};
    int row = clast_shape_add(w, &rake);
    int box = clast_part_add(w, &(clast_part_def){.name = "box"});
    /* Nearer than the margin of a wide skin: 90 entries where a batch has 64. */
    add_plane(w, box, m.hard, vec(0, 1.008 * R, 0), vec(0, -1, 0));
    add_plane(w, box, m.hard, vec(0, -1.008 * R, 0), vec(0, 1, 0));
    add_plane(w, box, m.hard, vec(0, -1.009 * R, 0), vec(0, 1, 0));
    add_plane(w, box, m.hard, vec(0, 0, -1.4 * R), vec(0, 0, 1));
    clast_wall_def plate = {"plate",
                            CLAST_WALL_PLATE,
                            m.hard,
                            .point = {0.01, 0, -2 * R},
                            .normal = {1, 0.1, 0.3},
                            .half_side = {1.03 * R, 0.01}};
    plate.side = cross(plate.normal, vec(0, 1, 0));
    assert_true(clast_wall_add(w, box, &plate) >= 0);
    surface *far = empty_surface();
    add_sheet(far, vec(0, 0.5, 0), vec(0.1, 0, 0), vec(0, 0, 0.1), 2, 2, NULL);
    mesh_on(w, box, m.hard, far, vec(0, 0, 0));
    add_body(w, row, vec(0, 0, 0.1 * R), vec(0, 0, 0), vec(0, 0.5, 0));
    return w;
}

/* Whether the walls near a body fill a batch or not is not seen. */
static void more_walls_than_a_batch_holds(void **state) {
    (void)state;
    uint64_t hash[2];
    size_t listed[2], touched = 0;
    for (int wide = 0; wide < 2; wide++) {
        clast_world *w = rake_world(wide ? 4e-3 : 1e-5);
        listed[wide] = 0;
        for (int i = 0; i < 3000; i++) {
            steps(w, 1);
            clast_counters c = clast_world_counters(w);
            if (c.candidates > listed[wide]) listed[wide] = c.candidates;
            touched += c.contacts;
        }
        hash[wide] = clast_world_hash(w);
        clast_world_free(w);
    }
    print_message("rake: %zu and %zu walls listed, %zu contacts\n", listed[0], listed[1], touched);
    assert_true(touched > 1000 && listed[1] > 64);
    assert_true(hash[0] == hash[1]);
}

TEST_MAIN(cmocka_unit_test(the_drum_is_worth_comparing), cmocka_unit_test(the_same_bits),
          cmocka_unit_test(a_restart_goes_on), cmocka_unit_test(far_triangles_cost_nothing),
          cmocka_unit_test(more_walls_than_a_batch_holds))
