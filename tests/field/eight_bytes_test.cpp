#include "shared/field/eight_bytes.h"

#include <array>
#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(EightBytes, one_code_below_any_limit_is_found_wherever_it_is) {
  for (int limit = 1; limit <= 127; ++limit)
    for (int code = -127; code <= 127; ++code)
      for (size_t at = 0; at < 8; ++at) {
        std::array<Code, 8> codes;
        codes.fill(code_air);
        codes[at] = static_cast<Code>(code);
        ASSERT_EQ(any_below(codes.data(), static_cast<Code>(limit)), code < limit) << code << ' ' << limit;
        ASSERT_EQ(any_solid(codes.data()), code < 0) << code;
      }
}

TEST(EightBytes, zeros_alone_are_all_zero) {
  std::array<uint8_t, 8> bytes{};
  EXPECT_TRUE(all_zero(bytes.data()));
  for (uint8_t& byte : bytes) {
    byte = 1;
    EXPECT_FALSE(all_zero(bytes.data()));
    byte = 0;
  }
}

}  // namespace
}  // namespace scree
