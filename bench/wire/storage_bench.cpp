// What keeping a world costs: ticks with and without saving, bytes, a save with 1,000 pieces alive, and how
// long a start takes after so many carves.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

#include "bench/support/benches.h"
#include "bench/support/carved_world.h"
#include "bench/support/scenes.h"
#include "bench/support/scratch.h"
#include "bench/wire/paged_world.h"
#include "server/app/live_server.h"
#include "server/app/saved_world.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr double ratio_wanted = 1.05;
constexpr double start_wanted_s = 2.0;
constexpr Tick ticks_per_carve = 6;  ///< ten a second
constexpr uint64_t world_number = 1;
constexpr uint32_t read_whole_carves_max = 100000;  ///< a larger world takes gigabytes of memory

/// A world that is saved, or not, and what its ticks took of the simulation's thread.
struct Run {
  std::unique_ptr<SavedWorld> saved_world;  ///< null: not saved
  std::unique_ptr<World> world;
  std::vector<double> wall_ms, cpu_ms;
  uint64_t state_hash = 0;

  void step(std::span<const Command> commands) {
    Stopwatch stopwatch;
    const double before_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    const auto delta = world->step(commands);
    if (saved_world) saved_world->note(*delta, *world);
    cpu_ms.push_back((cpu_s(CLOCK_THREAD_CPUTIME_ID) - before_s) * 1e3);
    wall_ms.push_back(stopwatch.lap_ms());
    state_hash = delta->state_hash;
  }
};

Run unsaved_run() {
  Run run;
  run.world = std::make_unique<World>(WorldConfig());
  return run;
}

Run saved_run(const std::string& path, Durability durability) {
  Run run;
  auto saved_world = SavedWorld::open(path, WorldConfig(), 1, {});
  CHECK(saved_world.has_value());
  run.saved_world = std::move(*saved_world);
  run.world = run.saved_world->release_world();
  const Result<void> started =
      run.saved_world->start(*run.world, {.durability = durability, .before_save = {}});
  CHECK(started.has_value());
  return run;
}

/// The same storm in two worlds, in turns and in real time: one is saved. Who comes first changes each tick.
void compare_ticks(BenchReport& report, const ScratchFolder& folder, Durability durability, Tick ticks) {
  const std::string name(row_of(durability).name), path = folder / name;
  Run plain = unsaved_run(), saved = saved_run(path, durability);
  ScatteredBlows blows(WorldConfig().terrain, 12.0F, 1.5F, 24, 5);
  uint64_t carves = 0;
  double due_s = steady_now_s();
  for (Tick tick = 0; tick < ticks; ++tick, due_s += 1.0 / 60.0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(due_s - steady_now_s()));
    std::vector<Command> commands;
    if (tick % ticks_per_carve == 0) commands.push_back({0, static_cast<uint32_t>(++carves), blows.next()});
    (tick % 2 == 0 ? plain : saved).step(commands);
    (tick % 2 == 0 ? saved : plain).step(commands);
  }
  const SaverStatus status = saved.saved_world->status();
  CHECK(saved.saved_world->finish(*saved.world).has_value());
  const double bytes = static_cast<double>(saved.saved_world->status().bytes_written);
  const double p99 = quantile(plain.cpu_ms, 0.99), p99_saved = quantile(saved.cpu_ms, 0.99);
  report.metric(name + "_tick_p99_without_cpu_ms", p99);
  report.metric(name + "_tick_p99_cpu_ms", p99_saved);
  report.metric(name + "_tick_p99_without_wall_ms", quantile(plain.wall_ms, 0.99));
  report.metric(name + "_tick_p99_wall_ms", quantile(saved.wall_ms, 0.99));
  report.metric(name + "_tick_median_without_cpu_ms", quantile(plain.cpu_ms, 0.5));
  report.metric(name + "_tick_median_cpu_ms", quantile(saved.cpu_ms, 0.5));
  report.metric(name + "_saves", static_cast<double>(status.saves));
  report.metric(name + "_saves_skipped", static_cast<double>(status.skipped));
  report.metric(name + "_save_worst_ms", status.save_worst_ms);
  report.metric(name + "_written_bytes_per_carve", bytes / static_cast<double>(carves));
  report.metric(name + "_file_bytes_per_carve",
                static_cast<double>(fs::file_size(path)) / static_cast<double>(carves));
  report.check(name + "_ratio", p99_saved <= ratio_wanted * p99,
               fmt::format("p99 {:.3f} ms, {:.3f} without: {:.3f}, wanted at most {}", p99_saved, p99,
                           p99_saved / p99, ratio_wanted));
  report.check(name + "_same_world", plain.state_hash == saved.state_hash, "hashes after the last tick");
}

/// Every tick writes how each body moves: what that takes with 1,000 of them.
void save_a_crowd(BenchReport& report, const ScratchFolder& folder) {
  WorldConfig config;
  config.methods.recombine = Recombination::off;
  World world(config);
  BlowGrid blows(config.terrain, 4, 4.5F, 2.0F, 80);
  while (const auto blow = blows.next()) {
    const Command command{0, 0, *blow};
    world.step({&command, 1});
  }
  for (int i = 0; i < 60; ++i) world.step({});
  const WorldSnapshot value = world.snapshot();
  WorldHeader header{.world = world_number, .config = value.moment.config};
  const auto file = WorldFile::create(folder / "crowd", header, value);
  CHECK(file.has_value() && (*file)->read().has_value());
  std::vector<double> moment_ms, encode_ms, save_ms;
  size_t bytes = 0;
  for (int i = 0; i < 40; ++i) {
    Stopwatch stopwatch;
    const WorldMoment moment = world.moment();
    moment_ms.push_back(stopwatch.lap_ms());
    bytes = encode(moment).size();
    encode_ms.push_back(stopwatch.lap_ms());
    CHECK((*file)->save(moment, {}).has_value());
    save_ms.push_back(stopwatch.lap_ms());
    world.step({});
  }
  report.metric("crowd_alive", static_cast<double>(value.moment.pieces.size()));
  report.metric("crowd_moment_ms", quantile(moment_ms, 0.5));
  report.metric("crowd_encode_ms", quantile(encode_ms, 0.5));
  report.metric("crowd_save_ms", quantile(save_ms, 0.5));
  report.metric("crowd_bytes_per_tick", static_cast<double>(bytes));
}

/// Reads the file with the ground measured, as it would be unless the rows said its mass.
void read_whole(BenchReport& report, const std::string& path, const std::string& name) {
  const auto file = WorldFile::open(path);
  CHECK(file.has_value());
  Stopwatch stopwatch;
  const auto rows = (*file)->read();
  CHECK(rows.has_value());
  report.metric(name + "read_s", stopwatch.lap_ms() * 1e-3);
  CHECK(World::restore(rows->world, 1, rows->ground).has_value());
  report.metric(name + "restore_s", stopwatch.lap_ms() * 1e-3);
  CHECK(World::restore(rows->world).has_value());
  report.metric(name + "restore_measuring_ground_s", stopwatch.lap_ms() * 1e-3);
}

/// Starts a server on a world of so many carves.
void start_up(BenchReport& report, const std::string& path, uint32_t carves_a_side) {
  const uint32_t carves = carves_a_side * carves_a_side;
  const std::string name = fmt::format("start_{}_", carves);
  if (!fs::exists(path)) {
    Stopwatch making;
    CHECK(write_carved_world(path, {.config = {}, .carves_a_side = carves_a_side}).has_value());
    report.metric(name + "made_s", making.lap_ms() * 1e-3);
  }
  report.metric(name + "file_mb", static_cast<double>(fs::file_size(path)) / 1e6);
  if (carves <= read_whole_carves_max) read_whole(report, path, name);

  LiveConfig config;
  config.world_path = path;
  config.net.port = 0;
  config.pacing = Pacing::by_hand;
  Stopwatch stopwatch;
  const double before_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID);
  const auto server = LiveServer::start(config);
  const double wall_s = stopwatch.lap_ms() * 1e-3, busy_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID) - before_s;
  CHECK(server.has_value());
  report.metric(name + "wall_s", wall_s);
  report.metric(name + "cpu_s", busy_s);
  CHECK((*server)->step_once());
  const PagerStatus paging = (*server)->report().paging;
  report.metric(name + "chunks", static_cast<double>(paging.chunks_in + paging.chunks_out));
  report.metric(name + "chunks_in_memory", static_cast<double>(paging.chunks_in));
  if (carves == 10000)
    report.check("start_at_10000", busy_s <= start_wanted_s,
                 fmt::format("{:.2f} s of processor time, {:.2f} s of the clock; wanted at most {} s", busy_s,
                             wall_s, start_wanted_s));
}

/// The file of a world that takes long to make: in the folder where it is kept, if there is one.
std::string world_on_disk(const BenchOptions& options, const ScratchFolder& folder, const std::string& name) {
  if (options.folder.empty()) return folder / name;
  fs::create_directories(options.folder);
  return (fs::path(options.folder) / name).string();
}

void roam(BenchReport& report, const BenchOptions& options, const ScratchFolder& folder) {
  const uint32_t world_mb = options.world_mb.value_or(options.quick ? 64 : 4096);
  const uint32_t memory_max_mb = options.memory_max_mb.value_or(options.quick ? 256 : 512);
  const std::string name = fmt::format("paged_{}_of_{}", memory_max_mb, world_mb);
  roam_a_paged_world(report, {.made = world_on_disk(options, folder, name),
                              .roamed = world_on_disk(options, folder, name + "_roamed"),
                              .world_mb = world_mb,
                              .memory_max_mb = memory_max_mb,
                              .seconds = options.quick ? 5.0 : 60.0});
}

}  // namespace

BenchReport run_storage_bench(const BenchOptions& options) {
  BenchReport report;
  const ScratchFolder folder("storage");
  const auto wanted = [&](const char* part) { return options.part.empty() || options.part == part; };
  constexpr std::array durabilities = {Durability::tick, Durability::second, Durability::off};
  double done = 0.0;
  for (const Durability durability : durabilities) {
    if (wanted("ticks")) compare_ticks(report, folder, durability, options.quick ? 120 : 1800);
    options.progress(done += 0.2);
  }
  if (wanted("crowd")) save_a_crowd(report, folder);
  for (const uint32_t carves_a_side : {4U, 32U, 100U, 316U})
    if (wanted("start") && (!options.quick || carves_a_side <= 32))
      start_up(report, folder / fmt::format("start_{}", carves_a_side), carves_a_side);
  options.progress(0.7);
  if (options.part == "million") start_up(report, world_on_disk(options, folder, "million"), 1000);
  if (wanted("roam")) roam(report, options, folder);
  options.progress(1.0);
  return report;
}

}  // namespace scree
