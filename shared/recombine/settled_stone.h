// Stones where pieces merged, and the rule that ends them. A piece that merges becomes voxels, which keep its
// mass but not its edges. So it is drawn as it lay, for the eye alone, until rock goes from there. Servers
// tell late joiners by the same rule (server/world/stone_keeper.h) by which viewers find it for themselves
// (client/render/scene/settled_stones.h). Pure functions; a StonePlaces is not thread-safe.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/piece.h"

namespace scree {

struct SettledStone {
  PieceId id = 0;
  std::shared_ptr<const Volume> volume;
  QuantisedPose pose;
  /// Bit i: point i of stone_points() was rock when the piece merged. 0: it merges now, and nobody has asked.
  uint32_t lies = 0;
};

/// Whether a piece lies elsewhere than where it was cut. Else it leaves no stone: it is a prediction that was
/// refused, or a body that was cut out and let go.
bool has_moved(const Volume& volume, const Pose& pose, float voxel_size_m);

/// Points in a piece where it lies, in voxels of a field: 24 at most.
using StonePoints = std::vector<glm::vec3>;
StonePoints stone_points(const Volume& volume, const Pose& pose, float voxel_size_m);

/// Which of the points are rock: bit i for point i. 0: so few that the piece has not merged there.
uint32_t points_in_rock(const StonePoints& points, const Field& field);
StonePoints chosen(const StonePoints& points, uint32_t bits);

/// Points of a piece's surface where it lies, likewise.
StonePoints surface_points(const Volume& volume, const Pose& pose, float voxel_size_m);

/// Whether all of the points are so deep in rock that nothing of the stone is to be seen, though it is drawn
/// in front of rock that is up to a voxel nearer.
bool is_buried(const StonePoints& surface, const Field& field);

/// Whether rock has gone from so many of the points that there is no stone any more. What is out of memory
/// counts as rock.
bool has_rock_gone(const StonePoints& points, const Field& field);

/// Where stones lie, to be found by the bricks that change.
class StonePlaces {
 public:
  /// A new one; `points` has one at least.
  void add(PieceId id, StonePoints points);
  void remove(PieceId id);
  /// The stones with points in these bricks, in order of id.
  std::vector<PieceId> touched(std::span<const BrickCoord> bricks) const;
  bool contains(PieceId id) const { return points_.contains(id); }
  const StonePoints& points(PieceId id) const { return points_.at(id); }
  void clear();

 private:
  std::unordered_map<PieceId, StonePoints> points_;
  std::unordered_map<BrickCoord, std::vector<PieceId>, CoordHash> in_brick_;
};

/// Takes out the stones that these changed bricks end, in order of id, and returns them.
std::vector<PieceId> end_stones(StonePlaces& places, std::span<const BrickCoord> changed, const Field& field);

}  // namespace scree
