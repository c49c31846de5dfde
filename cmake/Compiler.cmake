# Language level, warnings, sanitizers and launcher, for every target of the project.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  # Paths relative to the checkout: a second checkout of the same code finds the first one's objects.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    ${CCACHE})
endif()

# What most files include is parsed once for all files of a large target, which makes a cold build faster. Not with
# ccache, which does not go with it.
function(esi_precompile target)
  if(NOT CCACHE)
    target_precompile_headers(${target} PRIVATE <algorithm> <cmath> <cstdint> <filesystem> <functional> <memory>
      <optional> <span> <string> <vector> <fmt/format.h> <opencv2/core.hpp> ${ARGN})
  endif()
endfunction()

# No contraction to fused multiply-add: the same bytes come out whatever the CPU can do.
add_compile_options(-Wall -Wextra -Wconversion -Wshadow -Wpedantic -ffp-contract=off)
# g++ 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105329).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict)
endif()
# OpenCV's video libraries bring a hundred others: programs load what they call.
add_link_options(-Wl,--as-needed)
if(ESI_WERROR)
  add_compile_options(-Werror)
endif()
if(ESI_SANITIZE)
  add_compile_options(-fsanitize=${ESI_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${ESI_SANITIZE})
endif()
if(ESI_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "ESI_FUZZ needs clang++ (libFuzzer): use the preset fuzz")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
