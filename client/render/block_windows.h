// Copies out of the field what a worker needs to mesh a box of it.
#pragma once

#include <optional>

#include "shared/field/field.h"
#include "shared/field/surface_nets.h"

namespace scree {

struct BlockWindows {
  VoxelBox owned;
  Window now;
  std::optional<Window> before;  ///< as generated; absent where nothing was ever edited

  SurfaceMesh mesh() const { return surface_nets(now, owned, before ? &*before : nullptr); }
};

/// Nothing when all the bricks around are air, or all are rock.
std::optional<BlockWindows> gather_windows(Field& field, const VoxelBox& owned);

/// As gather(), of the field as it was generated.
Window gather_generated(Field& field, const VoxelBox& box);

}  // namespace scree
