// Finds terrain that is connected to the ground but overloaded: a mass that weighs more than its thinnest
// necks can carry.
//
// The solid terrain around a change is divided into parts, the components inside each brick, each with a
// weight. Load flows between parts that touch; the capacity is that of the thinnest section between their
// middles: largest under pressure, smaller when the load hangs, smallest when it sticks out sideways. Parts
// that continue outside the surroundings, or touch the ground, are held. Where not all load can flow to held
// parts (load_flow.h), the least cut is the neck.
//
// A model of sections, not of leverage: a beam breaks at 25 m whatever its height. Only masses that the
// change touched, or whose neck it touched, are reported: terrain that stood before keeps standing.
// Deterministic; integers after the first conversion. Lengths in voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/field/field.h"

namespace scree {

/// The place where a mass breaks off: voxels to be crushed, two layers on each side of the thinnest section.
struct Neck {
  VoxelBox box;
  int64_t section_voxels = 0;  ///< area of that section, in faces of voxels

  bool operator==(const Neck&) const = default;
};

struct Overload {
  int64_t voxels = 0;  ///< of the mass beyond the necks, within the surroundings
  VoxelCoord start;    ///< one of these voxels
  std::vector<Neck> necks;
};

struct SupportFound {
  std::vector<Overload> overloads;  ///< ordered by their first parts
  size_t parts = 0;                 ///< parts of the search, a measure of its cost
  bool given_up = false;            ///< the terrain is too intricate for the limits; nothing is found
};

/// Searches the bounds of the changed bricks, grown by `reach_bricks` in every direction.
SupportFound find_overloads(Field& field, std::span<const BrickCoord> changed, int reach_bricks);

/// Voxels that a mass must have to break off: 4 of the smallest pieces. Less than this hangs on.
inline constexpr int64_t overload_voxels_min = 8;

/// Parts of one search: more than any solid ground has; 10 ms. Above, the search gives up.
inline constexpr size_t support_parts_max = 16384;

}  // namespace scree
