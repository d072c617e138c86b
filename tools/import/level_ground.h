// Elevation models that imports stand bricks on: level rock, and the heights of a ground without its bricks.
#pragma once

#include "shared/field/stored_chunks.h"

namespace scree {

class LevelGround final : public GroundModel {
 public:
  /// `height`: in 1/256 m. `cell_m`: half of it is what the ground covers to each side, at least.
  LevelGround(int32_t height, float cell_m, const MaterialHeights& layers)
      : GroundModel({2, 2, cell_m, height, height, layers}), tile_(std::make_shared<HeightTile>()) {
    tile_->heights.fill(height);
  }
  std::shared_ptr<const HeightTile> tile(TileKey) const override { return tile_; }
  std::vector<uint8_t> packed(TileKey) const override { return {}; }

 private:
  std::shared_ptr<HeightTile> tile_;
};

class BareGround final : public GroundModel {
 public:
  explicit BareGround(std::shared_ptr<const GroundModel> ground)
      : GroundModel(ground->layout()), ground_(std::move(ground)) {}
  std::shared_ptr<const HeightTile> tile(TileKey key) const override { return ground_->tile(key); }
  std::vector<uint8_t> packed(TileKey key) const override { return ground_->packed(key); }

 private:
  std::shared_ptr<const GroundModel> ground_;
};

}  // namespace scree
