// A dense box of codes: gathered from a field for a kernel to work on, or a piece's own field. A value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "shared/base/check.h"
#include "shared/field/brick.h"

namespace scree {

/// Codes of the voxels in `box`, z fastest: index = ((x − lo.x) · size.y + (y − lo.y)) · size.z + (z − lo.z).
struct Window {
  VoxelBox box;
  std::vector<Code> codes;

  Window() = default;
  explicit Window(const VoxelBox& b, Code fill = code_air) : box(b), codes(count(b), fill) {}

  static size_t count(const VoxelBox& b) {
    const VoxelCoord s = b.size();
    return b.empty() ? 0 : static_cast<size_t>(s.x) * static_cast<size_t>(s.y) * static_cast<size_t>(s.z);
  }
  size_t index(int x, int y, int z) const {
    CHECK_DEBUG(box.holds({x, y, z}));
    const VoxelCoord s = box.size();
    return (static_cast<size_t>(x - box.lo.x) * static_cast<size_t>(s.y) +
            static_cast<size_t>(y - box.lo.y)) *
               static_cast<size_t>(s.z) +
           static_cast<size_t>(z - box.lo.z);
  }
  Code& at(int x, int y, int z) { return codes[index(x, y, z)]; }
  Code at(int x, int y, int z) const { return codes[index(x, y, z)]; }
};

/// The codes of a box that lies in the window.
inline Window part_of(const Window& window, const VoxelBox& box) {
  CHECK(window.box.covers(box));
  Window part(box);
  const auto count = static_cast<size_t>(box.hi.z - box.lo.z);
  Code* to = part.codes.data();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y, to += count)
      std::copy_n(window.codes.data() + window.index(x, y, box.lo.z), count, to);
  return part;
}

/// Writes a part back; its box must lie in the window.
inline void put(const Window& part, Window& window) {
  const VoxelBox& box = part.box;
  CHECK(window.box.covers(box) && part.codes.size() == Window::count(box));
  const auto count = static_cast<size_t>(box.hi.z - box.lo.z);
  const Code* from = part.codes.data();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y, from += count)
      std::copy_n(from, count, window.codes.data() + window.index(x, y, box.lo.z));
}

}  // namespace scree
