# Runs every `./run` of the README that opens no window with the program itself, in an empty folder.
#   cmake -DPROGRAM=... -DREADME=... -DSOURCE=... -DWORK=... -P readme.cmake
file(READ ${README} text)
string(REPLACE ";" "\;" text "${text}")
string(REGEX REPLACE "\\\\\n *" "" text "${text}")  # continued lines
string(REGEX MATCHALL "\n    \\./run (info|count|render|measure|index|cache) [^\n]*" commands "${text}")
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/out)
set(ENV{XDG_CACHE_HOME} ${WORK}/cache)  # the user's own stays as it is
set(count 0)
foreach(command IN LISTS commands)
  if(command MATCHES "your_file")
    continue()
  endif()
  string(REGEX REPLACE "^\n    \\./run " "" arguments "${command}")
  string(REPLACE "datasets/" "${SOURCE}/datasets/" arguments "${arguments}")
  separate_arguments(arguments UNIX_COMMAND "${arguments}")
  execute_process(COMMAND ${PROGRAM} ${arguments} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE code
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "the README's command fails:${command}\n${output}")
  endif()
  math(EXPR count "${count} + 1")
endforeach()
if(count LESS 4)
  message(FATAL_ERROR "only ${count} commands were found in ${README}: has its form changed?")
endif()
message("${count} commands of the README work")
