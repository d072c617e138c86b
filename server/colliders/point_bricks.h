// The codes around a large body's points: copies of those bricks alone in which its points lie. All that lies
// within the bounds of a body of 30 m is millions of codes, of which its points read some hundreds. Voxels.
// Not thread-safe, but for has() and sample().
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/window.h"

namespace scree {

class PointBricks {
 public:
  /// `field` must outlive this object.
  explicit PointBricks(const Field& field) : field_(field) {}

  /// Whether the codes around p are there.
  bool has(glm::vec3 p) const;
  /// Copies the bricks around p that are not there. Reads the field, but for bricks that lie above all ground
  /// and were not edited: these are air, and are not generated.
  void add(glm::vec3 p);
  /// Like sample_covered() of a window with those codes. has(p) must hold.
  FieldSample sample(glm::vec3 p) const;
  /// Drops the copies if one overlaps this box, and if they are limits::point_bricks_max or more.
  void terrain_changed(const VoxelBox& box);
  void make_room();

 private:
  /// Calls f(brick) for each brick of the eight voxels around p; ends at the first that gives false.
  template <typename F>
  static bool for_bricks(glm::vec3 p, F&& f);
  int copy_of(BrickCoord coord) const;

  const Field& field_;
  std::unordered_map<BrickCoord, int, CoordHash> slots_;  ///< index of the copy, or `air`
  std::vector<Brick> copies_;
  VoxelBox held_;  ///< around all of `slots_`
};

/// Whether the brick lies so far above all ground that it holds only air as generated: a distance that the
/// solver of redistance.h carries from the ground does not get there.
bool is_above_ground(const TerrainSource& source, BrickCoord brick);

}  // namespace scree
