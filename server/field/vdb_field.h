// The authoritative field: edited bricks in an OpenVDB tree of int8 codes.
//
// One leaf is one brick. Edited bricks that are all air or all rock are active tiles, one brick in size;
// everything inactive was never edited. Not thread-safe, reading included: look-ups go through one caching
// accessor.
#pragma once

#include <memory>

#include "shared/field/field.h"

namespace scree {

class VdbField final : public Field {
 public:
  explicit VdbField(const TerrainSource& source);
  ~VdbField() override;

  /// Bytes that the tree takes.
  uint64_t memory_bytes() const;

 protected:
  const Brick* find_edited(BrickCoord coord) const override;
  void store_edited(BrickCoord coord, const Brick& brick) override;
  void erase_edited(BrickCoord coord) override;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace scree
