#include "shared/field/edit.h"

#include <algorithm>

namespace scree {

namespace {

/// codes[i] := combine(codes[i], code of the shape's distance) for every voxel of the window.
template <typename Combine>
void combine_with(Window& window, const Shape& shape, Combine&& combine) {
  const VoxelBox& box = window.box;
  size_t i = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z, ++i) {
        const glm::vec3 p(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        window.codes[i] = combine(window.codes[i], encode(distance(shape, p)));
      }
}

}  // namespace

void carve(Window& window, const Shape& shape_voxels) {
  combine_with(window, shape_voxels, [](Code c, Code s) { return std::max(c, static_cast<Code>(-s)); });
}

void fill(Window& window, const Shape& shape_voxels) {
  combine_with(window, shape_voxels, [](Code c, Code s) { return std::min(c, s); });
}

Window extract(const Window& window, const Shape& shape_voxels) {
  Window volume = window;
  combine_with(volume, shape_voxels, [](Code c, Code s) { return std::max(c, s); });
  return volume;
}

}  // namespace scree
