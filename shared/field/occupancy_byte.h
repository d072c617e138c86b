// A voxel's mass from its code in bytes alone, so that loops over codes run in vectors of bytes.
#pragma once

#include <algorithm>

#include "shared/base/check.h"
#include "shared/field/mass.h"

namespace scree {

/// occupancy() in bytes. The ends of the ramp are added as 0 or 1, because a conditional expression compiles
/// to branches here, which stop vectorisation.
inline uint8_t occupancy_byte(Code code) {
  constexpr Code ramp_end = 21;
  const Code on_ramp = std::clamp<Code>(code, -ramp_end, ramp_end);
  const auto ramp = static_cast<uint8_t>(127 - 6 * on_ramp);
  const auto inside = static_cast<uint8_t>(code < -ramp_end ? 1 : 0);
  const auto outside = static_cast<uint8_t>(code > ramp_end ? 1 : 0);
  const auto units = static_cast<uint8_t>(ramp + inside - outside);
  CHECK_DEBUG(units == occupancy(code));
  return units;
}

}  // namespace scree
