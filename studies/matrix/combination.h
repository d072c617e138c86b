// The combinations that the matrix compares: a choice of each kind of method.
#pragma once

#include <string>
#include <vector>

#include "server/world/world_config.h"
#include "shared/fracture/seed_pattern.h"

namespace scree {

/// All but the drawing: what a server does.
struct Simulated {
  Cutter cutter = Cutter::field;
  Simplifier simplifier = Simplifier::hull;
  TerrainColliderKind collider = TerrainColliderKind::field;
  Recombination recombine = Methods().recombine;
  SeedPattern pattern = SeedPattern::radial;

  bool operator==(const Simulated&) const = default;
};

/// "field hull field facets radial": in the order of the members.
std::string text_of(const Simulated& simulated);

constexpr bool is_compared(SeedPattern pattern) {
  return asks_no_points(pattern) && !is_cut_on(pattern);
}
/// The patterns that are compared. `authored` is no method, but points that somebody sends; the pieces of
/// `natural` are no cells of its seeds, so their error against these says nothing.
inline constexpr auto compared_patterns = kinds_that<SeedPattern, is_compared>;

/// Every one.
std::vector<Simulated> all_simulated();

/// The settings that stand for it; all else by default.
WorldConfig config_of(const Simulated& simulated, const TerrainSource& terrain);

/// `drawing`: a name of all_methods() (client/render/methods.h).
struct Combination {
  std::string drawing;
  Simulated simulated;
};

std::string text_of(const Combination& combination);

/// The combination of the paper's program (sections 2.2 to 2.4) but for the drawing, of which it has two:
/// slices of each cell's planes, hulls, a mesh of triangles under the bodies, spheres.
Simulated papers_program();

}  // namespace scree
