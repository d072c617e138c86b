// Who has which part of a row of equal things, such as the vertices in a buffer. No GL. Not thread-safe.
#pragma once

#include <cstddef>
#include <map>

namespace scree {

class Ranges {
 public:
  /// Takes `count` (> 0) in a row, from the first gap that is long enough, or after all that are taken;
  /// returns the first.
  size_t allocate(size_t count);
  /// Gives back what allocate() gave, whole.
  void give(size_t first, size_t count);

  /// One past the last that is taken.
  size_t end() const { return end_; }
  /// How many are taken.
  size_t allocated() const { return allocated_; }

 private:
  std::map<size_t, size_t> gaps_;  ///< lengths by their first; none touches another, or the end
  size_t end_ = 0;
  size_t allocated_ = 0;
};

}  // namespace scree
