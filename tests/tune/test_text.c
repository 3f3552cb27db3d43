/* What a setting puts into the text of a scene, and that nothing else changes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>

#include "experiments/tune/setting.h"

static const setting_space SPACE = {.step = 2e-6,
                                    .step_given = true,
                                    .follow = {1, 1.7320508, 3.1622777},
                                    .critical = {1e-5, 1e-4, 1e-4},
                                    .can_mix = true,
                                    .can_leap = true};

static void expect(const char *before, const setting_space *space, setting s, const char *after) {
    scene_arena arena = {0};
    scene_edit e = scene_edit_start(&arena, before);
    assert_non_null(e.root);
    assert_true(setting_apply(&e, space, s));
    char *text = scene_edit_finish(&e);
    assert_string_equal(text, after);
    free(text);
    scene_arena_free(&arena);
}

static void numbers_and_parameters(void **state) {
    (void)state;
    static const char SCENE[] = "materials: # two\n"
                                "  glass: {young: 70 GPa, poisson: 0.2} # hard\n"
                                "  steel:\n    young: $e # from the book\n    poisson: 0.3\n"
                                "pairs:\n  - {between: [glass, steel], stiffness: '2 * $k'}\n"
                                "time: {end: 1 s, step: 2 us} # chosen by eye\n";
    expect(SCENE, &SPACE, (setting){0}, SCENE);
    expect(SCENE, &SPACE, (setting){.step = 4},
           "materials: # two\n"
           "  glass: {young: 70 GPa, poisson: 0.2} # hard\n"
           "  steel:\n    young: $e # from the book\n    poisson: 0.3\n"
           "pairs:\n  - {between: [glass, steel], stiffness: '2 * $k'}\n"
           "time: {end: 1 s, step: (2 us) * 4} # chosen by eye\n");
    expect(SCENE, &SPACE, (setting){.soft = 2},
           "materials: # two\n"
           "  glass: {young: (70 GPa) / 10, poisson: 0.2} # hard\n"
           "  steel:\n    young: $e / 10 # from the book\n    poisson: 0.3\n"
           "pairs:\n  - {between: [glass, steel], stiffness: '(2 * $k) / 10'}\n"
           "time: {end: 1 s, step: (2 us) * 3.162} # chosen by eye\n");
}

static void keys_that_are_not_there(void **state) {
    (void)state;
    setting_space free_step = SPACE;
    free_step.step_given = false;
    expect("time: {end: 1 s}\n", &free_step, (setting){.step = 2, .mixed = true},
           "time: {end: 1 s, step: 4e-06 s}\nprecision: mixed\n");
    expect("time:\n  end: 1 s # long\n\n# more\nseed: 1", &free_step, (setting){.step = 2},
           "time:\n  end: 1 s # long\n  step: 4e-06 s\n\n# more\nseed: 1");
    expect("time: {\n  end: 1 s # long\n  }\n", &free_step, (setting){.step = 2},
           "time: {\n  end: 1 s, step: 4e-06 s # long\n  }\n");
    expect("time: {step: auto, end: 1 s}\nprecision: double\n", &free_step,
           (setting){.step = 2, .mixed = true},
           "time: {step: 4e-06 s, end: 1 s}\nprecision: mixed\n");
    expect("time: {end: 1 s}", &free_step, (setting){.soft = 1}, "time: {end: 1 s}");
    expect("time: {end: 1 s, scheme: gear4}\n", &SPACE, (setting){.leapfrog = true},
           "time: {end: 1 s, scheme: leapfrog}\n");
}

static void fitted_shapes_get_fewer_spheres(void **state) {
    (void)state;
    static const char SCENE[] = "parameters: {n: 7}\n"
                                "shapes:\n  a: {fit: {ellipse: [2, 1], spheres: $n}} # large\n"
                                "  b: {fit: {spheres: 3, ellipse: [2, 1]}}\n  c: {radius: 1 mm}\n"
                                "time: {step: 2 us}\n";
    scene_arena arena = {0};
    scene_edit e = scene_edit_start(&arena, SCENE);
    setting_space space = SPACE;
    space.fit_spheres = setting_fit_spheres(&e);
    assert_int_equal(space.fit_spheres, 7);
    scene_arena_free(&arena);
    expect(SCENE, &space, (setting){.fit = 1},
           "parameters: {n: 7}\n"
           "shapes:\n  a: {fit: {ellipse: [2, 1], spheres: 5}} # large\n"
           "  b: {fit: {spheres: 3, ellipse: [2, 1]}}\n  c: {radius: 1 mm}\n"
           "time: {step: 2 us}\n");
    assert_true(setting_is_possible(&space, (setting){.fit = 1}));
    space.fit_spheres = 5;
    assert_false(setting_is_possible(&space, (setting){.fit = 1})); /* that is what it has */
    assert_true(setting_is_possible(&space, (setting){.fit = 2}));
}

/* An alias is the same place again: dividing it twice would be wrong. */
static void aliases_are_edited_once(void **state) {
    (void)state;
    expect("materials:\n  a: &m {young: 1 GPa}\n  b: *m\ntime: {step: 1 us}\n", &SPACE,
           (setting){.soft = 2},
           "materials:\n  a: &m {young: (1 GPa) / 10}\n  b: *m\ntime: {step: (1 us) * 3.162}\n");
}

static void places_that_cannot_be_found_are_refused(void **state) {
    (void)state;
    scene_arena arena = {0};
    scene_edit e = scene_edit_start(&arena, "output: [a]\nbodies: {x: {y: 1}}\n");
    assert_false(scene_edit_put(&e, "output", "frames", "none"));
    assert_false(scene_edit_put(&e, "bodies", "x", "1"));
    assert_false(scene_edit_put(&e, "bodies", "z", "1"));
    assert_true(scene_edit_put(&e, "engine", "skin", "1 mm"));
    char *text = scene_edit_finish(&e);
    assert_string_equal(text, "output: [a]\nbodies: {x: {y: 1}}\nengine: {skin: 1 mm}\n");
    free(text);
    scene_arena_free(&arena);
}

static void what_is_possible_and_what_it_costs(void **state) {
    (void)state;
    assert_true(setting_is_possible(&SPACE, (setting){.step = 4}));
    assert_false(setting_is_possible(&SPACE, (setting){.step = 5})); /* 12 us: unstable */
    assert_true(setting_is_possible(&SPACE, (setting){.step = 5, .soft = 1}));
    assert_false(setting_is_possible(&SPACE, (setting){.soft = 3})); /* not looked at */
    assert_true(setting_cost(&SPACE, (setting){.step = 4}) == 0.25);
    assert_true(setting_cost(&SPACE, (setting){.step = 4, .mixed = true}) < 0.25);
    setting_space none = SPACE;
    none.can_mix = false;
    assert_false(setting_is_possible(&none, (setting){.mixed = true}));
    char text[SETTING_LABEL];
    setting_describe((setting){.step = 4, .soft = 2, .fit = 2, .mixed = true}, text);
    assert_string_equal(text, "step x 4, stiffness / 10, spheres 3, mixed");
    setting_name((setting){.step = 4, .soft = 2, .fit = 2, .mixed = true}, text);
    assert_string_equal(text, "step4-soft10-fit3-mixed");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_and_parameters),
        cmocka_unit_test(keys_that_are_not_there),
        cmocka_unit_test(fitted_shapes_get_fewer_spheres),
        cmocka_unit_test(aliases_are_edited_once),
        cmocka_unit_test(places_that_cannot_be_found_are_refused),
        cmocka_unit_test(what_is_possible_and_what_it_costs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
