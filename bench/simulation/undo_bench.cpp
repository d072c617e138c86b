#include <algorithm>
#include <fmt/format.h>
#include <future>
#include <map>

#include "bench/support/benches.h"
#include "bench/support/blow_scenes.h"
#include "bench/support/scenes.h"
#include "bench/support/scratch.h"
#include "server/history/edit_history.h"
#include "server/work/limits.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr double remember_share_max = 0.03, undo_tick_max_ms = 16.6;
constexpr uint64_t undo_persons = 10, undo_vandal = 7;

/// A world, its history, and all commands that it got.
class Remembered {
 public:
  Remembered(const WorldConfig& config, const std::string& path) : world_(config, 1) {
    world_.want_replaced(true);
    auto opened = EditHistory::open({.path = path,
                                     .world = 1,
                                     .tick = 0,
                                     .tick_rate_hz = config.tick_rate_hz,
                                     .voxel_size_m = config.terrain.voxel_size_m});
    CHECK(opened.has_value());
    history_ = std::move(*opened);
    for (uint64_t session = 1; session <= undo_persons; ++session)
      history_->joined({.session = session, .name = fmt::format("person {}", session)});
  }

  std::shared_ptr<const TickDelta> step(std::vector<Command> commands = {}) {
    for (Command& command : history_->due()) commands.push_back(std::move(command));
    const double begin_ms = 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID);
    auto delta = world_.step(commands);
    tick_ms = 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID) - begin_ms;
    history_->note(delta);
    steps_.push_back(std::move(commands));
    hashes_.push_back(delta->state_hash);
    return delta;
  }
  void settle() {
    for (int i = 0; i < 6000; ++i) {
      const auto delta = step();
      if (delta->pieces.empty() && delta->work.requests_waiting == 0) return;
    }
  }
  Result<std::string> ask(const UndoRequest& request) {
    std::promise<Result<std::string>> said;
    history_->ask(request, "the bench", [&](Result<std::string> text) { said.set_value(std::move(text)); });
    return said.get_future().get();
  }
  bool undo_goes_on() {
    const auto said = ask({.mode = UndoMode::progress, .as_json = true});
    return said && said->find("\"over\":false") != std::string::npos;
  }
  /// Whether a world without a history, which gets the same commands, has the same hashes.
  bool repeats(const WorldConfig& config) const {
    World again(config, 1);
    for (size_t i = 0; i < steps_.size(); ++i)
      if (again.step(steps_[i])->state_hash != hashes_[i]) return false;
    return true;
  }
  std::map<BrickCoord, uint64_t> bricks() const {
    std::map<BrickCoord, uint64_t> all;
    for (const ChunkCoord chunk : world_.field().edited_chunks())
      for (const BrickCoord coord : world_.field().edited_bricks(chunk)) {
        const Brick codes = world_.field().brick(coord);
        all[coord] = brick_hash(coord, codes, world_.field().materials(coord));
      }
    return all;
  }
  World& world() { return world_; }
  uint64_t history_bytes() const { return history_->status().bytes; }

  double tick_ms = 0.0;

 private:
  World world_;
  std::unique_ptr<EditHistory> history_;
  std::vector<std::vector<Command>> steps_;
  std::vector<uint64_t> hashes_;
};

/// What remembering costs the simulation's thread: two worlds with the same blows, in turns.
void measure_remembering(const BenchOptions& options, const ScratchFolder& scratch, BenchReport& report) {
  WorldConfig config;
  Remembered remembered(config, scratch / "storm.history");
  World plain(config, 1);
  ScatteredBlows blows(config.terrain, 24.0F, 1.8F, 40, 1);
  double with_ms = 0.0, without_ms = 0.0;
  const Tick ticks = options.quick ? 300 : 1200;
  for (Tick tick = 0; tick < ticks; ++tick) {
    std::vector<Command> commands;
    if (tick % 6 == 0) commands.push_back({1, static_cast<uint32_t>(tick + 1), blows.next()});
    const double begin_ms = 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID);
    remembered.step(commands);
    const double middle_ms = 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID);
    plain.step(commands);
    with_ms += middle_ms - begin_ms;
    without_ms += 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID) - middle_ms;
    options.progress(0.3 * static_cast<double>(tick) / static_cast<double>(ticks));
  }
  const double ratio = with_ms / without_ms;
  report.metric("remember_over_plain", ratio);
  report.metric("history_kb_a_blow", static_cast<double>(remembered.history_bytes()) / 1024.0 /
                                         static_cast<double>((ticks + 5) / 6));
  report.check("remembering", ratio <= 1.0 + remember_share_max,
               fmt::format("a tick with a history takes {:.3f} of one without, at most {:.2f}", ratio,
                           1.0 + remember_share_max));
}

/// Ten persons edit a field, one of them is a vandal.
void measure_crowd(const BenchOptions& options, const ScratchFolder& scratch, BenchReport& report) {
  const WorldConfig config;
  Remembered crowd(config, scratch / "crowd.history");
  Random random(5);
  const int edits = options.quick ? 600 : 3000;
  for (int i = 0; i < edits; ++i) {
    const uint64_t session = 1 + static_cast<uint64_t>(i) % undo_persons;
    const auto spread = [&] { return static_cast<float>(random.below(1200)) * 0.25F - 150.0F; };
    const float x = spread(), z = spread();
    Request request = FillRequest{box({x, 1.0F, z}, {1.0F, 1.0F, 1.0F})};
    if (i % 3 != 0) {
      CarveRequest carve;
      carve.shape = sphere({x, 0.0F, z}, 1.0F);
      carve.seeds = 4;
      request = carve;
    }
    crowd.step({{session, static_cast<uint32_t>(i + 1), std::move(request)}});
    options.progress(0.3 + 0.3 * i / edits);
  }
  crowd.settle();
  const auto before = crowd.bricks();
  const auto begun = crowd.ask({.mode = UndoMode::keep_others, .by = fmt::format("person {}", undo_vandal)});
  while (begun && crowd.undo_goes_on()) crowd.step();
  crowd.settle();
  size_t changed = 0;
  for (const auto& [coord, hash] : crowd.bricks())
    changed += before.contains(coord) && before.at(coord) != hash;
  const Ledger& ledger = crowd.world().ledger();
  report.metric("crowd_bricks", static_cast<double>(before.size()));
  report.metric("crowd_bricks_changed_by_undo", static_cast<double>(changed));
  report.check("crowd", begun && changed > 0 && changed < before.size() / 3,
               begun ? fmt::format("of {} bricks that {} edits of {} persons changed, {} went back",
                                   before.size(), edits, undo_persons, changed)
                     : begun.error().message);
  report.check("crowd_ledger", ledger.error() == 0 && crowd.world().measure_terrain() == ledger.terrain,
               fmt::format("the ledger's error is {}, and the terrain weighs what it says", ledger.error()));
  report.check("crowd_repeats", crowd.repeats(config), "the same commands give the same hash at every tick");
}

/// A vandal who built some hundred thousand bricks.
void measure_large(const BenchOptions& options, const ScratchFolder& scratch, BenchReport& report) {
  WorldConfig config;
  Remembered large(config, scratch / "large.history");
  const int side = options.quick ? 3 : 14;
  uint32_t request = 0;
  for (int x = 0; x < side; ++x)
    for (int z = 0; z < side; ++z) {
      const glm::vec3 at{static_cast<float>(x) * 20.0F, 6.0F, static_cast<float>(z) * 20.0F};
      const glm::vec3 half_m(limits::edit_reach_max_m);
      large.step({{undo_vandal, ++request, FillRequest{box(at, half_m)}}});
      for (int i = 0; i < 10; ++i) large.step();
    }
  large.settle();
  const auto before = large.bricks();
  const auto begun = large.ask({.mode = UndoMode::refuse_conflicts, .by = "person 7"});
  std::vector<double> ticks_ms;
  while (begun && large.undo_goes_on()) {
    large.step();
    ticks_ms.push_back(large.tick_ms);
    options.progress(0.6 + 0.4 * (1.0 - 1.0 / (1.0 + static_cast<double>(ticks_ms.size()) / 500.0)));
  }
  std::ranges::sort(ticks_ms);
  const auto at = [&](double share) {
    return ticks_ms.empty() ? 0.0
                            : ticks_ms[static_cast<size_t>(share * static_cast<double>(ticks_ms.size() - 1))];
  };
  report.metric("large_bricks", static_cast<double>(before.size()));
  report.metric("large_ticks", static_cast<double>(ticks_ms.size()));
  report.metric("large_tick_median_ms", at(0.5));
  report.metric("large_tick_p99_ms", at(0.99));
  report.metric("large_tick_max_ms", at(1.0));
  report.check(
      "large", begun && large.world().ledger().terrain == 0 && at(1.0) <= undo_tick_max_ms,
      begun ? fmt::format("{} bricks go back in {} ticks of {:.1f} ms at most (wanted {}), {:.1f} ms usually",
                          before.size(), ticks_ms.size(), at(1.0), undo_tick_max_ms, at(0.5))
            : begun.error().message);
}

}  // namespace

BenchReport run_undo_bench(const BenchOptions& options) {
  BenchReport report;
  const ScratchFolder scratch("undo");
  measure_remembering(options, scratch, report);
  measure_crowd(options, scratch, report);
  measure_large(options, scratch, report);
  return report;
}

}  // namespace scree
