// Windows into a field: copies out of it and back.
#include <algorithm>
#include <cstring>

#include "shared/base/check.h"
#include "shared/field/field.h"

namespace scree {

namespace {

/// A row's codes, eight at most: calling memcpy took longer than the copy.
inline void copy_row(Code* to, const Code* from, size_t count) {
  if (count == brick_size) {
    std::memcpy(to, from, brick_size);
  } else if (count >= 4) {
    std::memcpy(to, from, 4);
    std::memcpy(to + count - 4, from + count - 4, 4);
  } else {
    for (size_t i = 0; i < count; ++i) to[i] = from[i];
  }
}

/// The part of a brick that lies in a box, as ranges relative to the brick.
struct Overlap {
  VoxelCoord lo;
  VoxelCoord hi;
};

Overlap overlap(BrickCoord brick, const VoxelBox& box) {
  const VoxelCoord first = first_voxel(brick);
  const auto low = [](int a, int b) { return std::max(a - b, 0); };
  const auto high = [](int a, int b) { return std::min(a - b, brick_size); };
  return {{low(box.lo.x, first.x), low(box.lo.y, first.y), low(box.lo.z, first.z)},
          {high(box.hi.x, first.x), high(box.hi.y, first.y), high(box.hi.z, first.z)}};
}

/// Calls f(offset in the brick, offset in the window, count) for each row along z.
template <typename F>
void for_each_row(BrickCoord brick, const Window& window, F&& f) {
  const Overlap part = overlap(brick, window.box);
  const VoxelCoord first = first_voxel(brick);
  const auto count = static_cast<size_t>(part.hi.z - part.lo.z);
  CHECK_DEBUG(count > 0 && count <= brick_size);
  const VoxelCoord size = window.box.size();
  const auto step_y = static_cast<size_t>(size.z), step_x = static_cast<size_t>(size.y) * step_y;
  size_t plane = window.index(first.x + part.lo.x, first.y + part.lo.y, first.z + part.lo.z);
  for (int x = part.lo.x; x < part.hi.x; ++x, plane += step_x) {
    size_t row = plane;
    for (int y = part.lo.y; y < part.hi.y; ++y, row += step_y)
      f(static_cast<size_t>(Brick::index(x, y, part.lo.z)), row, count);
  }
}

}  // namespace

Window gather(const Field& field, const VoxelBox& box) {
  CHECK(!box.empty());
  Window window(box);
  for_each_brick(box, [&](BrickCoord coord) {
    const Brick& brick = field.brick(coord);
    for_each_row(coord, window, [&](size_t from, size_t to, size_t count) {
      copy_row(window.codes.data() + to, brick.codes.data() + from, count);
    });
  });
  return window;
}

std::vector<BrickCoord> scatter(Field& field, const Window& window) {
  return scatter(field, window, nullptr);
}

std::vector<BrickCoord> scatter(Field& field, const Window& window,
                                const std::function<const BrickMaterials*(BrickCoord)>& said) {
  std::vector<BrickCoord> changed;
  CHECK_EQ(window.codes.size(), Window::count(window.box));
  for_each_brick(window.box, [&](BrickCoord coord) {
    const Brick& old = field.brick(coord);
    Brick brick = old;
    for_each_row(coord, window, [&](size_t to, size_t from, size_t count) {
      copy_row(brick.codes.data() + to, window.codes.data() + from, count);
    });
    const BrickMaterials* now = said == nullptr ? nullptr : said(coord);
    CHECK_DEBUG(now == nullptr || !(*now == field.materials(coord)));
    if (brick == old && now == nullptr) return;
    if (now != nullptr)
      field.set_brick(coord, brick, *now);
    else
      field.set_brick(coord, brick);
    changed.push_back(coord);
  });
  CHECK_DEBUG(std::ranges::is_sorted(changed));
  return changed;
}

}  // namespace scree
