# `index` that is killed on its way goes on where it was; cmake -DPROGRAM= -DWORK= -DFILE= -P interrupted.cmake
include(${CMAKE_CURRENT_LIST_DIR}/functions.cmake)
set(program "[==[${PROGRAM}]==]")
configure_file(${FILE} ${WORK}/field.nc COPYONLY)
run("${program} index field.nc --cache whole")
if(NOT code EQUAL 0 OR NOT out MATCHES "^([0-9]+) steps: ([0-9]+) written, 0 there before")
  fail("all are written")
endif()
set(all ${CMAKE_MATCH_1})

# Killed once a step is there; where it was quicker than that, again.
file(WRITE ${WORK}/killed.sh "
\"$@\" & pid=$!
while [ -z \"$(ls steps/*.isostep 2>/dev/null)\" ] && kill -0 $pid 2>/dev/null; do :; done
kill -9 $pid; wait $pid")
set(written ${all})
foreach(try RANGE 20)
  file(REMOVE_RECURSE ${WORK}/steps)
  run("sh killed.sh ${program} index field.nc --cache steps")
  file(GLOB there ${WORK}/steps/*.isostep)
  list(LENGTH there written)
  if(written GREATER 0 AND written LESS all)
    break()
  endif()
endforeach()
if(NOT written LESS all OR written EQUAL 0)
  fail("it was never killed on its way: ${written} of ${all}")
endif()
math(EXPR left "${all} - ${written}")
run("${program} index field.nc --cache steps")
if(NOT code EQUAL 0 OR NOT out MATCHES "^${all} steps: ${left} written, ${written} there before")
  fail("expected ${left} to be written, and ${written} there before")
endif()
expectSame(whole steps)
