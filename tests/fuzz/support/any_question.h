// Questions about space derived from a fuzzer's bytes, mostly of what any_request.h changes. Metres.
#pragma once

#include "shared/query/question.h"
#include "tests/fuzz/support/any_request.h"

namespace scree {

/// A direction mostly of length 1.
inline glm::vec3 any_direction(FuzzInput& input) {
  const uint32_t axis = input.below(4);
  if (axis == 3) return input.place(1.0F);
  glm::vec3 unit(0.0F);
  unit[static_cast<int>(axis)] = input.flag() ? 1.0F : -1.0F;
  return unit;
}

inline AskedFor any_asked(FuzzInput& input) {
  const glm::vec3 a = any_place(input);
  const float size_m = input.coordinate(8.0F);
  switch (input.below(9)) {
    case 0:
      return SphereQuestion{a, any_direction(input), 4.0F * size_m, 0.5F};
    case 1:
      return CapsuleQuestion{a, any_place(input), any_direction(input), size_m, 0.5F};
    case 2:
      return InSphereQuestion{a, size_m};
    case 3:
      return InBoxQuestion{a, a + size_m};
    case 4:
      return NearestQuestion{a, size_m};
    case 5:
      return SolidQuestion{a};
    case 6:
      return ContentQuestion{a, a + size_m};
    case 7:
      return BodiesQuestion{a - size_m, a + size_m};
    default:
      return RayQuestion{a, any_direction(input), 8.0F * size_m};
  }
}

}  // namespace scree
