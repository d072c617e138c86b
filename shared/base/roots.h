// Roots that are the same on every system; those of the math library may differ in their last bits.
#pragma once

#include <algorithm>

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

}  // namespace scree
