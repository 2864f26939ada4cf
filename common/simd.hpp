// SPDX-License-Identifier: Apache-2.0
//
// For functions whose loops the compiler turns into SIMD: they are built twice, for every x86-64 PC and for those with
// AVX2, and the program's start chooses. What they call must be inlined into them, so mark it so.
#pragma once

// Sanitizers' runtimes are not ready when the choice is made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define TELEHUG_SIMD [[gnu::target_clones("avx2", "default")]]
#else
#define TELEHUG_SIMD
#endif
#define TELEHUG_INLINE [[gnu::always_inline]] inline
