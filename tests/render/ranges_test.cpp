// Parts of a buffer: none belongs to two, and what is given back is taken again.
#include "client/render/scene/ranges.h"

#include <gtest/gtest.h>
#include <vector>

#include "shared/base/random.h"

namespace scree {
namespace {

TEST(Ranges, gaps_are_taken_again_and_the_end_goes_back) {
  Ranges ranges;
  EXPECT_EQ(ranges.allocate(10), 0U);
  EXPECT_EQ(ranges.allocate(5), 10U);
  EXPECT_EQ(ranges.allocate(5), 15U);
  ranges.give(0, 10);
  EXPECT_EQ(ranges.allocate(11), 20U);
  EXPECT_EQ(ranges.allocate(4), 0U);
  EXPECT_EQ(ranges.allocate(6), 4U);
  ranges.give(20, 11);
  EXPECT_EQ(ranges.end(), 20U);
  ranges.give(10, 5);
  ranges.give(15, 5);
  EXPECT_EQ(ranges.end(), 10U);
  EXPECT_EQ(ranges.allocated(), 10U);
}

TEST(Ranges, nothing_is_taken_twice_over_many_takes_and_gives) {
  Ranges ranges;
  Random random(5);
  struct Part {
    size_t first, count;
  };
  std::vector<Part> parts;
  std::vector<bool> taken(20000);
  const auto mark = [&](const Part& part, bool to) {
    for (size_t i = part.first; i < part.first + part.count; ++i) {
      ASSERT_NE(taken.at(i), to);
      taken[i] = to;
    }
  };
  for (int round = 0; round < 4000; ++round) {
    if (parts.size() > 50 || (!parts.empty() && random.below(2) == 0)) {
      const size_t which = random.below(static_cast<uint32_t>(parts.size()));
      mark(parts[which], false);
      ranges.give(parts[which].first, parts[which].count);
      parts.erase(parts.begin() + static_cast<long>(which));
    } else {
      const size_t count = 1 + random.below(100);
      parts.push_back({ranges.allocate(count), count});
      mark(parts.back(), true);
    }
  }
  size_t sum = 0, last = 0;
  for (const Part& part : parts) {
    sum += part.count;
    last = std::max(last, part.first + part.count);
  }
  EXPECT_EQ(ranges.allocated(), sum);
  EXPECT_EQ(ranges.end(), last);
}

}  // namespace
}  // namespace scree
