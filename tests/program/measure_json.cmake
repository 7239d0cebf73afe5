# `measure --json` says exactly what the documentation promises, in the promised types.
include(${CMAKE_CURRENT_LIST_DIR}/functions.cmake)
arguments(given ${begin} ${end})
run("[==[${PROGRAM}]==] ${given}")
if(NOT code EQUAL 0)
  fail("measure failed")
endif()

expectMembers("${out}" file STRING variable STRING units STRING step NUMBER ranges STRING
              points NUMBER size ARRAY frames NUMBER rays NUMBER drawnBy STRING threads NUMBER truth STRING
              notes ARRAY views ARRAY modes ARRAY best OBJECT)
string(JSON views LENGTH "${out}" views)
string(JSON modes LENGTH "${out}" modes)
if(NOT views EQUAL 2 OR NOT modes EQUAL 11)
  fail("${views} views and ${modes} modes, expected 2 and 11")
endif()
string(JSON view GET "${out}" views 1)
expectMembers("${view}" azimuth NUMBER elevation NUMBER)
foreach(i RANGE 10)
  string(JSON mode GET "${out}" modes ${i})
  expectMembers("${mode}" mode STRING order STRING light STRING frame NUMBER before NUMBER drawn NUMBER
                depthError NUMBER sampledError NUMBER modelError NUMBER
                subsetError NUMBER pixelsError NUMBER orderError NUMBER arithmeticError NUMBER mass NUMBER massIsOff BOOLEAN popping NUMBER rmse NUMBER psnr NUMBER
                largest NUMBER colorDifference NUMBER)
endforeach()
string(JSON best GET "${out}" best)
expectMembers("${best}" mostAccurate ARRAY soonest ARRAY)
# Cells are the closest.
string(JSON points GET "${out}" modes 3 depthError)
string(JSON cells GET "${out}" modes 4 depthError)
if(NOT cells LESS points)
  fail("the error of cells, ${cells}, is not below that of points, ${points}")
endif()
