// The simulation's choices between methods. They start as WorldConfig says and change by SettingsRequests;
// settings.h names each member. Part of the simulation: the same commands give the same hashes.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/colliders/terrain_collider_kind.h"
#include "server/fracture/simplify.h"
#include "shared/fracture/cutter.h"
#include "shared/recombine/stamp_method.h"

namespace scree {

/// How pieces at rest become terrain again: by a method of shared/recombine/stamp_method.h; `off`: they stay
/// bodies.
enum class Recombination : uint8_t { stamp = 0, slices = 1, sphere = 2, off = 3, facets = 4 };

struct RecombinationRow {
  std::string_view name;
  std::optional<StampMethod> method;  ///< none: pieces at rest freeze
};

constexpr RecombinationRow row_of(Recombination recombination) {
  constexpr auto by = [](StampMethod method) { return RecombinationRow{name_of(method), method}; };
  switch (recombination) {
    case Recombination::stamp:
      return by(StampMethod::stamp);
    case Recombination::slices:
      return by(StampMethod::slices);
    case Recombination::sphere:
      return by(StampMethod::sphere);
    case Recombination::off:
      return {.name = "off", .method = std::nullopt};
    case Recombination::facets:
      return by(StampMethod::facets);
  }
  return {};
}
static_assert(kind_count<Recombination> == kind_count<StampMethod> + 1);

/// Nothing: pieces at rest never become terrain.
constexpr std::optional<StampMethod> stamp_method_of(Recombination recombination) {
  return traits_of(recombination).method;
}
constexpr bool merges(Recombination recombination) {
  return stamp_method_of(recombination).has_value();
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
