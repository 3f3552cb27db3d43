# The program in the README is the program that is built. cmake -DREADME=... -DPROGRAM=... -P test_readme.cmake
file(READ ${README} readme)
file(READ ${PROGRAM} program)
string(FIND "${readme}" "```c\n${program}```" place)
if(place EQUAL -1)
    message(FATAL_ERROR "${README} does not show ${PROGRAM} as it is")
endif()
