// Finds what a blow breaks off: the terrain around it that bears less than the force of the blow.
//
// The force grows until something gives way. That is the weakest of four, so what breaks does not depend on
// how much harder the blow is:
//
// - a plug, where thin terrain is punched out under the place that is struck (punch.h);
// - the least cut of a flow (support_network.h): pressed along the blow, hanging against it, sideways across;
// - the section that is bent most (leverage.h);
// - a span (spans.h).
//
// Weight counts where the blow goes down, and in bending. Terrain that its weight alone would break has stood
// so far: there the blow breaks what it would break of weightless terrain. What lies under the places that
// are struck moves as one, as what strikes them does. Where terrain continues beyond the surroundings it is
// held. Deterministic. Lengths in voxels.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "shared/falling/holding.h"
#include "shared/falling/overload.h"
#include "shared/field/field.h"
#include "shared/material/palette.h"

namespace scree {

struct BlowLoad {
  std::vector<VoxelCoord> on;  ///< rock that is struck; at least one
  glm::dvec3 at{0.0};          ///< their middle, by force
  glm::dvec3 newtons{0.0};     ///< not 0
};

struct BlowFound {
  std::optional<Overload> overload;  ///< what breaks off, if anything does
  double share = 1.0;                ///< of the force, at which it does
  bool given_up = false;             ///< the terrain is too intricate for the limits
  size_t parts = 0;                  ///< with the following, measures of the cost
  size_t span_bricks = 0, span_joints = 0, span_products = 0;
};

/// Whether rock behind the blow is so massive that nothing can break: neither it, nor a tower of such rock.
/// No search is needed then. The harder the blow, the more rock that takes.
bool surely_holds(const Field& field, const Palette& palette, const BlowLoad& load);

/// Searches the bounds of the struck bricks, grown by `reach_bricks` in every direction. `holding`: as of
/// find_overloads().
BlowFound find_break(Field& field, const Palette& palette, const BlowLoad& load, int reach_bricks,
                     const Holding* holding = nullptr);

}  // namespace scree
