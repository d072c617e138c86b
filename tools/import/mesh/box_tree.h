// Boxes in a tree, to find those near a place.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace scree {

struct Box3 {
  glm::dvec3 lo{1e300};
  glm::dvec3 hi{-1e300};

  void add(const glm::dvec3& p);
  bool holds(const glm::dvec3& p, double reach = 0.0) const;
};

class BoxTree {
 public:
  explicit BoxTree(std::vector<Box3> boxes);

  /// Calls f(number of the box) for each box within reach of p, in an order that the boxes alone decide.
  template <typename F>
  void each_near(const glm::dvec3& p, double reach, F&& f) const {
    if (!nodes_.empty()) visit(0, p, reach, f);
  }

 private:
  struct Node {
    Box3 box;
    uint32_t first = 0;  ///< of the order
    uint32_t count = 0;
    uint32_t right = 0;  ///< child; the left one is the next node; 0: a leaf
  };

  uint32_t build(uint32_t first, uint32_t count);
  template <typename F>
  void visit(uint32_t at, const glm::dvec3& p, double reach, F&& f) const {
    const Node& node = nodes_[at];
    if (!node.box.holds(p, reach)) return;
    if (node.right == 0) {
      for (uint32_t i = node.first; i < node.first + node.count; ++i)
        if (boxes_[order_[i]].holds(p, reach)) f(order_[i]);
      return;
    }
    visit(at + 1, p, reach, f);
    visit(node.right, p, reach, f);
  }

  std::vector<Box3> boxes_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace scree
