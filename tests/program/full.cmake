# Output that finds no room is a failure that leaves nothing: cmake -DPROGRAM= -DWORK= -DSHELL= -DSTDERR=
# -P full.cmake -- ARGUMENTS. SHELL is what a shell is told to run the program ("$0" "$@"); STDERR the regular
# expression that the sentence begins with.
include(${CMAKE_CURRENT_LIST_DIR}/functions.cmake)
arguments(given ${begin} ${end})
run("sh -c [==[${SHELL}]==] [==[${PROGRAM}]==] ${given}")
if(NOT code EQUAL 1 OR NOT err MATCHES "^isochron: ${STDERR}[^\n]*\n$")
  fail("expected exit code 1 and a sentence")
endif()
file(GLOB left ${WORK}/* ${WORK}/.*)
if(left)
  fail("left: ${left}")
endif()
