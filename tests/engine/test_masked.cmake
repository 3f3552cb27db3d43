# Runs the hash program plainly and with glibc's variants for FMA and AVX2 masked: other bits of libm, the
# same hash. The names are those of glibc 2.33 and later.
# cmake -DPROGRAM=... -P test_masked.cmake
set(masks "" "-AVX2,-FMA" "-AVX,-AVX2,-FMA,-AVX512F")
foreach(mask IN LISTS masks)
    foreach(isa baseline avx2 auto)
        execute_process(COMMAND ${CMAKE_COMMAND} -E env "GLIBC_TUNABLES=glibc.cpu.hwcaps=${mask}"
            ${PROGRAM} ${isa} fingerprint OUTPUT_VARIABLE out RESULT_VARIABLE status)
        if(NOT status EQUAL 0 OR NOT out MATCHES "hash (0x[0-9a-f]+)\nlibm (0x[0-9a-f]+)")
            message(FATAL_ERROR "mask '${mask}', ${isa}: exit ${status}, ${out}")
        endif()
        list(APPEND variants ${CMAKE_MATCH_2})
        if(DEFINED want AND NOT want STREQUAL CMAKE_MATCH_1)
            message(FATAL_ERROR "mask '${mask}', ${isa}: ${CMAKE_MATCH_1} instead of ${want}")
        endif()
        set(want ${CMAKE_MATCH_1})
    endforeach()
endforeach()
list(REMOVE_DUPLICATES variants)
list(LENGTH variants count)
message(STATUS "hash ${want} with ${count} variants of libm")
if(count LESS 2)
    message(STATUS "nothing was masked: this processor or C library has one variant only")
endif()
