# cmake --install: tools with man pages and completion, libraries with headers and find_package(esi), configs.
include(CMakePackageConfigHelpers)

set(ESI_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/esi)
set(ESI_DATA_DIR ${CMAKE_INSTALL_DATADIR}/esi)

# All that cmake --install needs: the build without the tests.
add_custom_target(tools)

# The headers of a layer that its users include. Of io that is the way in and out: how a format is read or written
# is its own business. The test in test/install includes them all, so that one that is missing here is noticed.
function(esi_install_headers layer)
  set(source ${PROJECT_SOURCE_DIR}/lib/${layer})
  set(target ${CMAKE_INSTALL_INCLUDEDIR}/esi/${layer})
  file(GLOB headers CONFIGURE_DEPENDS ${source}/*.hpp)
  install(FILES ${headers} DESTINATION ${target})
  if(layer STREQUAL io)
    install(FILES ${source}/output/file_descriptor.hpp ${source}/output/frame_sink.hpp
      ${source}/output/journal_file.hpp ${source}/output/run_manifest.hpp DESTINATION ${target}/output)
  endif()
  foreach(part IN ITEMS recon/flow recon/steps pipeline/evaluation)
    if(part MATCHES "^${layer}/(.*)$")
      file(GLOB headers CONFIGURE_DEPENDS ${source}/${CMAKE_MATCH_1}/*.hpp)
      install(FILES ${headers} DESTINATION ${target}/${CMAKE_MATCH_1})
    endif()
  endforeach()
endfunction()

# A file that the tool itself prints, from the same option tables as --help.
function(esi_install_printed tool flag file destination)
  set(output ${PROJECT_BINARY_DIR}/${destination}/${file})
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DTOOL=$<TARGET_FILE:${tool}> -DFLAG=${flag} -DOUTPUT=${output}
      -P ${PROJECT_SOURCE_DIR}/cmake/PrintToFile.cmake
    DEPENDS ${tool} ${PROJECT_SOURCE_DIR}/cmake/PrintToFile.cmake
    VERBATIM)
  add_custom_target(${tool}${flag} ALL DEPENDS ${output})
  add_dependencies(tools ${tool}${flag})
  install(FILES ${output} DESTINATION ${destination})
endfunction()

function(esi_install_tool tool)
  install(TARGETS ${tool})
  esi_install_printed(${tool} --generate-man ${tool}.1 ${CMAKE_INSTALL_MANDIR}/man1)
  esi_install_printed(${tool} --generate-completion ${tool}
    ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endfunction()

foreach(tool IN ITEMS esi-recon esi-sim esi-eval esi-sweep)
  if(TARGET ${tool})
    esi_install_tool(${tool})
  endif()
endforeach()

get_property(layers GLOBAL PROPERTY ESI_LAYERS)
foreach(layer IN LISTS layers)
  add_dependencies(tools esi_${layer})
  install(TARGETS esi_${layer} EXPORT esiTargets)
  esi_install_headers(${layer})
endforeach()

install(EXPORT esiTargets NAMESPACE esi:: DESTINATION ${ESI_CMAKE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/esiConfig.cmake.in ${PROJECT_BINARY_DIR}/esiConfig.cmake
  INSTALL_DESTINATION ${ESI_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/esiConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/esiConfig.cmake ${PROJECT_BINARY_DIR}/esiConfigVersion.cmake
  DESTINATION ${ESI_CMAKE_DIR})

install(DIRECTORY configs DESTINATION ${ESI_DATA_DIR})
install(FILES LICENSE DESTINATION ${ESI_DATA_DIR})
