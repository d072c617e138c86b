// A plug that a blow punches out of thin terrain: the rock behind the rectangle that is struck, along the
// blow, up to the air. It shears along its sides. Lengths in voxels.
#pragma once

#include <optional>

#include "shared/falling/blow_search.h"
#include "shared/falling/support_network.h"

namespace scree {

struct Plug {
  Overload overload;     ///< its neck is the plug itself
  double newtons = 0.0;  ///< force at which it is punched out
};

/// Nothing where the terrain is thicker than plug_thickness_max, or too little rock would be punched out.
std::optional<Plug> find_plug(const Field& field, const Palette& palette, const BlowLoad& load,
                              LoadDirection direction);

/// Where terrain is thicker, a plug's sides bear more than sections farther away.
inline constexpr int plug_thickness_max = 12;
/// Longest side of a rectangle that is looked at: of a block of 16 m.
inline constexpr int plug_side_max = 64;

}  // namespace scree
