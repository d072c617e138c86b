// What an edit costs in a world: a blow, the merges of its pieces, and a post that is cut loose and falls.
// The same places in the same order for every world, so that worlds that are alike there do the same work.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "server/world/world.h"
#include "studies/scale/axis.h"

namespace scree {

/// By the clock on the simulation's thread, milliseconds.
struct ProbeTimes {
  double carve = 0.0;    ///< the blow's stages: carve, cut, hulls and bodies
  double merge = 0.0;    ///< recombination of all its pieces
  double islands = 0.0;  ///< the search and the fall of the post that was cut
  double tick = 0.0;     ///< a tick while the blow's pieces are alive, the mean
  double idle = 0.0;     ///< a tick when all lies still, the median
};

/// Counts of events, to be compared with other worlds.
struct ProbeCounts {
  size_t pieces = 0;
  size_t merged = 0;
  size_t fell = 0;  ///< islands

  bool operator==(const ProbeCounts&) const = default;
};

/// Whether the numbers are within 5 %. Merges take up dust, of which a world that was carved more has more:
/// what is left of a crater may differ, and so may the pieces of a later blow beside it.
bool alike(const ProbeCounts& a, const ProbeCounts& b);

/// "64 pieces, 60 merged, 1 islands".
std::string text_of(const ProbeCounts& counts);

/// Adds a round to the axis's curves "carve", "merge", "islands", "tick with pieces" and "idle tick".
void add(Axis& axis, double size, const ProbeTimes& times);

class GroundProbe {
 public:
  /// Blows strike within 12 m of the place, and posts stand within 32 m of it. The ground there is generated
  /// here.
  GroundProbe(World& world, float x_m, float z_m);

  /// A blow and a fall, at the next places; returns when nothing is alive any more, or after ten seconds of
  /// the world.
  ProbeTimes round();
  const ProbeCounts& counts() const { return counts_; }
  uint32_t rounds() const { return rounds_; }

 private:
  void blow(ProbeTimes& times);
  void fall(ProbeTimes& times);
  void settle(ProbeTimes& times);
  void count(const TickDelta& delta);

  World& world_;
  float x_m_, z_m_;
  uint32_t rounds_ = 0;
  uint32_t requests_ = 0;
  ProbeCounts counts_;
};

/// A check of the axis, that every probe found as much to do as the first, and that a post fell in every
/// round.
void check_alike(Axis& axis, std::span<const GroundProbe> probes);

}  // namespace scree
