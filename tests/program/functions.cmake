# Functions for the scripts of this folder, which run the real program in an empty folder of the
# test's own. A command line is a text of arguments in bracket quotes: no list of CMake's, which
# would lose empty arguments and split at ';'.

function(fail)
  string(CONCAT text ${ARGN})
  message(FATAL_ERROR "${text}\ncommand: ${commandText}\nexit code: ${code}\nstdout:\n${out}\nstderr:\n${err}")
endfunction()

# arguments(VARIABLE FIRST LAST): the script's own arguments FIRST to LAST - 1, quoted.
function(arguments variable first last)
  set(text "")
  set(i ${first})
  while(i LESS last)
    string(APPEND text " [==[${CMAKE_ARGV${i}}]==]")
    math(EXPR i "${i} + 1")
  endwhile()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# Sets code, out and err.
macro(run text)
  set(commandText "${text}")
  cmake_language(EVAL CODE "execute_process(COMMAND ${text} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err TIMEOUT 120)")
endmacro()

# expectMembers(JSON NAME TYPE...): these members and no other.
function(expectMembers json)
  string(JSON count LENGTH "${json}")
  set(rest ${ARGN})
  set(expected 0)
  while(rest)
    list(POP_FRONT rest name type)
    string(JSON found ERROR_VARIABLE error TYPE "${json}" ${name})
    if(NOT found MATCHES "^(${type})$")
      fail("${name} is ${found} ${error}, expected ${type}")
    endif()
    math(EXPR expected "${expected} + 1")
  endwhile()
  if(NOT count EQUAL expected)
    fail("${count} members, expected ${expected}: ${ARGN}")
  endif()
endfunction()

# expectSame(EXPECTED FOUND [COUNT]): the folder FOUND has EXPECTED's files, so many, to the byte.
function(expectSame expected found)
  file(GLOB names RELATIVE ${WORK}/${expected} ${WORK}/${expected}/*)
  file(GLOB there RELATIVE ${WORK}/${found} ${WORK}/${found}/*)
  list(LENGTH names count)
  if(count EQUAL 0 OR NOT there STREQUAL names OR (ARGC GREATER 2 AND NOT count EQUAL "${ARGV2}"))
    fail("expected in ${found} what is in ${expected}: ${names}; found ${there}")
  endif()
  foreach(name IN LISTS names)
    execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/${expected}/${name} ${WORK}/${found}/${name}
                    RESULT_VARIABLE differ)
    if(differ)
      fail("${found}/${name} is not ${expected}/${name}")
    endif()
  endforeach()
endfunction()

# Where the script's own arguments begin (after --) and end.
set(begin 0)
foreach(i RANGE ${CMAKE_ARGC})
  if(begin EQUAL 0 AND "${CMAKE_ARGV${i}}" STREQUAL "--")
    math(EXPR begin "${i} + 1")
  endif()
endforeach()
set(end ${CMAKE_ARGC})

file(GLOB left ${WORK}/*)
if(left)
  file(REMOVE_RECURSE ${left})
endif()
