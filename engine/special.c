/* special.c - what the scene does not need: picks the kernels and the quanta of the loads. */
#include "engine/flow.h"
#include "engine/numbers.h"
#include "engine/part.h"
#include "engine/ranks.h"

contact_kernel contact_kernel_baseline, contact_kernel_mixed_baseline;
body_kernel body_kernel_baseline;
contact_kernel contact_kernel_avx2, contact_kernel_mixed_avx2;
contact_kernel contact_kernel_avx512, contact_kernel_mixed_avx512;
body_kernel body_kernel_avx2, body_kernel_avx512;

/* A build may leave kernels out (CLAST_ISA in CMakeLists.txt). Not by weak symbols: the linker does
 * not look into an archive for those, and the kernels would be missing everywhere. */
#ifdef CLAST_HAS_AVX2
#define KERNEL_AVX2(name) name
#else
#define KERNEL_AVX2(name) NULL
#endif
#ifdef CLAST_HAS_AVX512
#define KERNEL_AVX512(name) name
#else
#define KERNEL_AVX512(name) NULL
#endif

/* ---- instruction sets ------------------------------------------------------------------------ */

typedef struct kernels {
    const char *name;
    contact_kernel *full, *mixed;
    body_kernel *bodies;
} kernels;

static const kernels BASELINE = {"baseline", contact_kernel_baseline, contact_kernel_mixed_baseline,
                                 body_kernel_baseline};
static const kernels AVX2 = {"avx2", KERNEL_AVX2(contact_kernel_avx2),
                             KERNEL_AVX2(contact_kernel_mixed_avx2), KERNEL_AVX2(body_kernel_avx2)};
static const kernels AVX512 = {"avx512", KERNEL_AVX512(contact_kernel_avx512),
                               KERNEL_AVX512(contact_kernel_mixed_avx512),
                               KERNEL_AVX512(body_kernel_avx512)};

static bool has_avx2(void) {
    return AVX2.full && __builtin_cpu_supports("avx2");
}

static bool has_avx512(void) {
    return AVX512.full && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
}

/* A wish that the processor or the build cannot fulfil falls back to the next best. */
void special_choose_kernels(clast_world *w) {
    clast_isa wish = w->def.isa == CLAST_ISA_AUTO ? CLAST_ISA_AVX512 : w->def.isa;
    bool widest = wish == CLAST_ISA_AVX512 && has_avx512();
    const kernels *k = widest ? &AVX512 : wish >= CLAST_ISA_AVX2 && has_avx2() ? &AVX2 : &BASELINE;
    w->isa_name = k->name;
    w->contact_kernel = w->def.precision == CLAST_PRECISION_MIXED ? k->mixed : k->full;
    w->body_kernel = k->bodies;
}

/* ---- specialities ---------------------------------------------------------------------------- */

static bool is_single(const shape *s) {
    return s->spheres == 1 && s->centre[0].x == 0 && s->centre[0].y == 0 && s->centre[0].z == 0;
}

static bool has_rolling(const clast_world *w) {
    for (int i = 0; i < w->material_count * w->material_count; i++)
        if (w->coefs[i].set && w->coefs[i].rolling > 0) return true;
    return false;
}

static bool has_tangent(const clast_world *w) {
    if (w->def.law == CLAST_LAW_USER) return true; /* its friction may be a number of its own */
    for (int i = 0; i < w->material_count * w->material_count; i++)
        if (w->coefs[i].set && (w->coefs[i].friction > 0 || w->coefs[i].cohesion > 0)) return true;
    return has_rolling(w); /* what turns spheres */
}

/* A wall that can push in the plane of motion alone, seen from spheres at height z of its axis. */
static bool wall_is_flat(const clast_world *w, const wall *l, double z) {
    vec3 n = to_kernel(w, l->n), u = to_kernel(w, l->u), v = to_kernel(w, l->v);
    if (n.z != 0 || to_kernel(w, l->def.belt_velocity).z != 0) return false;
    if (!part_is_flat(w, &w->parts[l->part])) return false;
    if (l->def.kind == CLAST_WALL_PLANE) return true;
    if (l->def.kind == CLAST_WALL_PATCH) return false;
    double height = z - to_kernel(w, l->def.point).z;
    if (u.z == 0 && fabs(v.z) == 1) return fabs(height) < l->def.half_side[1];
    if (v.z == 0 && fabs(u.z) == 1) return fabs(height) < l->def.half_side[0];
    return false;
}

static bool is_flat(const clast_world *w) {
    const flow *f = w->flow;
    bool empty = w->bodies.count == 0;
    if (w->def.motion != CLAST_MOTION_IN_PLANE || (empty && f->feed_count == 0)) return false;
    double z = to_kernel(w, empty ? f->feeds[0].def.region_min : body_position(w, 0)).z;
    for (int i = 0; i < f->feed_count; i++)
        if (to_kernel(w, f->feeds[i].def.region_min).z != z) return false;
    for (size_t i = 1; i < w->bodies.count; i++)
        if (to_kernel(w, body_position(w, i)).z != z) return false;
    for (int s = 0; s < w->shape_count; s++)
        for (int k = 0; k < w->shapes[s].spheres; k++)
            if (to_kernel(w, w->shapes[s].centre[k]).z != 0) return false;
    for (int l = 0; l < w->wall_count; l++)
        if (!wall_is_flat(w, &w->walls[l], z)) return false;
    return true;
}

/* Axes must be set. */
void special_choose(clast_world *w) {
    if (!w->prepared) law_prepare(w);
    const shape *first = &w->shapes[0];
    speciality k = {.tangent = has_tangent(w),
                    .spring = law_has_spring(w),
                    .rolling = has_rolling(w),
                    .oriented = w->def.turn_spheres,
                    .one_shape = w->shape_count == 1,
                    .round = true,
                    .one_kind = true,
                    .one_material = true};
    for (int i = 0; i < w->shape_count; i++) {
        const shape *s = &w->shapes[i];
        k.clumps |= !is_single(s);
        k.round &= s->round_inertia;
        k.oriented |= !is_single(s) || !s->round_inertia || s->outline_points > 0;
        k.one_material &= s->material == first->material;
        k.one_kind &= s->mass == first->mass;
        for (int e = 0; e < s->spheres; e++) k.one_kind &= s->radius[e] == first->radius[0];
    }
    k.one_kind &= k.one_material;
    k.one_wall = k.one_kind;
    for (int l = 1; l < w->wall_count; l++)
        k.one_wall &= w->walls[l].def.material == w->walls[0].def.material;
    for (int l = 0; l < w->wall_count; l++) {
        k.facets |= w->walls[l].family >= 0;
        k.fillets |= w->walls[l].fillets.count > 0;
    }
    k.flat = w->prepared && w->ranks ? w->special.flat : is_flat(w); /* of all bodies */
    k.shared = k.clumps && w->def.clump_contact == CLAST_CLUMP_SHARED;
    for (int l = 0; l < w->wall_count; l++) {
        const part *p = &w->parts[w->walls[l].part];
        k.turning |= p->turns;
        k.pushing |= wall_pushes(w, &w->walls[l]);
        k.driving |= wall_drives(w, &w->walls[l]);
    }
    w->special = k;
}

/* ---- quanta of what parts do -----------------------------------------------------------------
 */

/* `force`: N, that no contact has more of. */
static void choose_push_scales(clast_world *w, double force) {
    double lever = w->largest_bound, belt = 0;
    vec3 wide = v3_sub(w->def.domain_max, w->def.domain_min);
    lever += v3_norm(wide);
    for (int l = 0; l < w->wall_count; l++)
        belt = fmax(belt, v3_norm(w->walls[l].def.belt_velocity));
    w->moment_scale = sum_scale_for(force * number_power_of_two_above(lever));
    w->belt_scale = sum_scale_for(force * number_power_of_two_above(fmax(belt, 1e-30)));
}

/* ---- quanta of the loads ----------------------------------------------------------------------
 */

/* Eight times the elastic force at twice the overlap at which the guard stops the run. What is
 * larger is caught as a failure. Sums of four such forces fit; at rest, a sphere of steel or glass
 * has its weight resolved to better than 1e-11. */
void special_choose_scale(clast_world *w) {
    double radius = 0, mass = 0, weight = 0, largest = 0, rolling = 0;
    for (int i = 0; i < w->shape_count; i++) {
        const shape *s = &w->shapes[i];
        for (int e = 0; e < s->spheres; e++) radius = fmax(radius, s->radius[e]);
        mass = fmax(mass, s->mass);
        weight = fmax(weight, s->mass * v3_norm(w->def.gravity));
    }
    bool stops = w->def.guards == CLAST_GUARD_STOP && w->def.max_overlap < 1;
    double overlap = (stops ? 2 * w->def.max_overlap : 2) * radius;
    for (int i = 0; i < w->material_count * w->material_count; i++) {
        const pair_coef *c = &w->coefs[i];
        if (!c->set) continue;
        largest = fmax(largest, law_elastic_force(w, c, radius, mass, overlap) + c->cohesion);
        rolling = fmax(rolling, c->rolling);
    }
    double force = number_power_of_two_above(fmax(8 * largest, 1e-100) + 100 * weight);
    double arm = number_power_of_two_above(w->largest_bound * (1 + rolling));
    choose_push_scales(w, force);
    w->load_scale = (load_scale){.force = 0x1p61 / force,
                                 .torque = 0x1p61 / (force * arm),
                                 .force_quantum = force * 0x1p-61,
                                 .torque_quantum = force * arm * 0x1p-61,
                                 .limit = 0x1p61};
}
