// Prints the hashes of a scripted run, a line a tick: of the field, and of the state.
// tests/python/test_world.py makes the same run from Python.
#include <cinttypes>
#include <cstdio>

#include "server/world/world.h"

int main() {
  using namespace scree;
  WorldConfig config;
  config.terrain.kind = TerrainKind::canyon;
  config.terrain.random_seed = 7;
  World world(config);
  for (uint32_t tick = 0; tick < 90; ++tick) {
    const Shape shape = sphere({6.0F + static_cast<float>(tick), 20.0F, 0.0F}, 2.5F);
    const Command carve{
        .body = CarveRequest{.shape = shape, .seeds = 12, .random_seed = tick, .impact_m = centre_of(shape)}};
    const auto delta = world.step({&carve, tick < 8 ? size_t{1} : size_t{0}});
    std::printf("%016" PRIx64 " %016" PRIx64 "\n", delta->field_hash, delta->state_hash);
  }
}
