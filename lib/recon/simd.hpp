#pragma once

// A function marked so is compiled for several processors, and the best that runs here is called. All give
// the same bytes: nothing is contracted or reordered (see cmake/Compiler.cmake). Not for AVX-512: rows
// shifted by a pixel cross a cache line at every load of 64 bytes, which costs more than wide sums gain.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ESI_SIMD __attribute__((target_clones("default", "avx2")))
#else
#define ESI_SIMD
#endif
