# Output that a full disk loses is a failure: cmake -DPROGRAM= -DWORK= -P full.cmake -- ARGUMENTS.
include(${CMAKE_CURRENT_LIST_DIR}/functions.cmake)
arguments(given ${begin} ${end})
run("sh -c [==[\"$0\" \"$@\" > /dev/full]==] [==[${PROGRAM}]==] ${given}")
if(NOT code EQUAL 1 OR NOT err MATCHES "^isochron: standard output[^\n]+\n$")
  fail("expected exit code 1 and a sentence")
endif()
