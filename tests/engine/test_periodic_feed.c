/* A feed as wide as a periodic domain: nobody is put into who stands behind the face, bodies come
 * right up to it, fall through it and leave, and the books are exact. */
#include "tests/support/scene.h"

static const double R = 0.005, WIDTH = 0.04, DT = 1e-4, SPEED = 0.5;

typedef struct slab {
    clast_world *w;
    int feed, outlet;
} slab;

/* Along y the faces are one. */
static slab new_slab(double rate, double reach) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, -3, -9.81); /* round and round, and down */
    def.time_step = DT;
    def.threads = 1;
    def.domain_min = vec(-0.1, -0.5 * WIDTH, -0.5), def.domain_max = vec(0.1, 0.5 * WIDTH, 0.2);
    def.periodic[1] = true;
    slab s = {.w = new_world(&def)};
    clast_pair_def pair = pair_of(0.3, 0.4);
    two_materials m = add_materials(s.w, &pair);
    int ball = clast_shape_add_sphere(s.w, "ball", R, m.soft);
    int box = clast_part_add(s.w, &(clast_part_def){.name = "box"});
    add_plane(s.w, box, m.hard, vec(-0.03, 0, 0), vec(1, 0, 0));
    add_plane(s.w, box, m.hard, vec(0.03, 0, 0), vec(-1, 0, 0));
    clast_feed_def feed = {.name = "hopper",
                           .region_min = {-0.03, -reach, 0.05},
                           .region_max = {0.03, reach, 0.08},
                           .shapes = 1,
                           .shape = &ball,
                           .number_rate = rate,
                           .velocity = {0, SPEED, 0}};
    clast_outlet_def out = {.name = "end", .point = {0, 0, -0.2}, .normal = {0, 0, -1}};
    s.feed = clast_feed_add(s.w, &feed), s.outlet = clast_outlet_add(s.w, &out);
    return s;
}

/* Distance by the nearest image. */
static double apart(const clast_bodies *b, size_t i, size_t k) {
    double y = b->y[i] - b->y[k];
    return norm(vec(b->x[i] - b->x[k], y - WIDTH * round(y / WIDTH), b->z[i] - b->z[k]));
}

typedef struct tally {
    double nearest;      /* m, of a body that has just come to any other */
    int at_face, across; /* came with the face in reach; with a neighbour behind it */
} tally;

static void look_at_newcomers(clast_world *w, uint32_t first, tally *t) {
    clast_bodies b = clast_world_bodies(w);
    for (size_t i = 0; i < b.count; i++) {
        if (b.id[i] < first) continue;
        t->at_face += fabs(b.y[i]) > 0.5 * WIDTH - R;
        for (size_t k = 0; k < b.count; k++) {
            if (k == i) continue;
            double d = apart(&b, i, k);
            t->nearest = fmin(t->nearest, d);
            t->across += d < 4 * R && fabs(b.y[i] - b.y[k]) > 0.5 * WIDTH;
        }
    }
}

/* Far more than there is room for: where a place is taken is asked thousands of times. */
static void nobody_is_put_into_another(void **state) {
    (void)state;
    slab s = new_slab(3000, 0.5 * WIDTH);
    tally t = {.nearest = INFINITY};
    for (int i = 0; i < 4000; i++) {
        uint64_t had = clast_world_feed_flow(s.w, s.feed).bodies;
        steps(s.w, 1);
        look_at_newcomers(s.w, (uint32_t)had, &t);
    }
    clast_flow in = clast_world_feed_flow(s.w, s.feed),
               out = clast_world_outlet_flow(s.w, s.outlet);
    print_message("%llu came, %llu refused, %d at the face, %d with a neighbour behind it, nearest "
                  "%.4f diameters\n",
                  (unsigned long long)in.bodies, (unsigned long long)in.refused, t.at_face,
                  t.across, t.nearest / (2 * R));
    assert_true(in.refused > 10 && t.at_face > 20 && t.across > 20);
    CHECK_BELOW(2 * R - 2 * SPEED * DT, t.nearest); /* one step after it was put */
    size_t inside = clast_world_bodies(s.w).count;
    assert_true(out.bodies > 50 && in.bodies == inside + out.bodies);
    clast_world_free(s.w);
}

/* As many as are asked for, where there is room; a body that came in by a feed goes round. */
static void the_rate_is_kept_and_bodies_go_round(void **state) {
    (void)state;
    slab s = new_slab(100, 0.5 * WIDTH);
    int round_trips = 0;
    for (int i = 0; i < 40; i++) {
        steps(s.w, 100);
        clast_bodies b = clast_world_bodies(s.w);
        for (size_t k = 0; k < b.count; k++) round_trips += b.image[1][k] != 0;
    }
    clast_flow in = clast_world_feed_flow(s.w, s.feed);
    assert_int_equal(in.bodies, 40 + 1); /* one at the start */
    assert_true(in.refused == 0 && round_trips > 100);
    clast_world_free(s.w);
}

static void what_reaches_through_a_face_is_refused(void **state) {
    (void)state;
    slab s = new_slab(100, 0.5 * WIDTH + R);
    assert_true(clast_world_prepare(s.w) != CLAST_OK);
    assert_non_null(strstr(clast_world_error(s.w), "region that reaches out of the domain"));
    clast_world_free(s.w);
}

TEST_MAIN(cmocka_unit_test(nobody_is_put_into_another),
          cmocka_unit_test(the_rate_is_kept_and_bodies_go_round),
          cmocka_unit_test(what_reaches_through_a_face_is_refused))
