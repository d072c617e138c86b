#include "tools/import/solid.h"

namespace scree {

namespace {

int chunk_beyond(int voxel) {
  return ((voxel - 1) >> 5) + 1;
}

}  // namespace

Result<BrickLayout> layout_around(const VoxelBox& box, float voxel_size_m) {
  const BrickLayout layout{voxel_size_m,
                           chunk_of(box.lo),
                           {chunk_beyond(box.hi.x), chunk_beyond(box.hi.y), chunk_beyond(box.hi.z)}};
  if (Result<void> valid = validate(layout); !valid)
    return fail(valid.error().message + "; --scale makes it smaller, --at moves it");
  return layout;
}

size_t count_chunks(const VoxelBox& box) {
  if (box.empty()) return 0;
  const auto side = [](int lo, int hi) { return static_cast<size_t>(chunk_beyond(hi) - (lo >> 5)); };
  return side(box.lo.x, box.hi.x) * side(box.lo.y, box.hi.y) * side(box.lo.z, box.hi.z);
}

}  // namespace scree
