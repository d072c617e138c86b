// Bullet as it comes, a peer of our bodies: convex hulls on a triangle mesh of the terrain, its own
// broadphase, narrowphase, solver and sleeping, all at their defaults. Metres, kilograms; one thread.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/piece.h"

namespace scree::peers {

/// A piece of rock in flight. The hull's corners are relative to its centre of mass, in the pose's axes; at
/// least 4.
struct StockPiece {
  std::vector<glm::vec3> hull_m;
  float mass_kg = 0.0F;
  float friction = 0.0F;
  Pose pose;
  glm::vec3 velocity_m_s{0.0F};
  glm::vec3 spin_rad_s{0.0F};
};

class StockBullet {
 public:
  /// The ground is the field's surface in that box of voxels, which does not change any more.
  StockBullet(const Field& field, const VoxelBox& box);
  ~StockBullet();
  StockBullet(const StockBullet&) = delete;
  StockBullet& operator=(const StockBullet&) = delete;

  /// Makes the ground anew, as after a carve: the triangles, and Bullet's tree over them.
  void rebuild_ground(const Field& field, const VoxelBox& box);
  size_t triangles() const;

  void add(const StockPiece& piece);
  /// One step of 1/60 s.
  void step();
  /// Pieces that Bullet has not put to sleep.
  size_t awake() const;
  /// Pieces whose centres are lower than that.
  size_t below(float height_m) const;

  /// "3.24"
  static std::string version();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scree::peers
