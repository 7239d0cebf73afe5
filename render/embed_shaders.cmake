# Writes shader_sources.h: one string literal a shader, named after its file (splat.vert ->
# shaders::splat_vert).
function(embed_shaders output)
  set(text "// Made from render/shaders by render/embed_shaders.cmake.\n#pragma once\nnamespace render::shaders {\n")
  foreach(path ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
    get_filename_component(name ${path} NAME)
    string(REPLACE "." "_" name ${name})
    file(READ ${path} source)
    string(APPEND text "inline constexpr char ${name}[] = R\"glsl(${source})glsl\";\n")
  endforeach()
  string(APPEND text "}  // namespace render::shaders\n")
  file(CONFIGURE OUTPUT ${output} CONTENT "${text}" @ONLY)
endfunction()
