// Roots that are the same on every system; those of the math library may differ in their last bits.
#pragma once

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

/// Newton's method. For numbers from 0 to 1e9, exact to a few units in the last place.
inline float cube_root(float x) {
  CHECK(x >= 0.0F && x <= 1e9F);
  if (x <= 0.0F) return 0.0F;
  float root = std::max(x, 1.0F);
  for (int i = 0; i < 64; ++i) root = (2.0F * root + x / (root * root)) / 3.0F;
  return root;
}

/// x to the power of an exponent within 0 … 1, whose first eight binary digits count: by square roots alone.
inline float power(float x, float exponent) {
  CHECK(x >= 0.0F && exponent >= 0.0F && exponent <= 1.0F);
  constexpr int digits = 8;
  const int binary = static_cast<int>(exponent * (1 << digits) + 0.5F);
  float result = binary == 1 << digits ? x : 1.0F;
  float root = x;
  for (int digit = digits - 1; digit >= 0; --digit) {
    root = std::sqrt(root);
    if (((binary >> digit) & 1) != 0) result *= root;
  }
  return result;
}

}  // namespace scree
