// Ground messages that contradict themselves are refused.
#include <gtest/gtest.h>

#include "tests/support/materials.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

std::string refusal_of(const GroundMessage& ground) {
  const auto decoded = decode_server(samples::body_of(encode(ServerMessage(ground))));
  return decoded ? "" : decoded.error().message;
}

TEST(GroundCodec, a_brick_that_is_listed_and_rock_or_painted_or_elsewhere_is_refused) {
  const GroundMessage good{{-1, 2, 0}, false, 1ULL << 62U, {{{-4, 8, 0}, samples::noisy_brick(5)}}, 7};
  EXPECT_EQ(refusal_of(good), "");
  GroundMessage twice = good;
  twice.rock = 1;  // (−4, 8, 0) is the chunk's first
  EXPECT_NE(refusal_of(twice).find("wholly rock"), std::string::npos);
  GroundMessage painted = good;
  painted.bricks[0].materials = all_of(material::ice);
  EXPECT_NE(refusal_of(painted).find("painted"), std::string::npos);
  GroundMessage elsewhere = good;
  elsewhere.bricks[0].coord.x += 4;
  EXPECT_NE(refusal_of(elsewhere).find("another chunk"), std::string::npos);
}

TEST(GroundCodec, ground_beyond_the_interest_has_nothing_else) {
  GroundMessage beyond{.chunk = {1, 2, 3}, .beyond = true};
  EXPECT_EQ(refusal_of(beyond), "");
  beyond.rock = 1;
  EXPECT_NE(refusal_of(beyond).find("beyond"), std::string::npos);
}

}  // namespace
}  // namespace scree
