// Marks a function to be compiled twice, for any x86-64 and for processors with AVX2; the program chooses at
// start. Wider vectors of the same operations: no bit of any result changes (-ffp-contract=off: no fused
// multiply-add).
#pragma once

// No clones under sanitizers: the choice runs before they are set up. None by clang: version 14 refuses
// clones of functions in anonymous namespaces.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__OPTIMIZE__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SCREE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#elif defined(__clang__)
#define SCREE_VECTOR_CLONES __attribute__((noinline))  // as a clone is
#else
#define SCREE_VECTOR_CLONES
#endif

/// Marks a function that a clone calls. It becomes part of the clone, so that it is compiled for the clone's
/// processor. Vectors are passed by reference: those calls would differ from one processor to the other.
#define SCREE_INLINE inline __attribute__((always_inline))

/// Marks a struct that holds vectors of 32 bytes. g++ aligns them to 16 where it compiles for any x86-64, but
/// the clone for AVX2 expects them at multiples of 32.
#define SCREE_CLONES_ALIGNMENT 32
