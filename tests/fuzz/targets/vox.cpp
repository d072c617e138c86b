// A MagicaVoxel file.
//
// Holds: what cannot be placed has a reason. What is placed lies within reach, none of it without a voxel,
// and there are no more voxels than were counted; where copies overlap there are fewer.
#include <algorithm>

#include "shared/base/check.h"
#include "tests/fuzz/support/target.h"
#include "tools/import/vox/limits.h"
#include "tools/import/vox/vox_bricks.h"

namespace scree {
namespace {

/// A copy reaches a model's side beyond the place of its node.
constexpr int64_t far_bricks = (limits::vox_far_max + limits::vox_side_max) / 8 + 1;

bool is_near(BrickCoord coord) {
  for (const int64_t along : {coord.x, coord.y, coord.z})
    if (along < -far_bricks || along > far_bricks) return false;
  return true;
}

void check_vox(std::span<const uint8_t> bytes) {
  const Result<VoxScene> scene = parse_vox(bytes);
  if (!scene) {
    CHECK(!scene.error().message.empty());
    return;
  }
  const Result<VoxBricks> placed = placed_voxels(*scene);
  if (!placed) {
    CHECK(!placed.error().message.empty());
    return;
  }
  CHECK(placed->bricks.size() <= limits::vox_bricks_max);
  uint64_t voxels = 0;
  for (const auto& [coord, brick] : placed->bricks) {
    CHECK(is_near(coord));
    const auto own = static_cast<uint64_t>(brick.size() - std::ranges::count(brick, 0));
    CHECK(own > 0);
    voxels += own;
  }
  CHECK(voxels <= placed->voxels);
}

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scree::check_vox({data, size});
  return 0;
}
