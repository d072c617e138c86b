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

/// changes[i] is the mass that a voxel of that fill lost.
SCREE_VECTOR_CLONES
void write_filled_changes(size_t count, const Code* __restrict before, const Code* __restrict after,
                          const uint8_t* __restrict fills, uint8_t* __restrict changes) {
  for (size_t i = 0; i < count; ++i)
    changes[i] = static_cast<uint8_t>(mass_in_voxel(occupancy_byte(before[i]), fills[i]) -
                                      mass_in_voxel(occupancy_byte(after[i]), fills[i]));
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

std::vector<uint8_t> mass_changes(std::span<const Code> before, std::span<const Code> after,
                                  const FillWindow& fills) {
  if (fills.is_solid()) return mass_changes(before, after);
  CHECK_EQ(before.size(), after.size());
  std::vector<uint8_t> changes(before.size());
  const std::vector<uint8_t> all =
      fills.each.empty() ? std::vector<uint8_t>(before.size(), fills.all) : std::vector<uint8_t>();
  CHECK(all.size() + fills.each.size() == before.size());
  write_filled_changes(changes.size(), before.data(), after.data(),
                       all.empty() ? fills.each.data() : all.data(), changes.data());
  return changes;
}

MassUnits mass_of(const Window& window, const FillWindow& fills) {
  if (fills.is_solid()) return mass_of(window);
  MassUnits sum = 0;
  for (size_t i = 0; i < window.codes.size(); ++i)
    sum += mass_in_voxel(occupancy(window.codes[i]), fills.at(i));
  return sum;
}

}  // namespace scree
