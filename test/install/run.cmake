# Installs the build into a fresh prefix and looks at what is there: a consumer's project that finds, builds
# against and runs the library, every installed header, the tool, its man page and its completion.
# Takes BUILD_DIR, SOURCE_DIR, WORK_DIR, GENERATOR, BUILD_TYPE, CXX_COMPILER, CXX_FLAGS.
set(prefix ${WORK_DIR}/prefix)
set(consumer ${WORK_DIR}/consumer)
file(REMOVE_RECURSE ${WORK_DIR})

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${status}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect text pattern what)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "${what}: expected ${pattern}, got:\n${text}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*.hpp)
expect("${headers}" "esi/core/event.hpp;.*esi/recon/methods.hpp" "installed headers")
list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>\n")
string(JOIN "" includes ${headers})
file(WRITE ${consumer}/all_headers.cpp "${includes}")

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${consumer} -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
  -DCMAKE_CXX_FLAGS=${CXX_FLAGS} -DCMAKE_FIND_USE_PACKAGE_REGISTRY=NO)
run(${CMAKE_COMMAND} --build ${consumer})
run(${consumer}/consumer ${SOURCE_DIR}/data-samples/flight-start/events.txt)
expect("${output}" "^128x96 at 199979 us, middle [0-9]+\n$" "the consumer")

run(${prefix}/bin/esi-recon --version)
expect("${output}" "[0-9]+\\.[0-9]+\\.[0-9]+" "--version")
run(${prefix}/bin/esi-sim --config ${prefix}/share/esi/configs/sim/flight-dim.json --print-config)
expect("${output}" "\"illuminance_lux\": 10" "an installed preset")
file(READ ${prefix}/share/man/man1/esi-sim.1 man)
expect("${man}" "illuminance" "the man page of esi-sim")
file(READ ${prefix}/share/man/man1/esi-recon.1 man)
expect("${man}" "\\.TH " "the man page")
expect("${man}" "fps" "the man page")
file(READ ${prefix}/share/bash-completion/completions/esi-recon completion)
expect("${completion}" "--fps" "the completion")
run(bash -n ${prefix}/share/bash-completion/completions/esi-recon)
foreach(file IN ITEMS LICENSE configs/recon)
  if(NOT EXISTS ${prefix}/share/esi/${file})
    message(FATAL_ERROR "share/esi/${file} is not installed")
  endif()
endforeach()
