/* summary.c - replicates into means with intervals, and facts by name. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

/* ---- facts ----------------------------------------------------------------------------------- */

#define FACT(name, value)                                                                          \
    static double name(const aspect_case *c) {                                                     \
        return (value);                                                                            \
    }
FACT(height, c->bed.height)
FACT(phi, c->bed.phi)
FACT(phi_exact, c->bed.phi_exact)
FACT(phi_all, c->bed.phi_all)
FACT(per_cell, c->bed.per_cell)
FACT(skewness, c->bed.skewness)
FACT(kurtosis, c->bed.kurtosis)
FACT(coordination, c->bed.coordination)
FACT(with_walls, c->bed.with_walls)
FACT(stable, c->bed.stable)
FACT(force, 100 * c->bed.force)
FACT(force_last, 100 * c->bed.force_last)
FACT(force_rest, 100 * c->bed.force_rest)
FACT(single, c->bed.subcontacts[0])
FACT(delay, c->flow.delay)
FACT(first, c->flow.first)
FACT(meets, c->flow.meets)
FACT(linear_share, c->flow.linear_share)
FACT(rate, c->flow.rate)
FACT(rate_kg, c->flow.rate_kg)
FACT(rate_99, c->flow.rate_r2[0])
FACT(rate_9995, c->flow.rate_r2[1])
FACT(start_up, c->flow.start_up)
FACT(fluctuation, c->flow.fluctuation)
FACT(arches_seen, c->flow.arches)
FACT(lowest, c->flow.lowest)
FACT(left_share, c->flow.left)
FACT(ratio_left, c->flow.ratio[0])
FACT(ratio_centre, c->flow.ratio[1])
FACT(ratio_right, c->flow.ratio[2])
FACT(ratio_all, c->flow.ratio_all)
FACT(ratio_sides, 0.5 * (c->flow.ratio[0] + c->flow.ratio[2]) - c->flow.ratio[1])
FACT(mean_all, c->flow.ratio_mean_all)
FACT(mean_sides, 0.5 * (c->flow.ratio_mean[0] + c->flow.ratio_mean[2]) - c->flow.ratio_mean[1])
FACT(mean_left, c->flow.ratio_mean[0])
FACT(mean_centre, c->flow.ratio_mean[1])
FACT(mean_right, c->flow.ratio_mean[2])
FACT(angle, c->flow.angle[SHEAR_TIMES / 2])
FACT(steepness, 90 - fabs(90 - c->flow.angle[SHEAR_TIMES / 2]))
FACT(angle_first, c->flow.angle[0])
FACT(angle_last, c->flow.angle[SHEAR_TIMES - 1])
FACT(angle_70, c->flow.angle_70)
FACT(pulse, c->flow.pulse)
FACT(pressure, c->flow.pressure_mean)
FACT(janssen_k, c->flow.janssen_k)
FACT(janssen_r2, c->flow.janssen_r2)
FACT(heap_slope_then, c->flow.heap_slope)
FACT(heap_end, c->flow.heap_end)
FACT(level, c->flow.level)
FACT(level_end, c->flow.level_end)
FACT(fastest, c->flow.fastest)
FACT(turned, c->flow.turned)

const named_fact FACTS[] = {
    {"bed height", "m", height},
    {"solid fraction", "", phi},
    {"solid fraction by area", "", phi_exact},
    {"solid fraction of all cells", "", phi_all},
    {"particles in a full cell", "", per_cell},
    {"skewness", "", skewness},
    {"kurtosis", "", kurtosis},
    {"co-ordination number", "", coordination},
    {"co-ordination number with walls", "", with_walls},
    {"stable after", "s", stable},
    {"bottom force off the weight", "%", force},
    {"bottom force off the weight at the end", "%", force_last},
    {"bottom force off the weight at rest", "%", force_rest},
    {"pairs that touch at one point", "", single},
    {"start-up delay", "s", delay},
    {"first particle out", "s", first},
    {"delay by the linear part", "s", meets},
    {"linear part", "", linear_share},
    {"rate", "%/s", rate},
    {"rate in mass", "kg/s", rate_kg},
    {"rate with R2 0.99", "%/s", rate_99},
    {"rate with R2 0.9995", "%/s", rate_9995},
    {"time to the linear part", "s", start_up},
    {"fluctuation of the rate", "", fluctuation},
    {"arches", "", arches_seen},
    {"lowest rate over the mean", "", lowest},
    {"left in the hopper", "", left_share},
    {"energy ratio left", "log10", ratio_left},
    {"energy ratio centre", "log10", ratio_centre},
    {"energy ratio right", "log10", ratio_right},
    {"energy ratio", "log10", ratio_all},
    {"energy ratio sides over centre", "log10", ratio_sides},
    {"energy ratio left by particles", "log10", mean_left},
    {"energy ratio centre by particles", "log10", mean_centre},
    {"energy ratio right by particles", "log10", mean_right},
    {"energy ratio by particles", "log10", mean_all},
    {"energy ratio sides over centre by particles", "log10", mean_sides},
    {"shear angle", "deg", angle},
    {"steepness of the shear band", "deg", steepness},
    {"shear angle at 0.1 s", "deg", angle_first},
    {"shear angle at 0.4 s", "deg", angle_last},
    {"shear angle at 70 %", "deg", angle_70},
    {"wall pulse", "", pulse},
    {"wall load", "N/m", pressure},
    {"Janssen K", "", janssen_k},
    {"Janssen R2", "", janssen_r2},
    {"heap slope at 1.4 s", "deg", heap_slope_then},
    {"heap slope at the end", "deg", heap_end},
    {"level of the heap at 1.4 s", "", level},
    {"level of the heap at the end", "", level_end},
    {"fastest particle at 1.4 s", "m/s", fastest},
    {"turned by tracked particles", "rad", turned},
};
const int FACT_COUNT = sizeof FACTS / sizeof *FACTS;

fact *fact_named(const char *name) {
    for (int i = 0; i < FACT_COUNT; i++)
        if (!strcmp(FACTS[i].name, name)) return FACTS[i].of;
    CLAST_ASSERT(!"a fact");
    return NULL;
}

/* ---- replicates ------------------------------------------------------------------------------ */

int values_at(const aspect_study *s, int shape, int setting, int of_variant, fact *of,
              double value[REPLICATES_MAX]) {
    int n = 0;
    for (int i = 0; i < s->count && n < REPLICATES_MAX; i++) {
        const aspect_case *c = &s->cases[i];
        if (!c->ran || c->in_space || c->shape != shape || c->setting != setting ||
            c->variant != of_variant)
            continue;
        value[n] = of(c);
        n += isfinite(value[n]);
    }
    return n;
}

/* s: a time is known to a sample of the series that it is read off. */
static double known_within(fact *of) {
    if (of == stable) return BED_SAMPLE;
    return of == delay || of == first || of == start_up ? FLOW_SAMPLE : 0;
}

static interval over_cases(const aspect_study *s, int shape, int setting, int of_variant,
                           fact *of) {
    double value[REPLICATES_MAX];
    interval r = mean_interval(value, values_at(s, shape, setting, of_variant, of, value));
    if (r.n > 1) r.half = fmax(r.half, known_within(of));
    return r;
}

interval over(const aspect_study *s, int shape, fact *of) {
    interval cheap = over_cases(s, shape, CHEAP, 0, of);
    return cheap.n > 0 ? cheap : at_thesis(s, shape, of);
}

interval over_variant(const aspect_study *s, int of_variant, fact *of) {
    return over_cases(s, VARIANTS[of_variant].shape, CHEAP, of_variant, of);
}

interval at_thesis(const aspect_study *s, int shape, fact *of) {
    return over_cases(s, shape, THESIS, 0, of);
}
