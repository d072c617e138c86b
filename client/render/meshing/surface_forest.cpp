#include "client/render/meshing/surface_forest.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace scree {
namespace {

/// Ratio of the distance at which a node is joined again to that at which it is split: movement to and fro
/// across a border builds nothing.
constexpr float join_per_split = 1.15F;

SurfaceNode parent_of(const SurfaceNode& node) {
  return {node.level + 1, {node.at.x >> 1, node.at.y >> 1, node.at.z >> 1}};
}

SurfaceNode child_of(const SurfaceNode& node, int i) {
  return {node.level - 1,
          {node.at.x * 2 + (i >> 2), node.at.y * 2 + ((i >> 1) & 1), node.at.z * 2 + (i & 1)}};
}

/// Neighbours of a new leaf, not determined yet: no leaf is beyond itself.
Neighbours not_yet() {
  Neighbours around;
  around.fill(Neighbour::beyond);
  return around;
}

/// Calls f(node, index) for the node and the 26 around it.
template <typename F>
void for_each_around(const SurfaceNode& node, F&& f) {
  for (int i = 0; i < 27; ++i)
    f(SurfaceNode{node.level, node.at + BlockCoord{i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1}},
      static_cast<size_t>(i));
}

}  // namespace

bool is_uniform(const Neighbours& around) {
  return std::ranges::all_of(around, [](Neighbour n) { return n == Neighbour::same; });
}

float SurfaceForest::distance_m(const SurfaceNode& node, glm::vec3 eye_m) const {
  const float side = side_m(node.level);
  const auto off = [side](float eye, int at) {
    const float low = static_cast<float>(at) * side;
    return std::max({low - eye, eye - low - side, 0.0F});
  };
  const float x = off(eye_m.x, node.at.x), y = off(eye_m.y, node.at.y), z = off(eye_m.z, node.at.z);
  return std::sqrt(x * x + y * y + z * z);
}

bool SurfaceForest::wants_split(const SurfaceNode& node, glm::vec3 eye_m, float hysteresis) const {
  // In proportion to its side: at least twice that, which keeps neighbours within one level.
  const float within_m = shape_.fine_m * static_cast<float>(1 << (node.level - 1));
  return distance_m(node, eye_m) < within_m * hysteresis;
}

Neighbour SurfaceForest::kind_at(const SurfaceNode& node) const {
  if (leaves_.contains(node)) return Neighbour::same;
  return split_.contains(node) ? Neighbour::finer : Neighbour::beyond;
}

Neighbours SurfaceForest::neighbours_of(const SurfaceNode& node) const {
  Neighbours around;
  for_each_around(node, [&](const SurfaceNode& other, size_t i) { around[i] = kind_at(other); });
  return around;
}

bool SurfaceForest::may_split(const SurfaceNode& node) const {
  bool may = true;
  for_each_around(node, [&](const SurfaceNode& other, size_t) {
    may = may && (node.level == shape_.levels - 1 || !leaves_.contains(parent_of(other)));
  });
  return may;
}

bool SurfaceForest::may_join(const SurfaceNode& node) const {
  bool may = true;
  for_each_around(node, [&](const SurfaceNode& other, size_t) {
    for (int i = 0; i < 8 && may; ++i) may = !split_.contains(child_of(other, i));
  });
  return may;
}

/// Keeps a node's state for undo(). Call before each change.
void SurfaceForest::note(const SurfaceNode& node) {
  const auto leaf = leaves_.find(node);
  before_.push_back({node, leaf == leaves_.end() ? std::nullopt : std::optional(leaf->second),
                     split_.contains(node), roots_.contains(node)});
}

void SurfaceForest::undo() {
  const auto put = [](auto& set, const SurfaceNode& node, bool in) {
    if (in) {
      set.insert(node);
    } else {
      set.erase(node);
    }
  };
  for (; !before_.empty(); before_.pop_back()) {
    const Before& was = before_.back();
    if (was.leaf) {
      leaves_[was.node] = *was.leaf;
    } else {
      leaves_.erase(was.node);
    }
    put(split_, was.node, was.split);
    put(roots_, was.node, was.root);
  }
}

void SurfaceForest::split(const SurfaceNode& node, ForestStep& step) {
  note(node);
  leaves_.erase(node);
  split_.insert(node);
  step.gone.push_back(node);
  for (int i = 0; i < 8; ++i) {
    note(child_of(node, i));
    leaves_[child_of(node, i)] = not_yet();
  }
}

void SurfaceForest::join(const SurfaceNode& node, ForestStep& step) {
  note(node);
  split_.erase(node);
  for (int i = 0; i < 8; ++i) {
    note(child_of(node, i));
    leaves_.erase(child_of(node, i));
    step.gone.push_back(child_of(node, i));
  }
  leaves_[node] = not_yet();
}

void SurfaceForest::remove_tree(const SurfaceNode& node, ForestStep& step) {
  note(node);
  if (leaves_.erase(node) > 0) step.gone.push_back(node);
  if (split_.erase(node) > 0)
    for (int i = 0; i < 8; ++i) remove_tree(child_of(node, i), step);
}

void SurfaceForest::move_roots(glm::vec3 eye_m, ForestStep& step, std::vector<SurfaceNode>& touched) {
  const int level = shape_.levels - 1;
  const float side = side_m(level);
  const auto whole = [side](float v) { return static_cast<int>(std::floor(v / side)); };
  std::vector<SurfaceNode> far;
  for (const SurfaceNode& root : roots_)
    if (distance_m(root, eye_m) > shape_.reach_m + side) far.push_back(root);
  for (const SurfaceNode& root : far) {
    note(root);
    roots_.erase(root);
    remove_tree(root, step);
    touched.push_back(root);
  }
  const float low_m = std::min(shape_.floor_m, eye_m.y - shape_.fine_m * 2.0F);
  const float high_m = std::max(shape_.top_m, eye_m.y + shape_.fine_m * 2.0F);
  for (int x = whole(eye_m.x - shape_.reach_m); x <= whole(eye_m.x + shape_.reach_m); ++x)
    for (int y = whole(low_m); y <= whole(high_m); ++y)
      for (int z = whole(eye_m.z - shape_.reach_m); z <= whole(eye_m.z + shape_.reach_m); ++z) {
        const SurfaceNode root{level, {x, y, z}};
        if (roots_.contains(root) || distance_m(root, eye_m) > shape_.reach_m) continue;
        note(root);
        roots_.insert(root);
        leaves_[root] = not_yet();
        touched.push_back(root);
      }
}

std::vector<SurfaceForest::Change> SurfaceForest::wishes(glm::vec3 eye_m) const {
  std::vector<Change> changes;
  for (const auto& [leaf, around] : leaves_)
    if (leaf.level > 0 && wants_split(leaf, eye_m, 1.0F)) changes.push_back({leaf, true, 0.0F});
  for (const SurfaceNode& node : split_) {
    if (wants_split(node, eye_m, join_per_split)) continue;
    bool leaves = true;
    for (int i = 0; i < 8 && leaves; ++i) leaves = leaves_.contains(child_of(node, i));
    if (leaves) changes.push_back({node, false, 0.0F});
  }
  for (Change& change : changes) change.distance_m = distance_m(change.node, eye_m);
  // Coarse levels first: near terrain appears at once, then in detail.
  std::ranges::sort(changes, [](const Change& a, const Change& b) {
    return std::tuple(-a.node.level, a.distance_m, a.node) < std::tuple(-b.node.level, b.distance_m, b.node);
  });
  return changes;
}

ForestStep SurfaceForest::grow(glm::vec3 eye_m, size_t steps_max) {
  ForestStep step;
  before_.clear();
  std::vector<SurfaceNode> touched;
  move_roots(eye_m, step, touched);
  if (touched.empty()) {
    for (const Change& change : wishes(eye_m)) {
      if (touched.size() >= steps_max) break;
      if (change.split ? !may_split(change.node) : !may_join(change.node)) continue;
      if (change.split) {
        split(change.node, step);
      } else {
        join(change.node, step);
      }
      touched.push_back(change.node);
    }
  }
  refresh(touched, step);
  return step;
}

/// Enters the leaves around those nodes whose neighbours changed.
void SurfaceForest::refresh(const std::vector<SurfaceNode>& touched, ForestStep& step) {
  std::unordered_set<SurfaceNode, SurfaceNodeHash> near;
  for (const SurfaceNode& node : touched)
    for_each_around(node, [&](const SurfaceNode& other, size_t) {
      near.insert(other);
      near.insert(parent_of(other));
      if (node.level > 0)
        for (int i = 0; i < 8; ++i) near.insert(child_of(other, i));
    });
  for (const SurfaceNode& node : near) {
    const auto leaf = leaves_.find(node);
    if (leaf == leaves_.end()) continue;
    const Neighbours around = neighbours_of(node);
    if (around == leaf->second) continue;
    note(node);
    leaf->second = around;
    step.changed.push_back(node);
  }
  // A node that was split and joined again within one step, or came back, is not gone.
  std::erase_if(step.gone, [this](const SurfaceNode& node) { return leaves_.contains(node); });
}

std::vector<SurfaceNode> SurfaceForest::leaves_around(const VoxelBox& box, int cells) const {
  std::vector<SurfaceNode> found;
  for (int level = 0; level < shape_.levels; ++level) {
    const auto low = [&](int v) { return ((v >> level) - cells) >> 4; };
    const auto high = [&](int v) { return ((v >> level) + cells) >> 4; };
    for (int x = low(box.lo.x); x <= high(box.hi.x - 1); ++x)
      for (int y = low(box.lo.y); y <= high(box.hi.y - 1); ++y)
        for (int z = low(box.lo.z); z <= high(box.hi.z - 1); ++z)
          if (const SurfaceNode node{level, {x, y, z}}; leaves_.contains(node)) found.push_back(node);
  }
  return found;
}
static_assert(block_size == 16);

}  // namespace scree
