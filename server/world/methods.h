// The simulation's choices between methods. They start as WorldConfig says and change by SettingsRequests;
// settings.h names each member. Part of the simulation: the same commands give the same hashes.
#pragma once

#include <cstdint>
#include <string_view>

#include "server/colliders/terrain_collider_kind.h"
#include "server/fracture/simplify.h"
#include "shared/fracture/voronoi.h"

namespace scree {

/// How pieces at rest become terrain again: by a method of shared/recombine/stamp_method.h; `off`: they stay
/// bodies.
enum class Recombination : uint8_t { stamp = 0, slices = 1, sphere = 2, off = 3, facets = 4 };

struct RecombinationRow {
  std::string_view name;
};

constexpr RecombinationRow row_of(Recombination recombination) {
  switch (recombination) {
    case Recombination::stamp:
      return {.name = "stamp"};
    case Recombination::slices:
      return {.name = "slices"};
    case Recombination::sphere:
      return {.name = "sphere"};
    case Recombination::off:
      return {.name = "off"};
    case Recombination::facets:
      return {.name = "facets"};
  }
  return {};
}

struct Methods {
  TerrainColliderKind collider = TerrainColliderKind::field;  ///< how bodies find the terrain
  bool impacts = true;                                        ///< hard contacts break pieces again
  bool dents = true;                                          ///< hard contacts dent soft ground
  bool islands = true;                              ///< terrain that is cut off from the ground falls
  bool support = false;                             ///< terrain that is too heavy for its neck breaks off
  Recombination recombine = Recombination::facets;  ///< how pieces at rest become terrain again
  bool group_merges = false;                        ///< pieces that rest together become terrain in one pass
  Cutter cutter = Cutter::field;                    ///< how breaking terrain is cut into pieces
  Simplifier simplifier = Simplifier::hull;         ///< which points of a piece collide

  bool operator==(const Methods&) const = default;
};

}  // namespace scree
