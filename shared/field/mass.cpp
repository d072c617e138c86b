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

SCREE_VECTOR_CLONES
void write_changes(size_t count, const Code* __restrict before, const Code* __restrict after,
                   uint8_t* __restrict changes) {
  for (size_t i = 0; i < count; ++i)
    changes[i] = static_cast<uint8_t>(occupancy_byte(before[i]) - occupancy_byte(after[i]));
}

}  // namespace

MassUnits mass_of(const Code* codes, size_t count) {
  CHECK(count <= size_t{1} << 23U);
  return sum_of(count, codes);
}

std::vector<uint8_t> mass_changes(std::span<const Code> before, std::span<const Code> after) {
  CHECK_EQ(before.size(), after.size());
  std::vector<uint8_t> changes(before.size());
  write_changes(changes.size(), before.data(), after.data(), changes.data());
  return changes;
}

}  // namespace scree
