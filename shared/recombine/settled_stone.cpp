#include "shared/recombine/settled_stone.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "shared/base/check.h"
#include "shared/field/voxel_vector.h"

namespace scree {

namespace {

/// Points that tell whether a stone still lies in rock: a bit each in SettledStone::lies.
constexpr size_t stone_points_max = 24;
/// Voxels at least so deep in a piece are asked, in codes: a quarter of a voxel.
constexpr Code deep_in_stone = -10;
/// And voxels so near the surface: half a voxel.
constexpr Code on_surface = 21;
/// So deep below the terrain's surface is nothing of a stone to be seen: 1.2 voxels, in codes.
constexpr float buried_code = -50.0F;
/// A merge puts rock nearly where the piece was: this share of its points.
constexpr float settled_share = 0.6F;
/// Rock has gone from a point that is so far in the air: codes.
constexpr float gone_code = 12.0F;
/// And from a stone when it has gone from this share of its points: of small stones, one of five points may
/// go.
constexpr float gone_share = 0.25F;

/// Trilinear, in codes.
float code_around(const Field& field, glm::vec3 voxels) {
  const VoxelCoord c{floor_to_int(voxels.x), floor_to_int(voxels.y), floor_to_int(voxels.z)};
  const glm::vec3 f = voxels - as_vector(c);
  float sum = 0.0F;
  for (int i = 0; i < 8; ++i) {
    const VoxelCoord v = c + VoxelCoord{i >> 2, (i >> 1) & 1, i & 1};
    if (field.is_out(chunk_of(v))) return -1.0F;
    const glm::vec3 share = glm::mix(1.0F - f, f, as_vector(v - c));
    const int at = Brick::index(v.x & 7, v.y & 7, v.z & 7);
    sum += share.x * share.y * share.z *
           static_cast<float>(field.brick(brick_of(v)).codes[static_cast<size_t>(at)]);
  }
  return sum;
}
static_assert(brick_size == 8);

BrickCoord brick_at(glm::vec3 voxels) {
  return brick_of({floor_to_int(voxels.x), floor_to_int(voxels.y), floor_to_int(voxels.z)});
}

}  // namespace

bool has_moved(const Volume& volume, const Pose& pose, float voxel_size_m) {
  constexpr float moved_m = 0.01F, turned_cosine = 0.99999F;
  const glm::vec3 off_m = pose.position_m - volume.centre_voxels * voxel_size_m;
  return glm::dot(off_m, off_m) >= moved_m * moved_m || std::abs(pose.rotation.w) <= turned_cosine;
}

namespace {

/// Where the voxels of those codes lie: of many, each so manieth.
template <typename IsMeant>
StonePoints points_where(const Volume& volume, const Pose& pose, float voxel_size_m,
                         const IsMeant& is_meant) {
  const std::vector<Code>& codes = volume.window.codes;
  const size_t step = static_cast<size_t>(std::ranges::count_if(codes, is_meant)) / stone_points_max + 1;
  const VoxelBox& box = volume.window.box;
  StonePoints points;
  size_t i = 0, found = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z)
        if (is_meant(codes[i++]) && found++ % step == 0)
          points.push_back(pose.position_m / voxel_size_m +
                           pose.rotation * (glm::vec3(x, y, z) - volume.centre_voxels));
  CHECK(points.size() <= stone_points_max);
  return points;
}

}  // namespace

StonePoints stone_points(const Volume& volume, const Pose& pose, float voxel_size_m) {
  return points_where(volume, pose, voxel_size_m, [](Code code) { return code <= deep_in_stone; });
}

StonePoints surface_points(const Volume& volume, const Pose& pose, float voxel_size_m) {
  return points_where(volume, pose, voxel_size_m,
                      [](Code code) { return std::abs(int{code}) <= on_surface; });
}

bool is_buried(const StonePoints& surface, const Field& field) {
  return std::ranges::all_of(surface,
                             [&](glm::vec3 point) { return code_around(field, point) < buried_code; });
}

uint32_t points_in_rock(const StonePoints& points, const Field& field) {
  uint32_t bits = 0;
  float count = 0.0F;
  for (size_t i = 0; i < points.size(); ++i) {
    if (code_around(field, points[i]) > 0.0F) continue;
    bits |= 1U << i;
    count += 1.0F;
  }
  return count < settled_share * static_cast<float>(points.size()) ? 0 : bits;
}

StonePoints chosen(const StonePoints& points, uint32_t bits) {
  StonePoints some;
  for (size_t i = 0; i < points.size(); ++i)
    if (((bits >> i) & 1U) != 0) some.push_back(points[i]);
  return some;
}

bool has_rock_gone(const StonePoints& points, const Field& field) {
  const auto gone =
      std::ranges::count_if(points, [&](glm::vec3 point) { return code_around(field, point) > gone_code; });
  return static_cast<float>(gone) > gone_share * static_cast<float>(points.size());
}

void StonePlaces::add(PieceId id, StonePoints points) {
  CHECK(!points.empty() && !points_.contains(id));
  for (const glm::vec3 point : points) {
    std::vector<PieceId>& here = in_brick_[brick_at(point)];
    if (here.empty() || here.back() != id) here.push_back(id);
  }
  points_.emplace(id, std::move(points));
}

void StonePlaces::remove(PieceId id) {
  for (const glm::vec3 point : points_.at(id)) {
    const auto found = in_brick_.find(brick_at(point));
    if (found == in_brick_.end()) continue;
    std::erase(found->second, id);
    if (found->second.empty()) in_brick_.erase(found);
  }
  points_.erase(id);
}

std::vector<PieceId> StonePlaces::touched(std::span<const BrickCoord> bricks) const {
  std::vector<PieceId> found;
  for (const BrickCoord brick : bricks)
    if (const auto here = in_brick_.find(brick); here != in_brick_.end())
      found.insert(found.end(), here->second.begin(), here->second.end());
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void StonePlaces::clear() {
  points_.clear();
  in_brick_.clear();
}

std::vector<PieceId> end_stones(StonePlaces& places, std::span<const BrickCoord> changed,
                                const Field& field) {
  std::vector<PieceId> ended = places.touched(changed);
  std::erase_if(ended, [&](PieceId id) { return !has_rock_gone(places.points(id), field); });
  for (const PieceId id : ended) places.remove(id);
  return ended;
}

}  // namespace scree
