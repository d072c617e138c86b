#include "tools/import/vox/vox_bricks.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

#include "tools/import/vox/limits.h"

namespace scree {

namespace {

using Whole3 = std::array<int64_t, 3>;

Whole3 turned(const VoxTurn& turn, const Whole3& v) {
  Whole3 out{};
  for (size_t i = 0; i < 3; ++i) {
    const int64_t part = v[static_cast<size_t>(turn.axis[i])];
    out[i] = turn.negative[i] ? -part : part;
  }
  return out;
}

/// A turn about the origin, then a move.
struct Placed {
  VoxTurn turn;
  Whole3 move{};

  /// First `inner`, then this.
  Placed after(const VoxTurn& inner, const Whole3& inner_move) const {
    Placed both;
    for (size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<size_t>(turn.axis[i]);
      both.turn.axis[i] = inner.axis[k];
      both.turn.negative[i] = turn.negative[i] != inner.negative[k];
    }
    both.move = turned(turn, inner_move);
    for (size_t i = 0; i < 3; ++i) both.move[i] += move[i];
    return both;
  }
};

class Placer {
 public:
  Placer(const VoxScene& scene, VoxBricks& to) : scene_(scene), to_(to) {}

  /// A scene without nodes is its first model, whose corner is the origin.
  Result<void> run() {
    if (scene_.nodes.empty()) {
      const VoxModel& model = scene_.models.front();
      Placed pose;
      for (size_t i = 0; i < 3; ++i) pose.move[i] = model.size[i] / 2;
      TRY(stamp(model, pose));
    } else {
      if (!scene_.nodes.contains(0)) return fail("it has nodes, and none of number 0: it is damaged");
      TRY(visit(0, {}, 0));
    }
    for (const auto& [at, brick] : to_.bricks)
      for (const uint8_t colour : brick) to_.voxels += colour != 0 ? 1 : 0;
    return {};
  }

 private:
  Result<void> visit(int32_t id, const Placed& pose, int depth) {
    above_.resize(static_cast<size_t>(depth));
    if (depth > limits::vox_depth_max) return too_deep();
    above_.push_back(id);
    if (++visits_ > limits::vox_visits_max)
      return fail(fmt::format("its nodes are visited more than {} times (limits.vox_visits_max)",
                              limits::vox_visits_max));
    const auto found = scene_.nodes.find(id);
    if (found == scene_.nodes.end()) return fail(fmt::format("it names node {}, which is not there", id));
    const VoxNode& node = found->second;
    if (node.hidden || scene_.hidden_layers.contains(node.layer)) {
      ++to_.hidden;
      return {};
    }
    if (node.kind == VoxNode::Kind::shape) return show(node, pose);
    const Placed inner = node.kind == VoxNode::Kind::transform ? pose.after(node.turn, node.move) : pose;
    for (const int64_t axis : inner.move)
      if (std::abs(axis) > limits::vox_far_max)
        return fail("a model lies beyond every world (limits.vox_far_max)");
    for (const int32_t child : node.children) TRY(visit(child, inner, depth + 1));
    return {};
  }

  Result<void> too_deep() const {
    for (size_t i = 0; i < above_.size(); ++i)
      if (std::find(above_.begin(), above_.begin() + static_cast<std::ptrdiff_t>(i), above_[i]) !=
          above_.begin() + static_cast<std::ptrdiff_t>(i))
        return fail(fmt::format("its node {} is below itself", above_[i]));
    return fail(
        fmt::format("its nodes are nested more than {} deep (limits.vox_depth_max)", limits::vox_depth_max));
  }

  /// A shape with several models is an animation: it shows the first.
  Result<void> show(const VoxNode& node, const Placed& pose) {
    if (node.children.empty()) return {};
    const auto model = static_cast<size_t>(node.children.front());
    if (node.children.front() < 0 || model >= scene_.models.size())
      return fail(fmt::format("it names model {}, and has {}", node.children.front(), scene_.models.size()));
    return stamp(scene_.models[model], pose);
  }

  /// A model turns about its middle, rounded down. Twice the places are those of the voxels' middles.
  Result<void> stamp(const VoxModel& model, const Placed& pose) {
    ++to_.copies;
    stamped_ += model.voxels.size();
    if (stamped_ > limits::vox_voxels_max)
      return fail(fmt::format("its models have more than {} voxels in all (limits.vox_voxels_max)",
                              limits::vox_voxels_max));
    for (const auto& voxel : model.voxels) {
      Whole3 twice{};
      for (size_t i = 0; i < 3; ++i) twice[i] = 2 * int64_t{voxel[i]} + 1 - 2 * int64_t{model.size[i] / 2};
      twice = turned(pose.turn, twice);
      Whole3 at{};
      for (size_t i = 0; i < 3; ++i) at[i] = (twice[i] - 1) / 2 + pose.move[i];  // odd, so exact
      TRY(put({static_cast<int>(at[0]), static_cast<int>(at[2]), static_cast<int>(-1 - at[1])}, voxel[3]));
    }
    return {};
  }

  Result<void> put(VoxelCoord at, uint8_t colour) {
    const BrickCoord coord = brick_of(at);
    if (last_ == nullptr || coord != last_coord_) {
      const auto [found, is_new] = to_.bricks.try_emplace(coord, VoxBrick{});
      if (is_new && to_.bricks.size() > limits::vox_bricks_max)
        return fail(fmt::format("its voxels lie in more than {} bricks of 8 a side (limits.vox_bricks_max)",
                                limits::vox_bricks_max));
      last_ = &found->second;
      last_coord_ = coord;
    }
    (*last_)[static_cast<size_t>((at.x & 7) * 64 + (at.y & 7) * 8 + (at.z & 7))] = colour;
    return {};
  }

  const VoxScene& scene_;
  VoxBricks& to_;
  std::vector<int32_t> above_;  ///< nodes on the way to the one that is visited
  size_t visits_ = 0;
  uint64_t stamped_ = 0;
  VoxBrick* last_ = nullptr;
  BrickCoord last_coord_;
};

}  // namespace

Result<VoxBricks> placed_voxels(const VoxScene& scene) {
  VoxBricks bricks;
  TRY(Placer(scene, bricks).run());
  return bricks;
}

}  // namespace scree
