// Finds terrain that is connected to the ground but overloaded: a mass that weighs more than its thinnest
// necks can carry.
//
// The solid terrain around a change is divided into parts, the components inside each brick, each with a
// weight. Load flows between parts that touch; the capacity is that of the thinnest section between their
// middles: largest under pressure, smaller when the load hangs, smallest when it sticks out sideways. Parts
// that continue outside the surroundings, or touch the ground, are held. Where not all load can flow to held
// parts (load_flow.h), the least cut is the neck.
//
// Where all load can flow, sections are looked at that break by leverage (leverage.h): a beam breaks at a
// length that grows with the square root of its height. Only masses that the change touched, or whose neck it
// touched, are reported: terrain that stood before keeps standing. Deterministic. Lengths in voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/falling/holding.h"
#include "shared/falling/overload.h"
#include "shared/field/field.h"
#include "shared/material/palette.h"

namespace scree {

struct SupportFound {
  std::vector<Overload> overloads;  ///< ordered by their first parts
  size_t parts = 0;                 ///< parts of the search, a measure of its cost
  bool given_up = false;            ///< the terrain is too intricate for the limits; nothing is found
};

/// Searches the bounds of the changed bricks, grown by `reach_bricks` in every direction. `holding`: what it
/// holds is held, as all that touches ground; null: nothing.
SupportFound find_overloads(Field& field, const Palette& palette, std::span<const BrickCoord> changed,
                            int reach_bricks, const Holding* holding = nullptr);

/// Parts of one search: more than any solid ground has; 10 ms. Above, the search gives up.
inline constexpr size_t support_parts_max = 16384;

}  // namespace scree
