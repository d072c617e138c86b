// How far pieces travel through rock, measured from outside, for tests and benches.
#pragma once

#include <map>
#include <memory>

#include "server/world/world.h"

namespace scree {

/// Follows every piece and adds up how far each has moved while nine tenths of its voxels were deeper than
/// one voxel in rock.
class Travels {
 public:
  /// After every step of the world.
  void observe(World& world, const TickDelta& delta);
  float farthest_m() const { return farthest_m_; }
  /// Pieces that went farther than a metre so.
  size_t travellers() const;

 private:
  struct Track {
    glm::vec3 last_m{0.0F};
    float buried_m = 0.0F;
    float most_m = 0.0F;
  };

  void follow(World& world, const PieceState& piece);

  std::map<PieceId, std::shared_ptr<const Volume>> volumes_;
  std::map<PieceId, Track> tracks_;
  float farthest_m_ = 0.0F;
};

}  // namespace scree
