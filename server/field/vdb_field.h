// The authoritative field: edited bricks in an OpenVDB tree of int8 codes.
//
// One leaf is one brick. An edited brick that is all air or all rock is an active tile of one brick's size.
// Inactive voxels were never edited. Not thread-safe, not even for reading: look-ups go through one caching
// accessor.
#pragma once

#include <memory>

#include "shared/field/field.h"

namespace scree {

class VdbField final : public Field {
 public:
  explicit VdbField(const TerrainSource& source);
  ~VdbField() override;

  /// Memory of the tree, bytes.
  uint64_t memory_bytes() const;

 protected:
  const Brick* find_edited(BrickCoord coord) const override;
  void store_edited(BrickCoord coord, const Brick& brick) override;
  void erase_edited(BrickCoord coord) override;
  /// Gives the tree's region back when it is empty: 36 KB.
  void chunk_left(ChunkCoord chunk) override;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace scree
