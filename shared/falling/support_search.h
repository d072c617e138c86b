// Finds terrain that is connected to the ground and yet hangs too heavy: a mass whose weight is more than its
// thinnest necks can carry.
//
// Looks at what is solid around a change, brick by brick: in each brick, what connects is a part with a
// weight. Between parts that touch, load flows as far as the thinnest section from one's middle to the
// other's carries it: most when it presses down, less when it hangs, least when it sticks out sideways. What
// leaves the surroundings, or reaches ground, is held. Where not all load can flow to what is held
// (load_flow.h), the least cut is the neck: of all masses that there are, none weighs more over what holds
// it.
//
// A model of sections, not of leverage: a beam breaks at 25 m whatever its height. Only masses that the
// change touched, or whose neck it touched, count: what stood before stands on. Deterministic; integers
// after the first conversion. Lengths in voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/field/field.h"

namespace scree {

/// Pressure that a section carries, Pa, by how the load lies on it.
struct Bearing {
  float pressed_pa = 0.0F;
  float hanging_pa = 0.0F;
  float sideways_pa = 0.0F;
};
Bearing bearing_of(Material material);

/// Where a mass breaks off: voxels to be crushed, two layers on each side of the thinnest section.
struct Neck {
  VoxelBox box;
  int64_t section_voxels = 0;  ///< area of that section, in faces of voxels

  bool operator==(const Neck&) const = default;
};

struct Overload {
  int64_t voxels = 0;  ///< of the mass beyond the necks, as far as it was looked at
  VoxelCoord start;    ///< one of them
  std::vector<Neck> necks;
};

struct SupportFound {
  std::vector<Overload> overloads;  ///< ordered by their first parts
  size_t parts = 0;                 ///< looked at; what the search cost
  bool given_up = false;            ///< over the limit: too intricate; nothing is found
};

/// Around these bricks, as many farther in every direction as `reach_bricks` says.
SupportFound find_overloads(Field& field, std::span<const BrickCoord> changed, int reach_bricks);

/// Voxels that a mass must have to break off: 4 of the smallest pieces. Less than this hangs on.
inline constexpr int64_t overload_voxels_min = 8;

/// Parts that one search looks at: more than there are in any solid ground, 10 ms. Above: given up.
inline constexpr size_t support_parts_max = 16384;

}  // namespace scree
