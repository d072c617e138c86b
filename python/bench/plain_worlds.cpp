// The worlds of python/bench/batch.py in plain C++: prints seconds, those of the processor, and the sum of
// the worlds' hashes. usage: plain_worlds WORLDS SECONDS TICKS_A_CALL
#include <charconv>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <vector>

#include "server/world/world.h"
#include "shared/base/workers.h"

namespace {

using namespace scree;

int whole(const char* text) {
  int value = 0;
  std::from_chars(text, text + std::strlen(text), value);
  return value;
}

/// The blow into world i in that second, within 32 m.
Command blow(int i, int second) {
  const Shape shape = sphere({static_cast<float>((i * 7 + second * 5) % 25 - 12), 0.0F,
                              static_cast<float>((i * 11 + second * 3) % 25 - 12)},
                             1.5F);
  return {.body = CarveRequest{.shape = shape,
                               .seeds = 8,
                               .random_seed = static_cast<uint32_t>(second * 64 + i),
                               .impact_m = centre_of(shape)}};
}

}  // namespace

int main(int count, char** given) {
  if (count != 4) return 2;
  const int worlds = whole(given[1]), seconds = whole(given[2]), ticks = whole(given[3]);
  if (worlds < 1 || seconds < 1 || ticks < 1 || 60 % ticks != 0) return 2;
  WorldConfig config;
  config.terrain.kind = TerrainKind::flat;
  std::vector<std::unique_ptr<World>> all;
  for (int i = 0; i < worlds; ++i) all.push_back(std::make_unique<World>(config));
  std::vector<uint64_t> hashes(all.size());
  Workers workers(0);
  const std::clock_t used = std::clock();
  const auto start = std::chrono::steady_clock::now();
  for (int tick = 0; tick < 60 * seconds; tick += ticks)
    workers.run(all.size(), [&](size_t i) {
      const Command command = blow(static_cast<int>(i), tick / 60);
      for (int step = 0; step < ticks; ++step) {
        const size_t commands = tick % 60 == 0 && step == 0 ? 1 : 0;
        hashes[i] = all[i]->step({&command, commands})->state_hash;
      }
      all[i]->release_thread();
    });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  uint64_t sum = 0;
  for (const uint64_t hash : hashes) sum += hash;
  const double used_s = static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC;
  std::printf("%.6f %.6f %" PRIu64 "\n", took.count(), used_s, sum);
}
