// The octrees whose leaves are the terrain's meshes: fine ones near the eye, coarse ones to the horizon. No
// GL.
//
// A node of level k is a block of 16³ cells with a side of 2^k voxels each. Leaves that touch, be it by a
// corner, differ by one level at most. The forest grows to the detail that the eye's place needs by a few
// splits and joins at a time, nearest first, each of which keeps that balance. Not thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "shared/field/coord.h"

namespace scree {

inline constexpr int block_size = 16;  ///< cells a side
using BlockCoord = Coord<struct BlockTag>;

struct SurfaceNode {
  int level = 0;
  BlockCoord at;

  auto operator<=>(const SurfaceNode&) const = default;
};

struct SurfaceNodeHash {
  size_t operator()(const SurfaceNode& node) const {
    return CoordHash()(node.at) * 31 + static_cast<size_t>(node.level);
  }
};

/// The content of a neighbour's place. `beyond`: a coarser node, or none.
enum class Neighbour : uint8_t { same, finer, beyond };

/// Index (x + 1) · 9 + (y + 1) · 3 + z + 1; 13 is the node itself.
using Neighbours = std::array<Neighbour, 27>;
bool is_uniform(const Neighbours& around);

/// The result of a step of growth.
struct ForestStep {
  std::vector<SurfaceNode> changed;  ///< leaves that are new, or have other neighbours than before
  std::vector<SurfaceNode> gone;     ///< leaves no more
  bool empty() const { return changed.empty() && gone.empty(); }
};

struct ForestShape {
  int levels = 1;          ///< the coarsest is levels − 1
  float block_m = 4.0F;    ///< side of a node of level 0
  float fine_m = 16.0F;    ///< all nearer than this is of level 0; at least four times block_m
  float reach_m = 128.0F;  ///< all nearer than this is in some leaf
  float floor_m = 0.0F;    ///< so far down and `top_m` up there is something to draw, wherever the eye is
  float top_m = 0.0F;
};

class SurfaceForest {
 public:
  explicit SurfaceForest(const ForestShape& shape) : shape_(shape) {}

  /// Grows by at most `steps_max` splits and joins. Roots are added and removed first, all at once. The
  /// result is empty when there is nothing to do.
  ForestStep grow(glm::vec3 eye_m, size_t steps_max);
  /// Reverts the last grow(). Call at most once after it.
  void undo();

  bool is_leaf(const SurfaceNode& node) const { return leaves_.contains(node); }
  const Neighbours& neighbours(const SurfaceNode& leaf) const { return leaves_.at(leaf); }
  /// Leaves that hold or touch the box, voxels, grown by so many cells of their own.
  std::vector<SurfaceNode> leaves_around(const VoxelBox& box, int cells) const;

 private:
  struct Change {
    SurfaceNode node;
    bool split;
    float distance_m;
  };

  /// The state of a node before grow() changed it.
  struct Before {
    SurfaceNode node;
    std::optional<Neighbours> leaf;
    bool split;
    bool root;
  };

  void note(const SurfaceNode& node);
  float side_m(int level) const { return shape_.block_m * static_cast<float>(1 << level); }
  float distance_m(const SurfaceNode& node, glm::vec3 eye_m) const;
  bool wants_split(const SurfaceNode& node, glm::vec3 eye_m, float hysteresis) const;
  void move_roots(glm::vec3 eye_m, ForestStep& step, std::vector<SurfaceNode>& touched);
  std::vector<Change> wishes(glm::vec3 eye_m) const;
  bool may_split(const SurfaceNode& node) const;
  bool may_join(const SurfaceNode& node) const;
  void split(const SurfaceNode& node, ForestStep& step);
  void join(const SurfaceNode& node, ForestStep& step);
  void remove_tree(const SurfaceNode& node, ForestStep& step);
  Neighbour kind_at(const SurfaceNode& node) const;
  Neighbours neighbours_of(const SurfaceNode& node) const;
  void refresh(const std::vector<SurfaceNode>& touched, ForestStep& step);

  ForestShape shape_;
  std::unordered_map<SurfaceNode, Neighbours, SurfaceNodeHash> leaves_;
  std::unordered_set<SurfaceNode, SurfaceNodeHash> split_;
  std::unordered_set<SurfaceNode, SurfaceNodeHash> roots_;
  std::vector<Before> before_;  ///< of the last grow(), in its order
};

}  // namespace scree
