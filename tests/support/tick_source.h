// A world without physics, for tests of its consumers: makes ticks by applying operations to a plain field.
// Pieces stay where the test puts them.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "server/world/applied_operation.h"
#include "server/world/tick_delta.h"

namespace scree {

class TickSource {
 public:
  explicit TickSource(const TerrainSource& terrain) : field_(terrain) {}

  /// Applies the operations as the next tick.
  std::shared_ptr<const TickDelta> step(const std::vector<Operation>& operations = {}) {
    auto delta = std::make_shared<TickDelta>();
    delta->tick = ++tick_;
    std::map<BrickCoord, bool> changed;
    for (const Operation& operation : operations) {
      const VoxelBox reads = read_box(operation, pieces_, field_.source().voxel_size_m);
      const Applied applied = scree::apply(operation, field_, pieces_);
      delta->operations.push_back(describe(operation, reads, applied));
      for (const BrickCoord brick : applied.changed) changed[brick] = true;
      for (const CreatedPiece& piece : applied.created) add_piece(piece.id, *delta);
    }
    for (const auto& [coord, yes] : changed) delta->bricks.push_back(state_of(coord));
    for (const auto& [id, volume] : pieces_) delta->pieces.push_back({id, poses_.at(id)});
    delta->field_hash = field_.hash();
    delta->state_hash = field_.hash() + tick_;
    return delta;
  }

  /// The world as it stands, as World::keyframe() tells it.
  TickDelta keyframe() const {
    TickDelta delta;
    delta.tick = tick_;
    for (const ChunkCoord chunk : field_.edited_chunks())
      for (const BrickCoord coord : field_.edited_bricks(chunk)) delta.bricks.push_back(state_of(coord));
    std::ranges::sort(delta.bricks, {}, &BrickState::coord);
    for (const auto& [id, volume] : pieces_) {
      delta.spawned.push_back({id, volume});
      delta.pieces.push_back({id, poses_.at(id)});
    }
    delta.field_hash = field_.hash();
    delta.state_hash = field_.hash() + tick_;
    return delta;
  }

  /// A carve whose pieces get the next ids.
  CarveOperation carve(glm::vec3 centre_m, float radius_m, uint32_t seeds) {
    CarveOperation operation;
    operation.shape = sphere(centre_m, radius_m);
    operation.seeds = seeds;
    operation.random_seed = static_cast<uint32_t>(tick_) + 7;
    operation.impact_m = centre_m;
    operation.first_piece = next_piece_;
    next_piece_ += seeds;
    return operation;
  }
  StampOperation stamp(PieceId piece) const { return {piece, poses_.at(piece), 0}; }
  void move(PieceId piece, glm::vec3 by_m) {
    Pose pose = dequantise(poses_.at(piece));
    pose.position_m += by_m;
    poses_[piece] = quantise(pose);
  }

  MapField& field() { return field_; }
  const PieceTable& pieces() const { return pieces_; }
  Tick tick() const { return tick_; }

 private:
  BrickState state_of(BrickCoord coord) const {
    const auto brick = std::make_shared<const Brick>(field_.brick(coord));
    const BrickMaterials materials = field_.materials(coord);
    return {coord, brick, brick_hash(coord, *brick, materials), materials};
  }
  void add_piece(PieceId id, TickDelta& delta) {
    const auto volume = pieces_.at(id);
    const glm::vec3 centre_m = volume->centre_voxels * field_.source().voxel_size_m;
    poses_[id] = quantise({centre_m, {1.0F, 0.0F, 0.0F, 0.0F}});
    delta.spawned.push_back({id, volume});
  }

  MapField field_;
  PieceTable pieces_;
  std::map<PieceId, QuantisedPose> poses_;
  Tick tick_ = 0;
  PieceId next_piece_ = 1;
};

}  // namespace scree
