// Deterministic random numbers: the same seed gives the same sequence on every build.
// Source: PCG-XSH-RR 64/32 (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient...").
#pragma once

#include <cstdint>

#include "shared/base/check.h"

namespace scree {

class Random {
 public:
  explicit Random(uint64_t random_seed) : state_(random_seed + increment) { next(); }

  uint32_t next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + increment;
    const auto mixed = static_cast<uint32_t>(((old >> 18U) ^ old) >> 27U);
    const auto rotation = static_cast<uint32_t>(old >> 59U);
    return (mixed >> rotation) | (mixed << ((32U - rotation) & 31U));
  }

  /// Uniform in [0, bound); bound > 0. The bias of at most bound / 2^32 is accepted.
  uint32_t below(uint32_t bound) {
    CHECK_DEBUG(bound > 0);
    return static_cast<uint32_t>((static_cast<uint64_t>(next()) * bound) >> 32U);
  }

  /// Uniform in [0, 1), a multiple of 2^-24.
  float unit() { return static_cast<float>(next() >> 8U) * (1.0F / 16777216.0F); }

 private:
  static constexpr uint64_t increment = 1442695040888963407ULL;
  uint64_t state_;
};

}  // namespace scree
