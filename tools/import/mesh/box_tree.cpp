#include "tools/import/mesh/box_tree.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>
#include <tuple>

namespace scree {

namespace {

constexpr uint32_t leaf_boxes = 8;

}  // namespace

void Box3::add(const glm::dvec3& p) {
  lo = glm::min(lo, p);
  hi = glm::max(hi, p);
}

bool Box3::holds(const glm::dvec3& p, double reach) const {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < lo[axis] - reach || p[axis] > hi[axis] + reach) return false;
  return true;
}

BoxTree::BoxTree(std::vector<Box3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!boxes_.empty()) build(0, static_cast<uint32_t>(boxes_.size()));
}

uint32_t BoxTree::build(uint32_t first, uint32_t count) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, count, 0});
  Box3 all;
  for (uint32_t i = first; i < first + count; ++i) {
    all.add(boxes_[order_[i]].lo);
    all.add(boxes_[order_[i]].hi);
  }
  nodes_[index].box = all;
  if (count <= leaf_boxes) return index;
  const glm::dvec3 size = all.hi - all.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](uint32_t one, uint32_t other) {
    return std::tuple(boxes_[one].lo[axis] + boxes_[one].hi[axis], one) <
           std::tuple(boxes_[other].lo[axis] + boxes_[other].hi[axis], other);
  });
  build(first, count / 2);
  const uint32_t right = build(first + count / 2, count - count / 2);
  nodes_[index].right = right;
  return index;
}

}  // namespace scree
