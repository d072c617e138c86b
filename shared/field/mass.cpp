#include "shared/field/mass.h"

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {

namespace {

/// Σ occupancy of bytes, modulo 256: on the ramp that is all that there is. No branch, so that it runs in
/// vectors.
SCREE_VECTOR_CLONES
int sum_of(size_t count, const Code* __restrict codes) {
  constexpr int ramp_end = 21;
  int sum = 0;
  for (size_t i = 0; i < count; ++i) {
    const int8_t code = codes[i];
    const auto ramp = static_cast<uint8_t>(127 - 6 * code);
    const auto below = static_cast<uint8_t>(code < -ramp_end ? units_per_voxel : ramp);
    sum += static_cast<uint8_t>(code > ramp_end ? 0 : below);
  }
  return sum;
}

}  // namespace

MassUnits mass_of(const Code* codes, size_t count) {
  CHECK(count <= size_t{1} << 23U);
  return sum_of(count, codes);
}

}  // namespace scree
