#include "server/net/welcome.h"

#include "crypto/sha256.h"

namespace scree {

WelcomeMessage welcome_of(const NetConfig& config, uint64_t world) {
  WelcomeMessage welcome;
  welcome.tick_rate_hz = config.tick_rate_hz;
  welcome.ticks_per_transform = config.ticks_per_transform;
  welcome.terrain = config.terrain;
  welcome.replay = config.replay;
  welcome.world = world;
  if (const auto& ground = config.terrain.heights) {
    welcome.heights = HeightGround{ground->layout(), sha256(ground->packed(ground->layout().top())), {}};
    if (const auto& bricks = ground->bricks())
      welcome.heights->bricks = BrickGround{*bricks, sha256(ground->packed(bricks->root()))};
  }
  return welcome;
}

}  // namespace scree
