#include "server/colliders/point_bricks.h"

#include <algorithm>

#include "server/colliders/limits.h"
#include "server/colliders/nearby_codes.h"
#include "shared/base/check.h"
#include "shared/field/window_sample.h"

namespace scree {

namespace {

constexpr int air = -1;  ///< a slot without a copy

VoxelBox box_of_brick(BrickCoord brick) {
  const VoxelCoord first = first_voxel(brick);
  return {first, first + VoxelCoord{brick_size, brick_size, brick_size}};
}

VoxelBox around(const VoxelBox& a, const VoxelBox& b) {
  if (a.empty()) return b;
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

VoxelCoord voxel_below(glm::vec3 p) {
  return {floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
}

}  // namespace

template <typename F>
bool PointBricks::for_bricks(glm::vec3 p, F&& f) {
  const VoxelCoord voxel = voxel_below(p);
  const BrickCoord lo = brick_of(voxel), hi = brick_of(voxel + VoxelCoord{1, 1, 1});
  for (int x = lo.x; x <= hi.x; ++x)
    for (int y = lo.y; y <= hi.y; ++y)
      for (int z = lo.z; z <= hi.z; ++z)
        if (!f(BrickCoord{x, y, z})) return false;
  return true;
}

bool PointBricks::has(glm::vec3 p) const {
  return for_bricks(p, [&](BrickCoord brick) { return slots_.contains(brick); });
}

void PointBricks::add(glm::vec3 p) {
  for_bricks(p, [&](BrickCoord coord) {
    const auto [slot, is_new] = slots_.try_emplace(coord, air);
    if (!is_new) return true;
    held_ = around(held_, box_of_brick(coord));
    if (is_above_ground(field_.source(), coord) && !field_.is_edited(coord)) return true;
    const Brick& brick = field_.brick(coord);
    if (uniform_equivalent(brick) == &air_brick()) return true;
    slot->second = static_cast<int>(copies_.size());
    copies_.push_back(brick);
    return true;
  });
}

int PointBricks::copy_of(BrickCoord coord) const {
  const auto found = slots_.find(coord);
  CHECK_DEBUG(found != slots_.end());
  return found->second;
}

FieldSample PointBricks::sample(glm::vec3 p) const {
  const VoxelCoord voxel = voxel_below(p);
  if (for_bricks(p, [&](BrickCoord coord) { return copy_of(coord) == air; }))
    return {band_voxels, glm::vec3(0.0F)};
  thread_local Window around_p(VoxelBox{{0, 0, 0}, {2, 2, 2}});
  around_p.box = {voxel, voxel + VoxelCoord{2, 2, 2}};
  size_t i = 0;
  for (int x = voxel.x; x < voxel.x + 2; ++x)
    for (int y = voxel.y; y < voxel.y + 2; ++y)
      for (int z = voxel.z; z < voxel.z + 2; ++z, ++i) {
        const int copy = copy_of(brick_of(VoxelCoord{x, y, z}));
        around_p.codes[i] = copy == air ? code_air
                                        : copies_[static_cast<size_t>(copy)]
                                              .codes[static_cast<size_t>(Brick::index(x & 7, y & 7, z & 7))];
      }
  return sample_covered(around_p, p);
}

void PointBricks::terrain_changed(const VoxelBox& box) {
  if (!overlap(box, held_)) return;
  const bool is_of =
      std::ranges::any_of(slots_, [&](const auto& slot) { return overlap(box, box_of_brick(slot.first)); });
  if (!is_of) return;
  slots_.clear();
  copies_.clear();
  held_ = VoxelBox();
}

void PointBricks::make_room() {
  if (slots_.size() < limits::point_bricks_max) return;
  slots_.clear();
  copies_.clear();
  held_ = VoxelBox();
}

bool is_above_ground(const TerrainSource& source, BrickCoord brick) {
  const float least_m = static_cast<float>(first_voxel(brick).y - limits::above_ground_voxels);
  return least_m * source.voxel_size_m > top_m(source);
}

}  // namespace scree
