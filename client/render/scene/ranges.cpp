#include "client/render/scene/ranges.h"

#include <algorithm>
#include <iterator>

#include "shared/base/check.h"

namespace scree {

size_t Ranges::allocate(size_t count) {
  CHECK(count > 0);
  allocated_ += count;
  const auto gap = std::ranges::find_if(gaps_, [count](const auto& one) { return one.second >= count; });
  if (gap == gaps_.end()) {
    end_ += count;
    return end_ - count;
  }
  const auto [first, length] = *gap;
  gaps_.erase(gap);
  if (length > count) gaps_.emplace(first + count, length - count);
  return first;
}

void Ranges::give(size_t first, size_t count) {
  CHECK(count > 0 && first + count <= end_ && count <= allocated_);
  allocated_ -= count;
  auto next = gaps_.lower_bound(first);
  CHECK(next == gaps_.end() || first + count <= next->first);
  if (next != gaps_.end() && first + count == next->first) {
    count += next->second;
    next = gaps_.erase(next);
  }
  if (next != gaps_.begin()) {
    const auto before = std::prev(next);
    CHECK(before->first + before->second <= first);
    if (before->first + before->second == first) {
      first = before->first;
      count += before->second;
      gaps_.erase(before);
    }
  }
  if (first + count == end_) {
    end_ = first;
  } else {
    gaps_.emplace(first, count);
  }
}

}  // namespace scree
