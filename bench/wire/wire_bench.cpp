#include <algorithm>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "proto/codec.h"
#include "proto/operation_codec.h"

namespace scree {

namespace {

constexpr int ticks_to_settle_max = 3600;

/// Bytes of a tick's frame for a client that can apply every operation, without transforms.
size_t frame_bytes(const TickDelta& delta) {
  FrameMessage frame;
  frame.tick = delta.tick;
  for (const AppliedOperation& applied : delta.operations) frame.operations.push_back(applied.operation);
  frame.has_check = !delta.bricks.empty();
  frame.check = static_cast<uint32_t>(delta.field_hash);  // as many bytes as the true one
  return encode(ServerMessage(std::move(frame))).size();
}

size_t brick_bytes(const TickDelta& delta) {
  std::vector<BrickView> bricks;
  for (const BrickState& state : delta.bricks) bricks.push_back({state.coord, state.brick.get()});
  return encode_bricks(std::span<const BrickView>(bricks)).size();
}

struct Seen {
  size_t merges = 0;
  size_t merge_bytes = 0;        ///< of the frames with merges in them
  size_t merge_bytes_worst = 0;  ///< a merge, at its frame's average
  size_t merge_brick_bytes = 0;
  bool settled = false;
};

Seen settle(World& world) {
  Seen seen;
  for (int i = 0; i < ticks_to_settle_max && !seen.settled; ++i) {
    const auto delta = world.step({});
    const auto merges =
        static_cast<size_t>(std::ranges::count_if(delta->operations, [](const AppliedOperation& o) {
          return std::holds_alternative<StampOperation>(o.operation);
        }));
    seen.settled = delta->pieces.empty();
    if (merges == 0) continue;
    seen.merges += merges;
    seen.merge_bytes += frame_bytes(*delta);
    seen.merge_bytes_worst = std::max(seen.merge_bytes_worst, (frame_bytes(*delta) + merges - 1) / merges);
    seen.merge_brick_bytes += brick_bytes(*delta);
  }
  return seen;
}

}  // namespace

BenchReport run_wire_bench(const BenchOptions& options) {
  WorldConfig config;
  World world(config);
  CarveRequest blow = blow_at(config.terrain, 20.0F, 20.0F, 2.0F, 64, 5);
  blow.pattern = SeedPattern::uniform;  // radial cells near the impact are so small that some join others
  const Command command{0, 1, blow};
  const auto carve = world.step({&command, 1});
  options.progress(0.5);
  const size_t carve_bytes = frame_bytes(*carve);
  const Seen seen = settle(world);
  options.progress(1.0);

  BenchReport report;
  report.metric("pieces", static_cast<double>(carve->spawned.size()));
  report.metric("carve_bytes", static_cast<double>(carve_bytes));
  report.metric("carve_as_bricks_bytes", static_cast<double>(brick_bytes(*carve)));
  report.metric("merges", static_cast<double>(seen.merges));
  report.metric("merge_mean_bytes", static_cast<double>(seen.merge_bytes) /
                                        static_cast<double>(std::max<size_t>(seen.merges, 1)));
  report.metric("merge_worst_bytes", static_cast<double>(seen.merge_bytes_worst));
  report.metric("merges_as_bricks_bytes", static_cast<double>(seen.merge_brick_bytes));
  report.check("pieces", carve->spawned.size() == 64, fmt::format("{}, wanted 64", carve->spawned.size()));
  report.check("carve", carve_bytes <= 200,
               fmt::format("{} bytes, frame and hash included, wanted at most 200", carve_bytes));
  report.check(
      "merges", seen.settled && seen.merges == carve->spawned.size() && seen.merge_bytes_worst <= 32,
      fmt::format("{} merges, the dearest {} bytes with its share of the frame, wanted all at most 32",
                  seen.merges, seen.merge_bytes_worst));
  return report;
}

}  // namespace scree
