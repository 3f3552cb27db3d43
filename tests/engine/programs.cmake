# Programs of the engine tests that are not cmocka programs.

# one hash, whatever variants of libm the processor would get
add_executable(engine_hash_program engine/hash_program.c)
target_link_libraries(engine_hash_program PRIVATE test_support)
add_test(NAME engine_masked_libm COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:engine_hash_program>
    -P ${CMAKE_CURRENT_SOURCE_DIR}/engine/test_masked.cmake)
clast_label(engine_masked_libm)

string(REPLACE ";" " " built_isa "${CLAST_ISA}")
target_compile_definitions(engine_test_threads_determinism PRIVATE "BUILT_ISA=\"${built_isa}\"")

# spheres and rods in a closed drum of facets: small here, 1e8 sphere-steps as its head says
add_executable(engine_drum_leaks engine/drum_leaks.c)
target_link_libraries(engine_drum_leaks PRIVATE test_support)
add_test(NAME engine_drum_leaks_small COMMAND engine_drum_leaks 60 40000)
clast_label(engine_drum_leaks_small)

# the law once in plain scalar code without optimisation, and once per instruction set
add_executable(engine_law_lanes engine/law_lanes.c)
target_link_libraries(engine_law_lanes PRIVATE test_support)
function(add_law_lanes name)
    add_library(law_${name} OBJECT engine/law_lanes_run.c)
    add_library(law_flags_${name} INTERFACE) # linked last: the last -O counts
    target_compile_options(law_flags_${name} INTERFACE ${ARGN})
    target_link_libraries(law_${name} PRIVATE clast_flags law_flags_${name})
    target_compile_definitions(law_${name} PRIVATE LAW_RUN=law_run_${name})
    target_sources(engine_law_lanes PRIVATE $<TARGET_OBJECTS:law_${name}>)
endfunction()
add_law_lanes(scalar -O0 -Wno-unknown-pragmas)
add_law_lanes(baseline -O3 -fopenmp-simd)
add_law_lanes(avx2 -O3 -fopenmp-simd -mavx2 -mfma)
add_law_lanes(avx512 -O3 -fopenmp-simd -mavx512f -mavx512dq -mavx512vl -mavx512bw
    -mprefer-vector-width=512)
add_test(NAME engine_law_lanes COMMAND engine_law_lanes)
clast_label(engine_law_lanes)

# laws of the user's own, for engine_test_user_law
foreach(law linear example)
    add_library(user_law_${law} MODULE engine/user_law_${law}.c)
    target_link_libraries(user_law_${law} PRIVATE clast_flags)
    string(TOUPPER ${law} LAW)
    target_compile_definitions(engine_test_user_law PRIVATE
        USER_LAW_${LAW}="$<TARGET_FILE:user_law_${law}>")
    add_dependencies(engine_test_user_law user_law_${law})
endforeach()

# the program that engine/README.md shows: built from the public header alone, run, compared
add_executable(engine_example_thirty_lines engine/example_thirty_lines.c)
target_link_libraries(engine_example_thirty_lines PRIVATE clast_engine)
add_test(NAME engine_example COMMAND engine_example_thirty_lines)
set_tests_properties(engine_example PROPERTIES
    PASS_REGULAR_EXPRESSION "contacts, .*mJ of motion left.*hash: 0x[0-9a-f]+")
add_test(NAME engine_example_in_readme COMMAND ${CMAKE_COMMAND}
    -DREADME=${CMAKE_SOURCE_DIR}/engine/README.md
    -DPROGRAM=${CMAKE_CURRENT_SOURCE_DIR}/engine/example_thirty_lines.c
    -P ${CMAKE_CURRENT_SOURCE_DIR}/engine/test_readme.cmake)
foreach(test engine_example engine_example_in_readme)
    set_property(TEST ${test} PROPERTY LABELS quick)
    set_property(TEST ${test} PROPERTY TIMEOUT 60)
endforeach()

# rules that a reviewer should not have to remember
if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/tidy)
    add_test(NAME tidy COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/tidy ${CMAKE_SOURCE_DIR})
    add_test(NAME tidy_finds_breaches COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/tidy --self-test)
    set_tests_properties(tidy tidy_finds_breaches PROPERTIES LABELS quick TIMEOUT 120)
endif()
