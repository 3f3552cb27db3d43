/* Fillets in the hollow seams of smooth patches: the distance from a smooth surface, near the one
 * of the file, the same from both facets, in any frame and however the facets are cut. */
#include "tests/support/surface.h"

#include "engine/geometry.h"
#include "engine/numbers.h"
#include "engine/world.h"

/* The deepest of all walls, with fillets or, as they are in the file, without. */
static wall_touch deepest(const clast_world *w, clast_vec3 centre, double radius, bool plain) {
    wall_touch best = {.overlap = -INFINITY};
    for (int i = 0; i < w->wall_count; i++) {
        if (!is_in_box(&w->walls[i], centre, 2 * radius)) continue;
        wall l = w->walls[i];
        if (plain) l.fillets.count = 0;
        wall_touch t = touch_of_wall(&l, centre, radius);
        t.wall = &w->walls[i];
        if (t.overlap > best.overlap) best = t;
    }
    return best;
}

/* ---- two plates that meet -------------------------------------------------------------------- */

/* Of that width along x on both sides of the y axis, rising to both sides at half the angle; 0.4 m
 * long. */
static surface *wedge(double angle, double width) {
    surface *s = empty_surface();
    for (int i = -1; i <= 1; i++)
        for (int side = -1; side <= 1; side += 2)
            add_vertex(
                s, vec(i * width * cos(angle / 2), 0.2 * side, abs(i) * width * sin(angle / 2)));
    for (int32_t a = 0; a < 4; a += 2)
        add_face(s, a, a + 2, a + 1), add_face(s, a + 2, a + 3, a + 1);
    return s;
}

/* Over the seam a sphere of 20 mm stands on a fillet of half the width of its plates, or of what
 * raises the surface by 1 % of the sphere; where it does not fit into that, it stands on the
 * plates. From below there is an edge. */
static void a_seam_is_rounded_as_far_as_agreed(void **state) {
    (void)state;
    const double r = 0.02, low = 0.9999 * r;
    double most = 0;
    int rounded = 0, sharp = 0;
    for (int degrees = 1; degrees <= 30; degrees++)
        for (double width = 0.002; width < 0.1; width *= 2) {
            int patches;
            double angle = degrees * NUMBER_PI / 180, tangent = tan(angle / 2),
                   over = 1 / cos(angle / 2);
            if (low * tangent > width) continue; /* too large for the plates */
            clast_world *w = feeling_world(wedge(angle, width), 0, &patches);
            double round = fmin(0.5 * width / tangent, 0.01 * r / (over - 1));
            bool fits = round > low && 0.01 * r / (over - 1) > r;
            double raise = fits ? (round - low) * (over - 1) : 0;
            wall_touch t = deepest(w, vec(0, 0.03, low * over), r, false);
            CHECK_CLOSE(t.overlap, r - low + raise, 1e-9);
            assert_true(t.raised == fits);
            if (fits) CHECK_BELOW(norm(minus(t.normal, vec(0, 0, 1))), 1e-9);
            assert_true(!deepest(w, vec(0, 0.03, -low), r, false).raised);
            most = fmax(most, raise / r);
            rounded += fits, sharp += !fits;
            clast_world_free(w);
        }
    print_message("%d wedges rounded, by %.5f of a radius at most; %d not\n", rounded, most, sharp);
    assert_true(rounded > 40 && sharp > 40);
    CHECK_BELOW(most, 0.01);
}

/* ---- uneven drums, irregular bowls ----------------------------------------------------------- */

static const double DRUM = 0.1; /* m, radius of a drum; a bowl's at its bottom */

static surface *uneven_drum(dice *d) {
    enum { FACETS = 70 };
    surface *s = tube_surface(DRUM, 0.1, FACETS, false);
    for (int v = 0; v < s->vertices; v += 2) {
        double sine, cosine, turn = 2 * NUMBER_PI * (v / 2 + roll(d, -.2, .2)) / FACETS;
        clast_sincos(turn, &sine, &cosine);
        for (int end = 0; end < 2; end++)
            s->vertex[v + end] = vec(DRUM * cosine, DRUM * sine, s->vertex[v].z * (end ? -1 : 1));
    }
    return s;
}

/* Triangles in planes of their own, uneven with dice. */
static surface *bowl(dice *d) {
    surface *s = empty_surface();
    add_sheet(s, vec(-0.08, -0.08, 0), vec(0.16, 0, 0), vec(0, 0.16, 0), 24, 24, d);
    for (int v = 0; v < s->vertices; v++) {
        clast_vec3 p = s->vertex[v];
        s->vertex[v].z = (p.x * p.x + p.y * p.y) / (2 * DRUM);
    }
    return s;
}

/* A place from which a sphere touches the drum (from inside, or outside) or the bowl (from above,
 * or below) by up to 3 % of its radius, or nearly. */
static clast_vec3 any_place(dice *d, bool in_bowl, bool hollow, double r) {
    double side = hollow ? 1 : -1, near = r * roll(d, .97, .995);
    if (!in_bowl) {
        double sine, cosine, away = DRUM - side * near;
        clast_sincos(roll(d, 0, 2 * NUMBER_PI), &sine, &cosine);
        return vec(away * cosine, away * sine, roll(d, -.05, .05));
    }
    clast_vec3 p = vec(roll(d, -.05, .05), roll(d, -.05, .05), 0);
    p.z = dot(p, p) / (2 * DRUM);
    clast_vec3 up = vec(-p.x / DRUM, -p.y / DRUM, 1);
    return plus(p, times(side * near / norm(up), up));
}

static clast_vec3 any_way(dice *d) {
    clast_vec3 v = vec(roll(d, -1, 1), roll(d, -1, 1), roll(d, -1, 1));
    return times(1 / norm(v), v);
}

/* 1/m, how fast the normal may turn: about the fillet that is least wider than the sphere. */
static double sharpest(const clast_world *w, double r) {
    double most = 0;
    for (int i = 0; i < w->wall_count; i++) {
        const fillet_list *l = &w->walls[i].fillets;
        for (int k = 0; k < l->count; k++) {
            const fillet *f = &l->item[k];
            most = fmax(most, 1 / (fmin(f->width, f->cap * r) / f->tangent - r));
        }
    }
    return most;
}

typedef struct walk {
    double uneven; /* of a step, that a distance changes by more than the step */
    double slope;  /* of a step, that it changes otherwise than the normal says */
    double turn;   /* rad/m, of the normal, the largest */
    double jumps;  /* rad, in steps in which it turns by more than a milliradian */
    double plain;  /* rad, the same without fillets */
    int steps, raised;
} walk;

/* Straight ways of 1.5 mm in steps of 1 um. */
static walk walk_about(const clast_world *w, dice *d, bool in_bowl, bool hollow) {
    enum { WALKS = 40, STEPS = 1500 };
    const double r = 0.02, step = 1e-6, JUMP = 1e-3;
    walk all = {0};
    for (int i = 0; i < WALKS; i++) {
        clast_vec3 at = any_place(d, in_bowl, hollow, r), way = times(step, any_way(d));
        wall_touch before = deepest(w, at, r, false), flat_before = deepest(w, at, r, true);
        for (int k = 0; k < STEPS; k++) {
            at = plus(at, way);
            wall_touch t = deepest(w, at, r, false), flat = deepest(w, at, r, true);
            if (t.overlap < 1e-3 * r || t.overlap > 0.1 * r) break;
            double change = before.overlap - t.overlap;
            double turn = norm(minus(t.normal, before.normal));
            clast_vec3 mean = times(0.5, plus(t.normal, before.normal));
            all.uneven = fmax(all.uneven, fabs(change) / step - 1);
            if (turn < JUMP) all.slope = fmax(all.slope, fabs(change - dot(mean, way)) / step);
            all.turn = fmax(all.turn, turn / step);
            all.jumps += turn > JUMP ? turn : 0, all.raised += t.raised, all.steps++;
            turn = norm(minus(flat.normal, flat_before.normal));
            all.plain += turn > JUMP ? turn : 0;
            before = t, flat_before = flat;
        }
    }
    return all;
}

/* The distance goes steadily, by no more than the way, and along the normal: so it has a potential,
 * and no force jumps. Neither does the normal in a drum, nor in a bowl of even triangles but in
 * their corners, where fillets taper to nothing; between uneven triangles it jumps by less. From
 * the bulging side it turns about edges as before. */
static void the_distance_is_that_of_a_smooth_surface(void **state) {
    (void)state;
    static const char *const NAME[] = {"drum", "even bowl", "uneven bowl"};
    for (int kind = 0; kind < 6; kind++) {
        int form = kind / 2;
        bool hollow = kind % 2;
        dice d = {41, 0};
        int patches;
        surface *s = form == 0 ? uneven_drum(&d) : bowl(form == 1 ? NULL : &d);
        clast_world *w = feeling_world(s, 0, &patches);
        walk all = walk_about(w, &d, form > 0, hollow);
        print_message(
            "%s, %s side (dice 41): %d steps, %d on fillets; %.1e beyond a step, slope "
            "off by %.1e, normal turns by up to %.3g rad/m and jumps by %.2f rad, without "
            "fillets by %.2f\n",
            NAME[form], hollow ? "hollow" : "bulging", all.steps, all.raised, all.uneven, all.slope,
            all.turn, all.jumps, all.plain);
        assert_true(all.steps > 20000 && (all.raised > all.steps / 8) == hollow);
        CHECK_BELOW(all.uneven, 1e-8);
        CHECK_BELOW(all.slope, 1e-3);
        assert_true(all.plain > 0.1 || !hollow);
        if (hollow) CHECK_BELOW(all.jumps, form == 2 ? 0.8 * all.plain : 1e-9);
        if (hollow && form == 0) CHECK_BELOW(all.turn, 1.001 * sharpest(w, 0.02));
        clast_world_free(w);
    }
}

/* Where no fillet is, the distance is that of the planes; where one is, it is less by 1 % of the
 * radius at most, and no more than the facets stand away from what they stand for. */
static void it_stays_near_the_file(void **state) {
    (void)state;
    for (int form = 0; form < 2; form++) {
        dice d = {43, 0};
        int patches, raised = 0, plain = 0;
        clast_world *w = feeling_world(form ? bowl(&d) : uneven_drum(&d), 0, &patches);
        double r = 0.02, most = 0;
        for (int i = 0; i < 6000; i++) {
            clast_vec3 at = any_place(&d, form, true, r);
            wall_touch t = deepest(w, at, r, false), flat = deepest(w, at, r, true);
            if (!t.raised)
                assert_true(t.overlap == flat.overlap && norm(minus(t.normal, flat.normal)) == 0);
            assert_true(t.overlap >= flat.overlap);
            most = fmax(most, t.overlap - flat.overlap);
            raised += t.raised, plain += !t.raised;
        }
        print_message("%s (dice 43): %d of %d on fillets, up to %.2e of a radius\n",
                      form ? "bowl" : "drum", raised, raised + plain, most / r);
        assert_true(raised > 1000 && plain > 100);
        CHECK_BELOW(most, 0.01 * r);
        clast_world_free(w);
    }
}

/* ---- balls ----------------------------------------------------------------------------------- */

static double width_of(const fillet *f, double cap, double s) {
    double narrow = fmin(1, cap / f->width), y = 1;
    if (s < narrow * f->rise[0]) y = s / (narrow * f->rise[0]);
    if (f->length - s < narrow * f->rise[1]) y = (f->length - s) / (narrow * f->rise[1]);
    return narrow * f->width * (1 - (1 - y) * (1 - y));
}

/* m, the largest of radius - way to the centre over very many of the balls of a fillet. */
static double distance_by_balls(const fillet *f, double cap, double s, double in, double up) {
    enum { BALLS = 20000 };
    double most = -INFINITY;
    for (int i = 0; i < BALLS; i++) {
        double at = f->length * (i + 0.5) / BALLS, width = width_of(f, cap, at);
        double ball = width / f->tangent, d[3] = {s - at, in - width, up - ball};
        most = fmax(most, ball - sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
    }
    return most;
}

/* Whether a facet is on the other side of a seam. */
static bool is_across(const wall *other, const wall *own, const fillet *f) {
    for (int k = 0; k < other->fillets.count; k++) {
        const fillet *g = &other->fillets.item[k];
        if (other != own && g->length == f->length && g->width == f->width) return true;
    }
    return false;
}

/* Its middle and its ends against the balls that they are made of; a sphere
 * small enough to be held by its cap, and one that is not. On the plane between two facets both say
 * the same. */
static void a_fillet_is_made_of_balls(void **state) {
    (void)state;
    dice d = {47, 0};
    int patches, met = 0, twice = 0;
    clast_world *w = feeling_world(bowl(&d), 0, &patches);
    double off = 0, apart = 0;
    for (int i = 0; i < 400; i++) {
        const wall *l = &w->walls[(int)roll(&d, 0, patches)];
        if (l->fillets.count == 0) continue;
        const fillet *f = &l->fillets.item[(int)roll(&d, 0, l->fillets.count)];
        double r = i % 2 ? 0.02 : 0.0005, cap = f->cap * r, up = r * roll(&d, .9, 1);
        double s = f->length * roll(&d, 0, 1), in = i % 4 < 2 ? up * f->tangent : 0;
        if (in == 0) in = roll(&d, up * f->tangent, fmax(2 * up * f->tangent, 0.003));
        double u = f->from[0] + s * f->way[0] - in * f->inward * f->way[1];
        double v = f->from[1] + s * f->way[1] + in * f->inward * f->way[0];
        vec3 flat = v3_add(v3_scale(u, l->u), v3_scale(v, l->v));
        vec3 at = v3_add(l->point, v3_add(flat, v3_scale(f->side * up, l->n)));
        fillet_touch t, other;
        if (in >= width_of(f, cap, s) || !fillet_at(l, at, r, &t)) continue;
        double want = distance_by_balls(f, cap, s, in, up);
        off = fmax(off, fabs(r - t.overlap - want) / r);
        met++;
        for (int k = 0; k < w->wall_count && i % 4 < 2; k++) {
            if (!is_across(&w->walls[k], l, f) || !fillet_at(&w->walls[k], at, r, &other)) continue;
            apart = fmax(apart, fabs(other.overlap - t.overlap) / r);
            apart = fmax(apart, norm(minus(other.normal, t.normal)));
            twice++;
        }
    }
    print_message("%d places on fillets: off by %.1e of a radius, the two facets differ by %.1e at "
                  "%d\n",
                  met, off, apart, twice);
    assert_true(met > 100 && twice > 50);
    CHECK_BELOW(off, 2e-6);
    CHECK_BELOW(apart, 1e-9);
    clast_world_free(w);
}

/* ---- frames, periodic axes ------------------------------------------------------------------- */

/* The same mesh turned and moved: the same touches, turned. */
static void a_fillet_turns_with_its_mesh(void **state) {
    (void)state;
    dice d = {53, 0}, again = {53, 0};
    int patches;
    clast_quat q = any_orientation(&(dice){59, 0});
    clast_vec3 offset = vec(0.3, -0.2, 0.1);
    mat3 turn = q_matrix(q);
    clast_world *w = feeling_world(bowl(&d), 0, &patches);
    surface *s = bowl(&again);
    turn_surface(s, q, offset);
    clast_world *turned = feeling_world(s, 0, &patches);
    int raised = 0;
    for (int i = 0; i < 2000; i++) {
        clast_vec3 at = any_place(&d, true, true, 0.02);
        wall_touch a = deepest(w, at, 0.02, false);
        wall_touch b = deepest(turned, plus(m3_apply(&turn, at), offset), 0.02, false);
        CHECK_NEAR(a.overlap, b.overlap, 1e-9 * 0.02);
        raised += a.raised;
        if (a.raised && b.raised && a.wall - w->walls == b.wall - turned->walls)
            CHECK_BELOW(norm(minus(m3_apply(&turn, a.normal), b.normal)), 1e-7);
    }
    assert_true(raised > 300);
    clast_world_free(w), clast_world_free(turned);
}

/* A tube that spans a periodic domain has no ends there: it is felt the same all along, where the
 * open one's fillets end. */
static void a_tube_through_a_periodic_face_has_no_ends(void **state) {
    (void)state;
    for (int periodic = 0; periodic < 2; periodic++) {
        clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
        def.domain_min = vec(-0.2, -0.2, -0.1), def.domain_max = vec(0.2, 0.2, 0.1);
        def.periodic[2] = periodic;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        clast_shape_add_sphere(w, "ball", 0.02, m.soft);
        mesh_with(w, clast_part_add(w, &(clast_part_def){.name = "tube"}), m.hard,
                  tube_surface(DRUM, 0.1, 64, false), 0);
        if (clast_world_prepare(w)) fail_msg("%s", clast_world_error(w));
        double least = INFINITY, most = 0;
        for (int i = 0; i < 200; i++) {
            clast_vec3 at = vec(DRUM - 0.02, 0, -0.1 + 0.2 * (i + 0.5) / 200);
            double overlap = deepest(w, at, 0.02, false).overlap;
            least = fmin(least, overlap), most = fmax(most, overlap);
        }
        if (periodic)
            CHECK_BELOW(most - least, 1e-15);
        else
            assert_true(most - least > 1e-5);
        clast_world_free(w);
    }
}

TEST_MAIN(cmocka_unit_test(a_seam_is_rounded_as_far_as_agreed),
          cmocka_unit_test(the_distance_is_that_of_a_smooth_surface),
          cmocka_unit_test(it_stays_near_the_file), cmocka_unit_test(a_fillet_is_made_of_balls),
          cmocka_unit_test(a_fillet_turns_with_its_mesh),
          cmocka_unit_test(a_tube_through_a_periodic_face_has_no_ends))
