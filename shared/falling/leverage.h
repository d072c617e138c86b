// Finds the plane sections of terrain that break by leverage: the weight beyond a section, times its
// distance, bends it. A section is the set of links (support_parts.h) that cross one plane between bricks and
// alone hold what lies beyond; its exact place is the worst within those bricks.
//
// The tension at the section's edge is that of a beam in pure bending (Navier): for one of rectangular
// section under its own weight 3 ρ g L² / h, with the length L and the height h. Sections across, which carry
// a mass that stands or hangs off its middle, bear its weight besides. Left out: torsion, and masses held at
// several places, which are no levers. Besides weight, the force of a blow bends what it falls on, in any
// direction (blow_search.h). Lengths in voxels.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <vector>

#include "shared/falling/overload.h"
#include "shared/falling/support_parts.h"
#include "shared/field/field.h"

namespace scree {

/// Masses that break off by leverage: the worst section of each, the worst first, none inside another. Only
/// those with a changed brick among them or at their section. `field` is that of the parts.
std::vector<Overload> find_levers(const SupportParts& parts, Field& field, const Palette& palette,
                                  const std::set<BrickCoord>& changed);

/// A force at a place, and the parts on which it falls: none twice.
struct PointForce {
  glm::dvec3 at{0.0};
  glm::dvec3 newtons{0.0};
  std::vector<uint32_t> parts;
};

struct ForcedLever {
  Overload overload;
  double share = 1.0;  ///< part of the force at which it breaks
};

/// The section that breaks first while the force grows, of those beyond which lies all that it falls on.
/// Nothing where the whole force breaks none.
std::optional<ForcedLever> find_lever(const SupportParts& parts, Field& field, const Palette& palette,
                                      const PointForce& force);

}  // namespace scree
