# Checks the layers by the #include lines: timeseries <- render <- xr <- app, datasets beside render.
# cmake -DROOT=<source tree> -P layering.cmake
# Fails with every line that reaches where it may not.

# rule(FOLDER WHY REGEX): no file below FOLDER includes what matches.
set(violations "")
function(rule folder why regex)
  file(GLOB_RECURSE sources ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.hpp ${ROOT}/${folder}/*.cpp
       ${ROOT}/${folder}/*.c ${ROOT}/${folder}/*.inl)
  foreach(source ${sources})
    file(STRINGS ${source} includes REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]*).*" "\\1" header "${line}")
      if(header MATCHES "${regex}")
        cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${ROOT} OUTPUT_VARIABLE name)
        list(APPEND violations "${name} includes ${header}: ${why}")
      endif()
    endforeach()
  endforeach()
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

if(violations)
  list(REMOVE_DUPLICATES violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "layering:\n  ${text}")
endif()
