/* world.c - making and freeing a world, its materials and pairs. */
#include <stdlib.h>
#include <string.h>

#include "engine/flow.h"
#include "engine/parallel.h"
#include "engine/part.h"
#include "engine/ranks.h"
#include "engine/world.h"

enum { DEF_MAGIC = 0x434c5354 };

clast_world_def clast_world_def_default(void) {
    return (clast_world_def){
        .gravity = {0, 0, -9.81},
        .law = CLAST_LAW_HERTZ_MINDLIN,
        .limit = CLAST_LIMIT_TOTAL,
        .unloading = CLAST_UNLOAD_RESCALE,
        .motion = CLAST_MOTION_3D,
        .plane_axis = 1,
        .newton_tolerance = 1e-10,
        .newton_iterations = 200,
        .rayleigh_fraction = 0.2,
        .contact_resolution = 30,
        .domain_min = {-10, -10, -10},
        .domain_max = {10, 10, 10},
        .max_overlap = 0.05,
        .max_displacement = 0.1,
        .max_residual = 0.05,
        .spheres_per_thread = 500,
        .seed = 1,
        .magic = DEF_MAGIC,
    };
}

static const char *new_error;

const char *clast_world_new_error(void) {
    return new_error ? new_error : "";
}

static const char *fault_of(const clast_world_def *d) {
    vec3 lo = d->domain_min, hi = d->domain_max;
    if (!isfinite(v3_dot(d->gravity, d->gravity))) return "gravity is not finite";
    if (!(d->global_damping >= 0)) return "global_damping is below zero";
    if (!isfinite(d->global_damping)) return "global_damping is not finite";
    if (d->plane_axis < 0 || d->plane_axis > 2) return "plane_axis is not 0, 1 or 2";
    if ((unsigned)d->scheme >= CLAST_SCHEMES) return "scheme is not one of those there are";
    if (!(d->newton_tolerance > 0 && d->newton_tolerance < 1))
        return "newton_tolerance is not in (0, 1)";
    if (d->newton_iterations < 1) return "newton_iterations is below one";
    if (d->linear_solver != CLAST_SOLVER_CONJUGATE_GRADIENT &&
        d->linear_solver != CLAST_SOLVER_GAUSS_SEIDEL)
        return "linear_solver is not one of the two";
    if (!(d->time_step >= 0)) return "time_step is below zero";
    if (!isfinite(d->time_step)) return "time_step is not finite";
    if (!(d->rayleigh_fraction > 0 && d->rayleigh_fraction <= 1))
        return "rayleigh_fraction is not in (0, 1]";
    if (!(d->contact_resolution >= 5)) return "contact_resolution is below 5";
    if (!isfinite(d->contact_resolution)) return "contact_resolution is not finite";
    if (!(d->impact_speed >= 0)) return "impact_speed is below zero";
    if (!isfinite(d->impact_speed)) return "impact_speed is not finite";
    if (!(lo.x < hi.x && lo.y < hi.y && lo.z < hi.z)) return "the domain is empty";
    if (!isfinite(v3_norm(v3_sub(hi, lo)))) return "the domain is not finite";
    if (!(d->max_overlap > 0 && d->max_displacement > 0 && d->max_residual > 0))
        return "a guard's limit is not above zero";
    if (d->motion == CLAST_MOTION_IN_PLANE && d->periodic[d->plane_axis])
        return "the domain is periodic across the plane of motion";
    if (!(d->skin >= 0)) return "skin is below zero";
    if (!isfinite(d->skin)) return "skin is not finite";
    if (d->precision != CLAST_PRECISION_DOUBLE && d->precision != CLAST_PRECISION_MIXED)
        return "precision is not one of the two";
    if ((unsigned)d->tangent > CLAST_TANGENT_VISCOUS) return "tangent is not one of the three";
    if ((unsigned)d->clump_contact > CLAST_CLUMP_SHARED)
        return "clump_contact is not one of the two";
    if (d->threads < 0 || d->threads > 1024) return "threads is not in 0 .. 1024";
    if (d->spheres_per_thread < 1) return "spheres_per_thread is below one";
    return NULL;
}

clast_world *clast_world_new(const clast_world_def *def) {
    CLAST_ASSERT(def && def->magic == DEF_MAGIC);
    new_error = fault_of(def);
    if (new_error) return NULL;
    clast_world *w = calloc(1, sizeof *w);
    CLAST_ASSERT(w);
    w->def = *def;
    w->flow = memory_grow(w, NULL, 0, 1, sizeof *w->flow);
    bool remembers = clast_law_info_of(def->law)->yields || def->law == CLAST_LAW_USER;
    w->history_columns = remembers ? HISTORY_COLUMNS : HISTORY_PLASTIC;
    w->counters.bytes += sizeof *w;
    bool plane = w->def.motion == CLAST_MOTION_IN_PLANE;
    for (int k = 0; k < 3; k++) w->axes[k] = plane ? (w->def.plane_axis + 1 + k) % 3 : k;
    period_choose(w);
    return w;
}

static void free_scene(clast_world *w) {
    for (int i = 0; i < w->material_count; i++) free(w->materials[i].name);
    for (int i = 0; i < w->shape_count; i++) {
        shape *s = &w->shapes[i];
        free(s->name), free(s->centre), free(s->radius), free(s->outline);
    }
    parts_free(w);
    for (int i = 0; i < w->wall_count; i++) {
        wall *l = &w->walls[i];
        free(l->name), free(l->patch.corner), free(l->fillets.item);
    }
    free(w->materials), free(w->shapes), free(w->walls), free(w->coefs);
    free(w->wall_rows), free(w->push_index);
}

void clast_world_free(clast_world *w) {
    if (!w) return;
    free_scene(w);
    integrator_free(w);
    flow_free(w);
    user_law_free(w);
    shares_free(w);
    ranks_leave(w);
#define X(type, name) free(w->bodies.name);
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++) free(w->bodies.image[k]);
    row_store *r = &w->rows;
    free(r->motion), free(r->loads), free(r->centre), free(r->arm), free(r->first);
    free(r->inertia);
    carry_free(w);
    free(w->records.items), free(w->slot_of_id);
    free(w->view.vx), free(w->view.vy), free(w->view.vz), free(w->view.mass);
    free(w->view.wx), free(w->view.wy), free(w->view.wz);
    free(w->view.sx), free(w->view.sy), free(w->view.sz), free(w->view.radius), free(w->view.body);
    free(w->cells.cell_first), free(w->cells.ghost_first), free(w->way.places);
    free(w);
}

/* ---- materials ------------------------------------------------------------------------------- */

static void grow_coefs(clast_world *w, int old, int now) {
    pair_coef *table = memory_grow(w, NULL, 0, (size_t)now * (size_t)now, sizeof *table);
    for (int i = 0; i < old; i++)
        for (int j = 0; j < old; j++) table[i * now + j] = w->coefs[i * old + j];
    free(w->coefs);
    w->coefs = table;
}

int clast_material_add(clast_world *w, const clast_material_def *def) {
    CLAST_ASSERT(w && def && !w->prepared);
    const char *name = def->name ? def->name : "?";
    if (!(def->density > 0) || !isfinite(def->density))
        return world_fail(w, CLAST_ERR_ARGUMENT, "material %s: density is not above zero", name),
               -1;
    if (!(def->young > 0) || !isfinite(def->young))
        return world_fail(w, CLAST_ERR_ARGUMENT, "material %s: Young's modulus is not above zero",
                          name),
               -1;
    if (!(def->poisson > -1 && def->poisson < 0.5))
        return world_fail(w, CLAST_ERR_ARGUMENT, "material %s: Poisson's ratio is not in (-1, 0.5)",
                          name),
               -1;
    int n = w->material_count;
    w->materials = memory_grow(w, w->materials, (size_t)n, (size_t)n + 1, sizeof *w->materials);
    w->materials[n] = (material){memory_text(w, name), def->density, def->young, def->poisson};
    grow_coefs(w, n, n + 1);
    w->material_count++;
    return n;
}

static bool is_size(double x) {
    return x >= 0 && isfinite(x);
}

static bool dissipation_is_given(const clast_world *w, const clast_pair_def *d) {
    return clast_law_info_of(w->def.law)->dissipation && d->dissipation > 0;
}

static const char *pair_fault(const clast_world *w, const clast_pair_def *d) {
    const clast_law_info *law = clast_law_info_of(w->def.law);
    if (law->dissipation && !is_size(d->dissipation)) return "dissipation is below zero";
    if (law->dissipation && !is_size(d->reference_speed)) return "reference_speed is below zero";
    bool solved = w->def.law != CLAST_LAW_USER && !dissipation_is_given(w, d);
    if (solved && !(d->restitution > 0.01 && d->restitution <= 1))
        return "restitution is not in (0.01, 1]";
    if (!is_size(d->friction)) return "friction is below zero";
    if (!is_size(d->cohesion)) return "cohesion is below zero";
    if (!is_size(d->rolling_friction)) return "rolling_friction is below zero";
    if (!(d->tangential_restitution >= 0 && d->tangential_restitution <= 1))
        return "tangential_restitution is not in [0, 1]";
    if (law->stiffness && !(d->stiffness > 0 && isfinite(d->stiffness)))
        return "this law needs a stiffness above zero";
    if (law->linear && !is_size(d->tangential_ratio)) return "tangential_ratio is below zero";
    return NULL;
}

/* Solving takes milliseconds, and pairs of a scene often share a restitution. */
static double damping_for(const clast_world *w, double restitution) {
    for (int i = 0; i < w->material_count * w->material_count; i++)
        if (w->coefs[i].set && w->coefs[i].restitution == restitution) return w->coefs[i].damping;
    return clast_damping_ratio(w->def.law, restitution);
}

clast_status clast_pair_set(clast_world *w, int a, int b, const clast_pair_def *d) {
    CLAST_ASSERT(w && d && a >= 0 && a < w->material_count && b >= 0 && b < w->material_count);
    const material *ma = &w->materials[a], *mb = &w->materials[b];
    const char *fault = pair_fault(w, d);
    if (fault)
        return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT, "pair %s / %s: %s", ma->name,
                                        mb->name, fault);
    double ga = ma->young / (2 * (1 + ma->poisson)), gb = mb->young / (2 * (1 + mb->poisson));
    bool given = dissipation_is_given(w, d) || w->def.law == CLAST_LAW_USER;
    pair_coef c = {
        .set = true,
        .e_star = 1 / ((1 - ma->poisson * ma->poisson) / ma->young +
                       (1 - mb->poisson * mb->poisson) / mb->young),
        .g_star = 1 / ((2 - ma->poisson) / ga + (2 - mb->poisson) / gb),
        .stiffness = d->stiffness,
        .ratio = d->tangential_ratio,
        .damping = given ? 0 : damping_for(w, d->restitution),
        .tangential_restitution = d->tangential_restitution,
        .dissipation = given ? d->dissipation : 0,
        .dissipation_given = given,
        .reference_speed = d->reference_speed,
        .friction = d->friction,
        .cohesion = d->cohesion,
        .restitution = given ? 0 : d->restitution,
        .rolling = d->rolling_friction,
    };
    memcpy(c.parameter, d->parameter, sizeof c.parameter);
    w->coefs[a * w->material_count + b] = w->coefs[b * w->material_count + a] = c;
    if (w->prepared) law_prepare_pair(w, a, b);
    return CLAST_OK;
}

clast_status clast_pair_set_friction(clast_world *w, int a, int b, double friction) {
    CLAST_ASSERT(w && a >= 0 && a < w->material_count && b >= 0 && b < w->material_count);
    if (!(friction >= 0) || !isfinite(friction))
        return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT, "friction is below zero");
    w->coefs[a * w->material_count + b].friction = friction;
    w->coefs[b * w->material_count + a].friction = friction;
    if (!w->prepared) return CLAST_OK;
    special_choose(w);
    if (!w->special.tangent) contacts_forget_springs(w);
    return CLAST_OK;
}
