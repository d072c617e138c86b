// Boxes in a tree, so that those near a way or a place are found without looking at all. Packed: the boxes
// are ordered along a curve through space (Morton 1966), each node holds eight in a row. The same for the
// same boxes, on every system.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace scree {

/// A box in space, of any unit. A box whose `lo` is above its `hi` is empty.
struct SpaceBox {
  glm::dvec3 lo{0.0};
  glm::dvec3 hi{0.0};

  bool meets(const SpaceBox& o) const {
    return lo.x <= o.hi.x && lo.y <= o.hi.y && lo.z <= o.hi.z && hi.x >= o.lo.x && hi.y >= o.lo.y &&
           hi.z >= o.lo.z;
  }
  SpaceBox grown(double by) const { return {lo - by, hi + by}; }
};

SpaceBox hull_of(const SpaceBox& a, const SpaceBox& b);

/// Whether a segment comes into a box.
bool passes(const SpaceBox& box, const glm::dvec3& from, const glm::dvec3& to);

class SolidTree {
 public:
  SolidTree() = default;
  explicit SolidTree(std::vector<SpaceBox> boxes);

  const SpaceBox& box(size_t index) const { return boxes_[index]; }
  /// Calls each(index) for every box that `is_near(box)` is true of, where it is true of larger boxes around;
  /// in the order of the curve.
  template <typename IsNear, typename Each>
  void visit(IsNear&& is_near, Each&& each) const {
    if (!levels_.empty()) visit_node(levels_.size() - 1, 0, is_near, each);
  }

 private:
  static constexpr size_t fan = 8;

  template <typename IsNear, typename Each>
  void visit_node(size_t level, size_t node, IsNear& is_near, Each& each) const {
    const size_t below = level == 0 ? order_.size() : levels_[level - 1].size();
    for (size_t i = node * fan; i < below && i < node * fan + fan; ++i) {
      if (level == 0) {
        if (is_near(boxes_[order_[i]])) each(order_[i]);
      } else if (is_near(levels_[level - 1][i])) {
        visit_node(level - 1, i, is_near, each);
      }
    }
  }

  std::vector<SpaceBox> boxes_;
  std::vector<uint32_t> order_;
  std::vector<std::vector<SpaceBox>> levels_;  ///< each node of a level around eight of the one before
};

}  // namespace scree
