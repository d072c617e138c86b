#include "proto/range_coder.h"

#include "shared/base/check.h"

namespace scree {

/// Adds one to the bytes written so far, which hold less than the whole range.
void RangeEncoder::carry() {
  low_ &= 0xFFFFFFFFU;
  size_t at = bytes_.size();
  do {
    CHECK(at > begin_);
    --at;
  } while (++bytes_[at] == 0);
}

/// Writes the number within the range that has the most zeros at its end, and leaves these out.
void RangeEncoder::finish() {
  for (uint32_t zeros = 32; zeros-- > 0;) {
    const uint64_t mask = (uint64_t{1} << zeros) - 1;
    const uint64_t number = (low_ + mask) & ~mask;
    if (number >= low_ + range_) continue;
    low_ = number;
    break;
  }
  for (int i = 0; i < 4; ++i) shift();
  while (bytes_.size() > begin_ && bytes_.back() == 0) bytes_.pop_back();
}

}  // namespace scree
