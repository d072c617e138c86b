// Things that are struck, and what strikes them: for the bench `blows`, and for tests. Metres.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "server/world/world.h"
#include "shared/field/shape.h"

namespace scree {

struct BlowScene {
  std::string name{};
  std::vector<Shape> target{};  ///< of rock, on flat rock
  Shape striker{};              ///< where the striker is when it sets out; of rock, clear of all else
  glm::vec3 direction{0.0F};    ///< unit
  std::vector<float> speeds_m_s{};
  std::vector<glm::vec3> places_m{};  ///< in the target: where rock stands or is gone
  uint32_t ticks = 0;                 ///< until what stands is counted
};

/// A roof of one voxel on four walls under a block; a pillar of half a metre, struck by 41 t; ten towers in a
/// row; a ball against a wall; a plate on four posts under a block. A block that falls has the speed of its
/// fall where it begins, a little above.
std::vector<BlowScene> blow_scenes();

struct BlowOutcome {
  double energy_j = 0.0;       ///< of the striker, when it set out
  int64_t first = 0;           ///< voxels of the target that are gone after the tick that broke terrain first
  size_t gone = 0;             ///< places
  int64_t voxels = 0;          ///< of the target's that are no terrain any more
  double energy_left_j = 0.0;  ///< of all that moves, after the tick that broke terrain first; 0: none did
  double worst_ms = 0.0;       ///< of the stage that blows are in
};

/// Plays it. Pieces do not merge meanwhile, so that they do not count as what stood. `rules`: by which the
/// world goes.
BlowOutcome strike(const BlowScene& scene, float speed_m_s, uint32_t rules);

}  // namespace scree
