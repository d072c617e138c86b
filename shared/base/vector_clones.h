// A hot loop compiled twice: for any x86-64, and for those with AVX2, chosen when the program starts. Wider
// vectors of the same operations: not a bit of any result changes (no fused multiply-add, -ffp-contract=off).
#pragma once

// Sanitizers cannot run the choice, which happens before they are set up; clang 14 takes no clones of
// functions in anonymous namespaces.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__OPTIMIZE__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SCREE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SCREE_VECTOR_CLONES
#endif
