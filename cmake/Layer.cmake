# esi_add_layer(<name> SOURCES <.cpp>... [USES <layer>...] [PUBLIC <lib>...] [PRIVATE <lib>...])
#
# One static library per folder of lib/. Headers are included as "esi/<layer>/<file>.hpp", in the tree as
# after installation; a layer's include path holds only itself, and reaches others by naming them in USES.
# So an include that breaks the layering does not compile.
function(esi_add_layer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;PUBLIC;PRIVATE" ${ARGN})
  set(include_root ${CMAKE_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${include_root}/esi)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/esi/${name} SYMBOLIC)

  add_library(esi_${name} STATIC ${ARG_SOURCES})
  add_library(esi::${name} ALIAS esi_${name})
  set_target_properties(esi_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(esi_${name} PUBLIC cxx_std_20)
  target_include_directories(esi_${name} PUBLIC
    $<BUILD_INTERFACE:${include_root}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ARG_USES PREPEND esi::)
  target_link_libraries(esi_${name} PUBLIC ${ARG_USES} ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  list(LENGTH ARG_SOURCES sources)
  if(sources GREATER 12)
    esi_precompile(esi_${name})
  endif()
  set_property(GLOBAL APPEND PROPERTY ESI_LAYERS ${name})
endfunction()
