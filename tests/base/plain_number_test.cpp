// Numbers in messages for people.
#include "shared/base/plain_number.h"

#include <gtest/gtest.h>
#include <limits>

namespace scree {
namespace {

TEST(PlainNumber, no_number_has_an_exponent_or_digits_that_say_nothing) {
  EXPECT_EQ(plain(0.0), "0");
  EXPECT_EQ(plain(-0.0), "0");
  EXPECT_EQ(plain(double{0.01F}), "0.01");
  EXPECT_EQ(plain(double{0.6F}), "0.6");
  EXPECT_EQ(plain(-12.5), "-12.5");
  EXPECT_EQ(plain(16.0), "16");
  EXPECT_EQ(plain(4096.0), "4096");
  EXPECT_EQ(plain(double{1e7F}), "10,000,000");
  EXPECT_EQ(plain(1e9), "1,000,000,000");
  EXPECT_EQ(plain(double{1e11F}), "100,000,000,000") << "a float is 99,999,997,952";
  EXPECT_EQ(plain(-123456.7), "-123,457");
  EXPECT_EQ(plain(1.0 / 3.0), "0.33333");
  EXPECT_EQ(plain(9999.96), "10,000");
}

TEST(PlainNumber, what_nobody_would_write_out_is_said) {
  EXPECT_EQ(plain(3e38), "more than 10^15");
  EXPECT_EQ(plain(-3e38), "less than -10^15");
  EXPECT_EQ(plain(std::numeric_limits<double>::quiet_NaN()), "no number");
  EXPECT_EQ(with_unit(std::numeric_limits<double>::infinity(), "m"), "no number");
}

TEST(PlainNumber, a_unit_follows) {
  EXPECT_EQ(metres(20.0), "20 m");
  EXPECT_EQ(with_unit(2.5, ""), "2.5");
  EXPECT_EQ(range_text(double{0.01F}, 16.0, "m"), "from 0.01 to 16 m");
}

}  // namespace
}  // namespace scree
