#include "server/net/welcome.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "crypto/sha256.h"
#include "shared/base/limits.h"

namespace scree {

tl::expected<void, Refused> find_protocol(const HelloMessage& hello) {
  if (shares_protocol(hello.protocol, hello.oldest_protocol)) return {};
  const bool one = hello.oldest_protocol == 0 || hello.oldest_protocol == hello.protocol;
  const std::string spoken = one ? fmt::format("version {}", hello.protocol)
                                 : fmt::format("versions {} to {}", hello.oldest_protocol, hello.protocol);
  return refuse(Refusal::protocol_version,
                fmt::format("this server speaks protocol version {}, the client {}: use a client and a "
                            "server of the same release",
                            protocol_version, spoken));
}

tl::expected<HelloMessage, Refused> placed(HelloMessage hello, const std::optional<Spawn>& spawn) {
  TRY(find_protocol(hello));
  if (hello.at_spawn && spawn) hello.eye_m = spawn->eye_m;
  return hello;
}

Result<float> granted_radius(glm::vec3 eye_m, float radius_m) {
  if (!std::isfinite(eye_m.x) || !std::isfinite(eye_m.y) || !std::isfinite(eye_m.z))
    return fail("the eye's position is not a number");
  if (!std::isfinite(radius_m) || radius_m < 0.0F)
    return fail("the radius of interest must be a number, and not negative");
  return std::min(radius_m, limits::interest_radius_max_m);
}

WelcomeMessage welcome_of(const NetConfig& config, uint64_t world, const Publisher& publisher) {
  WelcomeMessage welcome;
  welcome.tick_rate_hz = config.tick_rate_hz;
  welcome.ticks_per_transform = config.ticks_per_transform;
  welcome.terrain = config.terrain;
  welcome.replay = config.replay;
  welcome.world = world;
  welcome.spawn = publisher.state().spawn();
  welcome.palette = publisher.palette();
  if (const auto& ground = config.terrain.heights) {
    welcome.heights = HeightGround{ground->layout(), sha256(ground->packed(ground->layout().top())), {}};
    if (const auto& bricks = ground->bricks())
      welcome.heights->bricks = BrickGround{*bricks, sha256(ground->packed(bricks->root()))};
  }
  return welcome;
}

}  // namespace scree
