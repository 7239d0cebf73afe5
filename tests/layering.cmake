# Checks the layers by the #include lines: timeseries <- render <- xr <- app, datasets beside render;
# and their rooms, each of which knows those before it alone.
# cmake -DROOT=<source tree> -P layering.cmake
# Fails with every line that reaches where it may not.

cmake_minimum_required(VERSION 3.22)

set(kinds *.h *.hpp *.cpp *.c *.inl)
set(violations "")

# look(SOURCES WHY REGEX BUT): none of the files includes what matches REGEX and does not match BUT.
function(look sources why regex but)
  foreach(source ${sources})
    file(STRINGS ${source} includes REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]*).*" "\\1" header "${line}")
      if(header MATCHES "${regex}" AND NOT header MATCHES "${but}")
        cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${ROOT} OUTPUT_VARIABLE name)
        list(APPEND violations "${name} includes ${header}: ${why}")
      endif()
    endforeach()
  endforeach()
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

# rule(FOLDER WHY REGEX): no file below FOLDER includes what matches.
function(rule folder why regex)
  list(TRANSFORM kinds PREPEND "${ROOT}/${folder}/" OUTPUT_VARIABLE patterns)
  file(GLOB_RECURSE sources ${patterns})
  look("${sources}" "${why}" "${regex}" "^$")
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

if(NOT EXISTS ${ROOT}/timeseries)
  message(FATAL_ERROR "layering: ${ROOT} is not the source tree")
endif()

set(gl "^(epoxy|GL|GLES|GLES2|GLES3|EGL|KHR|GLFW|openxr)/|(^|/)imgui")
rule(timeseries "timeseries is below all others" "^(datasets|render|xr|app|tests)/|^\\.\\./")
rule(timeseries "timeseries knows no graphics" "${gl}")
rule(datasets "datasets knows timeseries only" "^(render|xr|app|tests)/|^\\.\\./")
rule(datasets "datasets knows no graphics" "${gl}")
rule(render "render is below xr and app" "^(xr|app|tests)/|^\\.\\./")
rule(render "render knows no window" "^GLFW/")
rule(xr "xr is below app" "^(app|tests)/|^\\.\\./")
rule(xr "xr knows no window" "^GLFW/|(^|/)imgui")
rule(app "the program does not know its tests" "^tests/|^\\.\\./")
foreach(folder timeseries datasets xr app)
  rule(${folder} "only render includes epoxy" "^epoxy/")
endforeach()
foreach(folder timeseries datasets render app)
  rule(${folder} "only xr includes OpenXR" "^openxr/")
endforeach()

# rooms(FOLDER ROOM...): a room includes no later one; headers of the folder itself are for all.
macro(rooms folder)
  set(known ${ARGN})
  set(later ${ARGN})
  foreach(room ${ARGN})
    list(REMOVE_ITEM later ${room})
    list(JOIN later "|" names)
    if(later)
      rule(${folder}/${room} "${folder}/${room} comes before it" "^${folder}/(${names})/")
    endif()
  endforeach()
  list(TRANSFORM kinds PREPEND "${ROOT}/${folder}/*/" OUTPUT_VARIABLE patterns)
  file(GLOB entries RELATIVE ${ROOT}/${folder} ${patterns})
  foreach(entry ${entries})
    cmake_path(GET entry PARENT_PATH room)
    if(NOT room IN_LIST known)
      list(APPEND violations "${folder}/${entry}: the room ${room} has no place in this list")
    endif()
  endforeach()
endmacro()
rooms(timeseries grid index readers series ranks)
rooms(timeseries/readers text cf netcdf arrays xdmf vtk zarr foam amrex)
rooms(render image gl points model splat reference annotate frame)
rooms(app choices files picture measure exploration drawing panels desktop headset command)

# beside(FOLDER REGEX): headers that stand beside the rooms, which are for all of these, include of
# the project only each other and what matches.
function(beside folder regex)
  file(GLOB sources ${ROOT}/${folder}/*.h)
  look("${sources}" "it stands beside the rooms" "^(timeseries|datasets|render|xr|app|tests)/"
       "^${folder}/[^/]*$|${regex}")
  set(violations "${violations}" PARENT_SCOPE)
endfunction()
beside(timeseries "^$")
beside(render "^timeseries/[^/]*$")
beside(app "^timeseries/[^/]*$|^render/annotate/utf8\\.h$")
# Of readers, they are between the first room and the others.
beside(timeseries/readers "^timeseries/(grid|index|readers/text)/")
rule(timeseries/readers/text "it comes before what stands beside the rooms"
     "^timeseries/readers/[^/]*$")

# Where a point is, and what its cell is like, is PlacedPoints' alone; those that name axes ask for them, too.
file(GLOB_RECURSE sources ${ROOT}/render/*.h ${ROOT}/render/*.cpp)
list(FILTER sources EXCLUDE REGEX "/render/(points|annotate)/[^/]*$")
foreach(source ${sources})
  file(STRINGS ${source} lines REGEX "axes\\(\\)")
  if(lines)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${ROOT} OUTPUT_VARIABLE name)
    list(APPEND violations "${name} asks a grid for its axes: PlacedPoints tells where points are")
  endif()
endforeach()

if(violations)
  list(REMOVE_DUPLICATES violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "layering:\n  ${text}")
endif()
