#include "shared/field/mass.h"

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/occupancy_byte.h"

namespace scree {

namespace {

/// Σ occupancy. No branch, so that it runs in vectors.
SCREE_VECTOR_CLONES
int sum_of(size_t count, const Code* __restrict codes) {
  int sum = 0;
  for (size_t i = 0; i < count; ++i) sum += occupancy_byte(codes[i]);
  return sum;
}

}  // namespace

MassUnits mass_of(const Code* codes, size_t count) {
  CHECK(count <= size_t{1} << 23U);
  return sum_of(count, codes);
}

}  // namespace scree
