# Writes ${OUT}: the hash of the libraries that make a run what it is. Runs are cached under it.
set(all "")
foreach(library ${LIBRARIES})
    file(SHA256 ${library} hash)
    string(APPEND all ${hash})
endforeach()
string(SHA256 digest "${all}")
file(WRITE ${OUT}.new "#define ENGINE_DIGEST \"${digest}\"\n")
execute_process(COMMAND ${CMAKE_COMMAND} -E copy_if_different ${OUT}.new ${OUT})
