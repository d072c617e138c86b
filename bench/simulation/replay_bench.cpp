// The cost of writing recordings, and the speed of reading them. It measures ticks with and without
// recording, bytes of a minute, and keyframes of a world of 10,000 edited chunks. It seeks in and verifies a
// long session of eight bots.
#include <algorithm>
#include <fmt/format.h>
#include <thread>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/support/scratch.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/database.h"
#include "server/store/recorder.h"
#include "shared/base/check.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr double ratio_wanted = 1.02;
constexpr double seek_wanted_ms = 100.0;
constexpr double pause_wanted_ms = 1.0;
constexpr double verify_wanted = 20.0;
constexpr Tick ticks_per_minute = 3600;
constexpr Tick ticks_per_commit = 30;
constexpr Tick ticks_per_carve = 6;  ///< of a storm: ten a second
constexpr double default_minutes = 6.0;
constexpr double mb = 1e6;

/// Two worlds of the same storm, in turns and in real time: one is recorded. Who comes first changes each
/// tick.
void compare_ticks(BenchReport& report, const ScratchFolder& folder, Tick ticks) {
  World plain{WorldConfig()}, recorded{WorldConfig()};
  const auto recorder = Recorder::create(folder / "ticks", {"bench", WorldConfig()});
  CHECK(recorder.has_value());
  std::vector<double> plain_ms, recorded_ms, push_ms;
  const auto step = [&](World& world, std::vector<double>& ms, const std::vector<Command>& commands,
                        bool records) {
    const double before_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    const auto delta = world.step(commands);
    const double stepped_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    if (records) (*recorder)->push(delta, commands);
    const double done_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    if (records) push_ms.push_back((done_s - stepped_s) * 1e3);
    ms.push_back((done_s - before_s) * 1e3);
  };
  ScatteredBlows blows(WorldConfig().terrain, 12.0F, 1.5F, 24, 5);
  uint32_t carves = 0;
  double due_s = steady_now_s();
  for (Tick tick = 0; tick < ticks; ++tick, due_s += 1.0 / 60.0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(due_s - steady_now_s()));
    std::vector<Command> commands;
    if (tick % ticks_per_carve == 0) commands.push_back({0, ++carves, blows.next()});
    if (tick % 2 == 0) step(plain, plain_ms, commands, false);
    step(recorded, recorded_ms, commands, true);
    if (tick % 2 == 1) step(plain, plain_ms, commands, false);
  }
  const double p99 = quantile(plain_ms, 0.99), p99_recorded = quantile(recorded_ms, 0.99);
  report.metric("tick_p99_without_cpu_ms", p99);
  report.metric("tick_p99_cpu_ms", p99_recorded);
  report.metric("tick_median_without_cpu_ms", quantile(plain_ms, 0.5));
  report.metric("tick_median_cpu_ms", quantile(recorded_ms, 0.5));
  report.metric("push_p99_cpu_ms", quantile(push_ms, 0.99));
  report.metric("push_waits", static_cast<double>((*recorder)->waits()));
  CHECK((*recorder)->finish().has_value());
  report.check("tick_ratio", p99_recorded <= ratio_wanted * p99,
               fmt::format("p99 {:.3f} ms of processor time, {:.3f} without: {:.3f}, wanted at most {}",
                           p99_recorded, p99, p99_recorded / p99, ratio_wanted));
}

/// Bytes of the keyframes that earlier releases wrote: whole ones each 10 s, and each second what changed
/// since.
class WholeKeyframes {
 public:
  void add(const TickDelta& delta) {
    published_.apply(delta);
    for (const BrickState& brick : delta.bricks) changed_.insert(brick.coord);
    if (delta.tick % 600 == 0) {
      bytes_ += encode(to_recorded_keyframe(published_.as_delta())).size();
      changed_.clear();
    } else if (delta.tick % 60 == 0 && (!changed_.empty() || !published_.pieces().empty())) {
      bytes_ += encode(to_recorded_keyframe(published_.as_delta(changed_))).size();
    }
  }
  double bytes() const { return static_cast<double>(bytes_); }

 private:
  PublishedState published_;
  std::set<BrickCoord> changed_;
  size_t bytes_ = 0;
};

/// A minute without requests, and one of a storm.
void weigh_minutes(BenchReport& report, const ScratchFolder& folder, Tick ticks) {
  for (const bool storm : {false, true}) {
    const std::string name = storm ? "storm" : "idle";
    auto writer = RecordingWriter::create(folder / name, {"bench", WorldConfig()});
    CHECK(writer.has_value());
    World world{WorldConfig()};
    WholeKeyframes whole;
    ScatteredBlows blows(WorldConfig().terrain, 12.0F, 1.5F, 24, 5);
    uint32_t carves = 0;
    for (Tick tick = 1; tick <= ticks; ++tick) {
      std::vector<Command> commands;
      if (storm && tick % ticks_per_carve == 0) commands.push_back({0, ++carves, blows.next()});
      const auto delta = world.step(commands);
      CHECK((*writer)->add(*delta, commands).has_value());
      whole.add(*delta);
      if (tick % ticks_per_commit == 0) CHECK((*writer)->commit().has_value());
    }
    CHECK((*writer)->finish().has_value());
    const double minutes = static_cast<double>(ticks) / ticks_per_minute;
    const auto bytes = static_cast<double>(std::filesystem::file_size(folder / name));
    report.metric(name + "_mb_a_minute", bytes / mb / minutes);
    auto database = Database::open(folder / name);
    CHECK(database.has_value());
    double keyframe_bytes = 0.0;
    for (const char* table : {"frames", "keyframe_states", "keyframe_chunks", "keyframe_pieces"}) {
      const auto sum = database->number("SELECT sum(length(data)) FROM " + std::string(table));
      CHECK(sum.has_value());
      const auto sum_bytes = static_cast<double>(sum->value_or(0));
      if (table != std::string_view("frames")) keyframe_bytes += sum_bytes;
      report.metric(fmt::format("{}_{}_mb_a_minute", name, table), sum_bytes / mb / minutes);
    }
    report.metric(name + "_keyframes_mb_a_minute", keyframe_bytes / mb / minutes);
    report.metric(name + "_whole_keyframes_mb_a_minute", whole.bytes() / mb / minutes);
  }
}

/// A world with so many edited chunks, some bricks of each edited, without a simulation.
std::unique_ptr<World> wide_world(int chunks_a_side) {
  World fresh{WorldConfig()};
  WorldSnapshot value = fresh.snapshot();
  const TerrainSource& terrain = value.moment.config.terrain;
  MapField field(terrain);
  const float chunk_m = terrain.voxel_size_m * chunk_size;
  for (int x = 0; x < chunks_a_side; ++x)
    for (int z = 0; z < chunks_a_side; ++z) {
      const float x_m = (static_cast<float>(x - chunks_a_side / 2) + 0.5F) * chunk_m;
      const float z_m = (static_cast<float>(z - chunks_a_side / 2) + 0.5F) * chunk_m;
      const auto voxel = [&](float m) { return floor_to_int(m / terrain.voxel_size_m); };
      const BrickCoord middle = brick_of({voxel(x_m), voxel(ground_height_m(terrain, x_m, z_m)), voxel(z_m)});
      for (int i = 0; i < 4; ++i) {
        const BrickCoord coord{middle.x + (i & 1), middle.y, middle.z + (i >> 1)};
        Brick brick = field.brick(coord);
        for (size_t v = 0; v < brick.codes.size(); v += 7)
          if (brick.codes[v] > code_solid / 2 && brick.codes[v] < code_air / 2)
            brick.codes[v] = static_cast<Code>(brick.codes[v] + 9);
        value.bricks.push_back({coord, brick, {}});
      }
    }
  std::ranges::sort(value.bricks, {}, &BrickPatch::coord);
  auto world = World::salvage(std::move(value));
  CHECK(world.has_value());
  return std::move(*world);
}

/// How long the simulation's thread is held up by its recorder, keyframes and parts of a ring, in a large
/// world that is carved. The ticks come in real time.
void pause(BenchReport& report, const ScratchFolder& folder, int chunks_a_side, Tick ticks) {
  const std::unique_ptr<World> world = wide_world(chunks_a_side);
  const size_t chunks = world->field().edited_chunks().size();
  Stopwatch stopwatch;
  auto recorder =
      Recorder::create(folder / "wide", {"bench", world->config()}, {world->moment(), world->keyframe()});
  CHECK(recorder.has_value());
  (*recorder)->commit_up_to(world->tick());
  report.metric("wide_chunks", static_cast<double>(chunks));
  report.metric("wide_begin_s", stopwatch.lap_ms() * 1e-3);
  ScatteredBlows blows(world->config().terrain, 24.0F, 1.5F, 24, 9);
  std::vector<double> push_ms, cpu_ms, part_ms;
  double due_s = steady_now_s();
  for (Tick tick = 1; tick <= ticks; ++tick, due_s += 1.0 / 60.0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(due_s - steady_now_s()));
    std::vector<Command> commands;
    if (tick % ticks_per_carve == 0) commands.push_back({0, static_cast<uint32_t>(tick), blows.next()});
    const auto delta = world->step(commands);
    std::shared_ptr<const WorldMoment> part;
    if (tick % (ticks / 4) == 0) {
      const double before_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
      world->renew();
      part = std::make_shared<const WorldMoment>(world->moment());
      part_ms.push_back((cpu_s(CLOCK_THREAD_CPUTIME_ID) - before_s) * 1e3);
      report.metric(fmt::format("part_{}_pieces", part_ms.size()), static_cast<double>(delta->pieces.size()));
    }
    const double before_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    stopwatch.lap_ms();
    (*recorder)->push(delta, std::move(commands), {}, std::move(part));
    push_ms.push_back(stopwatch.lap_ms());
    cpu_ms.push_back((cpu_s(CLOCK_THREAD_CPUTIME_ID) - before_s) * 1e3);
  }
  CHECK_EQ((*recorder)->waits(), 0U);
  CHECK((*recorder)->finish().has_value());
  report.metric("wide_push_worst_ms", quantile(push_ms, 1.0));
  report.metric("wide_push_p99_ms", quantile(push_ms, 0.99));
  report.metric("wide_part_worst_cpu_ms", quantile(part_ms, 1.0));
  const double worst_ms = quantile(cpu_ms, 1.0);
  report.check(
      "keyframe_pause", worst_ms <= pause_wanted_ms,
      fmt::format(
          "{:.3f} ms of processor time at most, {:.3f} ms of the clock, in {} edited chunks; wanted at "
          "most {} ms",
          worst_ms, quantile(push_ms, 1.0), chunks, pause_wanted_ms));
}

/// What eight persons ask for who walk about, each on a circle of their own.
class Bots {
 public:
  explicit Bots(const TerrainSource& terrain) : terrain_(terrain) {}

  std::vector<Command> at(Tick tick) {
    std::vector<Command> commands;
    for (uint64_t bot = 0; bot < bots; ++bot) {
      if ((tick + bot * 31) % ticks_per_request != 0) continue;
      const float turn = static_cast<float>(tick) * 2e-4F + static_cast<float>(bot) * 0.8F;
      const float x_m = 45.0F * std::cos(turn) + random_.unit() * 8.0F;
      const float z_m = 45.0F * std::sin(turn * 1.3F) + random_.unit() * 8.0F;
      CarveRequest blow = blow_at(terrain_, x_m, z_m, 0.8F + random_.unit(), 16, random_.next());
      const Shape shape = blow.shape;
      Command command{bot + 1, ++asked_, std::move(blow)};
      if (asked_ % 7 == 0) command.body = FillRequest{shape};
      commands.push_back(std::move(command));
    }
    return commands;
  }

 private:
  static constexpr uint64_t bots = 8;
  static constexpr Tick ticks_per_request = 240;  ///< of one of them: 4 s
  TerrainSource terrain_;
  Random random_{8};
  uint32_t asked_ = 0;
};

/// Recorded as fast as it goes; the field's hash after each tick.
std::vector<uint64_t> record_session(BenchReport& report, const std::string& path, Tick ticks,
                                     const std::function<void(double)>& progress) {
  auto writer = RecordingWriter::create(path, {"bench", WorldConfig()});
  CHECK(writer.has_value());
  World world{WorldConfig()};
  Bots bots(WorldConfig().terrain);
  std::vector<uint64_t> hashes;
  Stopwatch stopwatch;
  for (Tick tick = 1; tick <= ticks; ++tick) {
    const std::vector<Command> commands = bots.at(tick);
    const auto delta = world.step(commands);
    hashes.push_back(delta->field_hash);
    CHECK((*writer)->add(*delta, commands).has_value());
    if (tick % ticks_per_commit == 0) CHECK((*writer)->commit().has_value());
    if (tick % 600 == 0) progress(static_cast<double>(tick) / static_cast<double>(ticks));
  }
  CHECK((*writer)->finish().has_value());
  const double minutes = static_cast<double>(ticks) / ticks_per_minute;
  report.metric("session_minutes", minutes);
  report.metric("session_wall_s", stopwatch.lap_ms() * 1e-3);
  report.metric("session_edited_chunks", static_cast<double>(world.field().edited_chunks().size()));
  report.metric("session_mb_a_minute", static_cast<double>(std::filesystem::file_size(path)) / mb / minutes);
  return hashes;
}

void seek(BenchReport& report, const std::string& path, const std::vector<uint64_t>& hashes, size_t seeks) {
  auto source = ReplaySource::open(path);
  CHECK(source.has_value());
  Random random(3);
  std::vector<double> wall_ms, cpu_ms;
  size_t wrong = 0;
  for (size_t i = 0; i < seeks; ++i) {
    const Tick to = 1 + random.below(static_cast<uint32_t>(hashes.size()));
    Stopwatch stopwatch;
    const double before_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    const auto jumped = (*source)->jump(to);
    cpu_ms.push_back((cpu_s(CLOCK_THREAD_CPUTIME_ID) - before_s) * 1e3);
    wall_ms.push_back(stopwatch.lap_ms());
    if (!jumped || (*jumped)->field_hash != hashes[to - 1]) ++wrong;
  }
  report.metric("seek_median_ms", quantile(wall_ms, 0.5));
  report.metric("seek_p99_cpu_ms", quantile(cpu_ms, 0.99));
  const double p99_ms = quantile(wall_ms, 0.99);
  report.check("seek_p99", p99_ms <= seek_wanted_ms,
               fmt::format("{:.1f} ms of the clock, {:.1f} ms of processor time; wanted at most {} ms",
                           p99_ms, quantile(cpu_ms, 0.99), seek_wanted_ms));
  report.check("seek_hashes", wrong == 0,
               fmt::format("{} of {} random seeks gave another hash", wrong, seeks));
}

void verify_session(BenchReport& report, const std::string& path,
                    const std::function<void(double)>& progress) {
  const auto reader = RecordingReader::open(path);
  CHECK(reader.has_value());
  const double before_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
  const auto verified = verify(
      **reader, [&](Tick done, Tick all) { progress(static_cast<double>(done) / static_cast<double>(all)); });
  CHECK(verified.has_value());
  const double busy_s = cpu_s(CLOCK_THREAD_CPUTIME_ID) - before_s;
  const double session_s = static_cast<double>(verified->ticks) / 60.0;
  report.check("verify_agrees", verified->agrees(), verified->difference);
  report.check(
      "verify_speed", session_s / busy_s >= verify_wanted,
      fmt::format("{:.0f} times real time by processor time, {:.0f} by the clock; wanted at least {}",
                  session_s / busy_s, session_s / verified->seconds, verify_wanted));
}

}  // namespace

BenchReport run_replay_bench(const BenchOptions& options) {
  BenchReport report;
  const ScratchFolder folder("replay");
  const double minutes = options.minutes > 0.0 ? options.minutes : (options.quick ? 0.2 : default_minutes);
  const auto part = [&](double from, double to) {
    return [&options, from, to](double done) { options.progress(from + (to - from) * done); };
  };
  compare_ticks(report, folder, options.quick ? 120 : 1800);
  part(0.0, 0.1)(1.0);
  weigh_minutes(report, folder, options.quick ? 300 : ticks_per_minute);
  part(0.0, 0.2)(1.0);
  pause(report, folder, options.quick ? 20 : 100, options.quick ? 240 : 1200);
  part(0.0, 0.3)(1.0);
  const auto hashes = record_session(report, folder / "session",
                                     static_cast<Tick>(minutes * ticks_per_minute), part(0.3, 0.6));
  seek(report, folder / "session", hashes, options.quick ? 50 : 1000);
  verify_session(report, folder / "session", part(0.7, 1.0));
  return report;
}

}  // namespace scree
