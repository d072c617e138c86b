#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <unistd.h>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "server/work/limits.h"
#include "server/work/memory.h"
#include "server/world/published_state.h"
#include "shared/base/random.h"

namespace scree {

namespace {

constexpr uint32_t memory_max_mb = 512;
constexpr double mb = 1024.0 * 1024.0;
constexpr float half_width_m = 2000.0F;

/// Memory of this process that lies in RAM.
double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  statm >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / mb;
}

CarveRequest carve_anywhere(const TerrainSource& terrain, Random& random) {
  const auto along = [&] { return (2.0F * random.unit() - 1.0F) * half_width_m; };
  const float x = along(), z = along();
  return blow_at(terrain, x, z, 8.0F, 8, random.next());
}

}  // namespace

/// As a server that records, and whose file takes no terrain: the world, and the published state twice, which
/// share their bricks.
BenchReport run_memory_bench(const BenchOptions& options) {
  const int edits = options.quick ? 600 : 5000;
  WorldConfig config;
  config.memory_max_mb = memory_max_mb;
  World world(config);
  world.field().page_by([](ChunkCoord) { return fail("there is no file"); });
  PublishedState published, recorded;
  Random random(9);
  double most_mb = 0.0, most_model_mb = 0.0;
  int accepted = 0, refused = 0, asked = 0;
  const auto take = [&](const TickDelta& delta) {
    published.apply(delta);
    recorded.apply(delta);
    for (const Reply& reply : delta.replies) (reply.refusal.empty() ? accepted : refused) += 1;
  };
  for (int edit = 0; edit < edits; ++edit) {
    most_model_mb = used_bytes(memory_of(world.field()), memory_max_mb) / mb;
    if (most_model_mb > memory_max_mb * (1.0 - limits::merge_memory_share))
      break;  // a server refuses from here on
    ++asked;
    take(*world.step({{{0, static_cast<uint32_t>(edit), carve_anywhere(config.terrain, random)}}}));
    for (int tick = 0; tick < 4; ++tick) take(*world.step({}));
    most_mb = std::max(most_mb, resident_mb());
    if (edit % 50 == 0) options.progress(static_cast<double>(edit) / edits);
  }
  for (int tick = 0; tick < 1200; ++tick) {
    const auto delta = world.step({});
    take(*delta);
    if (delta->pieces.empty() && accepted + refused == asked) break;
  }
  most_mb = std::max(most_mb, resident_mb());
  BenchReport report;
  report.metric("edits", asked);
  report.metric("accepted", accepted);
  report.metric("refused", refused);
  report.metric("resident_most_mb", most_mb);
  report.metric("model_most_mb", most_model_mb);
  report.metric("edited_bricks", static_cast<double>(world.field().edited_brick_count()));
  report.check("resident_most_mb", most_mb <= memory_max_mb,
               fmt::format("{:.0f}, at most {}", most_mb, memory_max_mb));
  report.check("asked", asked == edits, fmt::format("{} edits before the limit, wanted {}", asked, edits));
  report.check("answered", accepted + refused == asked, fmt::format("{} of {}", accepted + refused, asked));
  return report;
}

}  // namespace scree
