// OpenVDB's volumeToMesh, measured beside our meshes.
#pragma once

#include <cstddef>
#include <memory>

#include "shared/field/field.h"

namespace scree::peers {

class StockMesher {
 public:
  /// A level set with the field's distances in that box.
  StockMesher(const Field& field, const VoxelBox& box);
  ~StockMesher();

  /// Meshes all of it on this thread alone, without simplifying; the number of its quads.
  size_t mesh() const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace scree::peers
