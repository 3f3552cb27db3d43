/* drum_leaks - whether anything gets through a closed mesh: a drum of flat facets, that turns and
 * is shaken, half full of spheres and rods.
 *
 *     drum_leaks BODIES STEPS
 *
 * Exit code 1 as soon as a centre is outside of a facet or a guard stops the run. The test runs it
 * small; 1e8 sphere-steps are `drum_leaks 1000 80000`. */
#include "tests/support/surface.h"

#include "engine/part.h"
#include "engine/numbers.h"

static const double R = 0.003; /* m */

typedef struct drum {
    clast_world *w;
    int part, first_wall;
    double radius, half_length; /* m */
} drum;

/* Room for so many bodies on the grid of fill(). */
static drum new_drum(int bodies) {
    clast_world_def def = clast_world_def_default();
    double radius = 4.2 * R * cbrt(bodies);
    def.gravity = vec(0, -9.81, 0);
    def.impact_speed = 2, def.max_overlap = 0.25, def.threads = 0;
    double room = 2 * radius;
    def.domain_min = vec(-room, -room, -room), def.domain_max = vec(room, room, room);
    drum d = {.w = new_world(&def), .radius = radius, .half_length = 0.5 * radius};
    clast_pair_def pair = pair_of(0.5, 0.4);
    two_materials m = add_materials(d.w, &pair);
    clast_shape_add_sphere(d.w, "ball", R, m.soft);
    add_rod(d.w, m.soft, R);
    clast_part_def p = {
        .name = "drum",
        .rotation = {.axis = {0, 0, 1}, .speed = 6},
        .oscillation = {.amplitude = {0.002, 0.001, 0.0015}, .frequency = 8, .phase = 0.1}};
    d.part = clast_part_add(d.w, &p);
    d.first_wall = clast_world_wall_count(d.w);
    surface *s = tube_surface(d.radius, d.half_length, 48, true);
    dice side = {5, 0};
    /* vertices of the lids' middles apart, all are on the tube; its facets become uneven */
    for (int v = 0; v < s->vertices - 2; v += 2) {
        double sine, cosine, turn = 2 * NUMBER_PI * (v / 2 + roll(&side, -.3, .3)) / 48;
        clast_sincos(turn, &sine, &cosine);
        s->vertex[v] = vec(d.radius * cosine, d.radius * sine, s->vertex[v].z);
        s->vertex[v + 1] = vec(d.radius * cosine, d.radius * sine, s->vertex[v + 1].z);
    }
    mesh_on(d.w, d.part, m.hard, s, vec(0, 0, 0));
    return d;
}

/* Places of a grid within the drum, from below; every third body is a rod. */
static int fill(const drum *d, int bodies) {
    dice any = {11, 0};
    double pitch = 4.2 * R, most = d->radius - 3 * R;
    int placed = 0;
    for (double y = -most; y < most; y += pitch)
        for (double x = -most; x < most; x += pitch)
            for (double z = -d->half_length + 3 * R; z < d->half_length - 3 * R; z += pitch) {
                if (x * x + y * y > most * most || placed == bodies) continue;
                clast_body_def b = {.shape = placed % 3 == 2,
                                    .position = vec(x, y, z),
                                    .orientation = any_orientation(&any),
                                    .velocity = {roll(&any, -.3, .3), 0, roll(&any, -.3, .3)}};
                assert_true(clast_body_add(d->w, &b) >= 0);
                placed++;
            }
    return placed;
}

/* Every sphere has its centre inside of every facet, in the frame of the drum. */
static bool all_inside(const drum *d, const double *side) {
    const clast_world *w = d->w;
    for (size_t i = 0; i < w->sphere_count; i++) {
        const centre_row *c = &w->rows.centre[i];
        vec3 centre = part_in(&w->parts[d->part], v3(c->x, c->y, c->z));
        for (int k = d->first_wall; k < w->wall_count; k++) {
            const clast_wall_def *l = &w->walls[k].def;
            if (v3_dot(v3_sub(centre, l->point), l->normal) * side[k] > 0) continue;
            fprintf(stderr, "step %llu: sphere %zu is outside of facet %d\n",
                    (unsigned long long)w->step, i, k);
            return false;
        }
    }
    return true;
}

static bool runs(drum *d, uint64_t wanted) {
    clast_world *w = d->w;
    double *side = calloc((size_t)w->wall_count, sizeof *side);
    if (!side) abort();
    if (clast_world_prepare(w)) return fprintf(stderr, "%s\n", clast_world_error(w)), false;
    for (int k = d->first_wall; k < w->wall_count; k++)
        side[k] = -v3_dot(w->walls[k].def.point, w->walls[k].def.normal);
    bool inside = true;
    for (uint64_t i = 0; i < wanted && inside; i++) {
        if (clast_world_step(w)) {
            fprintf(stderr, "step %llu: %s\n", (unsigned long long)w->step, clast_world_error(w));
            inside = false;
        }
        if (i % 20 == 0) inside = inside && all_inside(d, side);
    }
    free(side);
    return inside;
}

int main(int argc, char **argv) {
    if (argc != 3) return fprintf(stderr, "usage: drum_leaks BODIES STEPS\n"), 2;
    int wanted = atoi(argv[1]);
    drum d = new_drum(wanted);
    int bodies = fill(&d, wanted);
    if (bodies != wanted) return fprintf(stderr, "no room for %d bodies\n", wanted), 2;
    bool inside = runs(&d, (uint64_t)atoll(argv[2]));
    clast_counters c = clast_world_counters(d.w);
    clast_energy e = clast_world_energy(d.w);
    printf("%d bodies of %zu spheres in %d facets: %.3g sphere-steps, %.2f s, largest overlap %.3f "
           "of a radius, residual %.1e of the input: %s\n",
           bodies, c.spheres, d.w->wall_count, (double)c.steps * (double)c.spheres,
           clast_world_time(d.w), c.overlap_max, e.residual / e.input,
           inside ? "nothing outside" : "failed");
    clast_world_free(d.w);
    return inside ? 0 : 1;
}
