#include "client/render/scene/settled_stones.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <unordered_set>
#include <utility>

#include "client/render/scene/limits.h"
#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// Points that tell whether a stone still lies in rock.
constexpr size_t points_max = 24;
/// Voxels at least so deep in a piece are asked, in codes: a quarter of a voxel.
constexpr Code deep_code = -10;
/// A merge puts rock nearly where the piece was: this share of its points.
constexpr float settled_share = 0.6F;
/// Rock has gone from a point that is so far in the air: codes.
constexpr float gone_code = 12.0F;
/// And from a stone when it has gone from this share of its points: of small stones, one of five points may
/// go.
constexpr float gone_share = 0.25F;

/// Trilinear, in codes.
float code_at(const Field& field, glm::vec3 voxels) {
  const VoxelCoord c{floor_to_int(voxels.x), floor_to_int(voxels.y), floor_to_int(voxels.z)};
  const glm::vec3 f = voxels - as_vector(c);
  float sum = 0.0F;
  for (int i = 0; i < 8; ++i) {
    const VoxelCoord v = c + VoxelCoord{i >> 2, (i >> 1) & 1, i & 1};
    const glm::vec3 share = glm::mix(1.0F - f, f, as_vector(v - c));
    const int at = Brick::index(v.x & 7, v.y & 7, v.z & 7);
    sum += share.x * share.y * share.z *
           static_cast<float>(field.brick(brick_of(v)).codes[static_cast<size_t>(at)]);
  }
  return sum;
}
static_assert(brick_size == 8);

/// Whether a piece lies where it was cut: a prediction that was refused, or a body that was cut out and let
/// go.
bool has_not_moved(const ScenePiece& piece, float voxel_m) {
  constexpr float moved_m = 0.01F, turned_cosine = 0.99999F;
  const glm::vec3 off_m = piece.pose.position_m - piece.volume->centre_voxels * voxel_m;
  return glm::dot(off_m, off_m) < moved_m * moved_m && std::abs(piece.pose.rotation.w) > turned_cosine;
}

/// Points in a piece where it lies, in voxels of the field.
std::vector<glm::vec3> points_inside(const ScenePiece& piece, float voxel_m) {
  const Volume& volume = *piece.volume;
  std::vector<glm::vec3> found;
  const VoxelBox& box = volume.window.box;
  size_t i = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z, ++i)
        if (volume.window.codes[i] <= deep_code) found.emplace_back(x, y, z);
  const size_t step = found.size() / points_max + 1;
  std::vector<glm::vec3> points;
  for (size_t at = 0; at < found.size(); at += step)
    points.push_back(piece.pose.position_m / voxel_m +
                     piece.pose.rotation * (found[at] - volume.centre_voxels));
  return points;
}

}  // namespace

const ScenePieces& SettledStones::step(const ScenePieces& pieces, const Field& field, glm::vec3 eye_m,
                                       MirrorChanges& changes) {
  end_where_rock_went(field, changes);
  std::erase_if(changes.pieces_removed, [&](PieceId id) {
    return !stones_.contains(id) && !pieces.contains(id) && settle(id, field);
  });
  leave_the_farthest(eye_m, changes);
  last_ = pieces;
  shown_ = pieces;
  for (const auto& [id, stone] : stones_) shown_.insert_or_assign(id, stone.piece);
  return shown_;
}

void SettledStones::forget() {
  last_.clear();
  shown_.clear();
  stones_.clear();
  in_brick_.clear();
}

bool SettledStones::settle(PieceId id, const Field& field) {
  const auto found = last_.find(id);
  if (found == last_.end() || has_not_moved(found->second, field.source().voxel_size_m)) return false;
  Stone stone{found->second, points_inside(found->second, field.source().voxel_size_m)};
  const size_t all = stone.inside.size();
  std::erase_if(stone.inside, [&](glm::vec3 point) { return code_at(field, point) > 0.0F; });
  if (stone.inside.empty() ||
      static_cast<float>(stone.inside.size()) < settled_share * static_cast<float>(all))
    return false;
  std::unordered_set<BrickCoord, CoordHash> bricks;
  for (const glm::vec3 point : stone.inside)
    bricks.insert(brick_of({floor_to_int(point.x), floor_to_int(point.y), floor_to_int(point.z)}));
  for (const BrickCoord brick : bricks) in_brick_[brick].push_back(id);
  stones_.emplace(id, std::move(stone));
  return true;
}

bool SettledStones::lies_in(const Field& field, const Stone& stone) const {
  const auto gone =
      std::ranges::count_if(stone.inside, [&](glm::vec3 point) { return code_at(field, point) > gone_code; });
  return static_cast<float>(gone) <= gone_share * static_cast<float>(stone.inside.size());
}

void SettledStones::remove(PieceId id, MirrorChanges& changes) {
  for (const glm::vec3 point : stones_.at(id).inside) {
    const auto found =
        in_brick_.find(brick_of({floor_to_int(point.x), floor_to_int(point.y), floor_to_int(point.z)}));
    if (found == in_brick_.end()) continue;
    std::erase(found->second, id);
    if (found->second.empty()) in_brick_.erase(found);
  }
  stones_.erase(id);
  changes.pieces_removed.push_back(id);
}

void SettledStones::end_where_rock_went(const Field& field, MirrorChanges& changes) {
  std::unordered_set<PieceId> asked;
  for (const BrickCoord brick : changes.bricks)
    if (const auto found = in_brick_.find(brick); found != in_brick_.end())
      asked.insert(found->second.begin(), found->second.end());
  for (const PieceId id : asked)
    if (!lies_in(field, stones_.at(id))) remove(id, changes);
}

/// There are few more than the limit at any time.
void SettledStones::leave_the_farthest(glm::vec3 eye_m, MirrorChanges& changes) {
  while (stones_.size() > limits::settled_stones_max) {
    const auto away = [&](const auto& entry) {
      const glm::vec3 off = entry.second.piece.pose.position_m - eye_m;
      return glm::dot(off, off);
    };
    remove(std::ranges::max_element(stones_, {}, away)->first, changes);
  }
}

}  // namespace scree
