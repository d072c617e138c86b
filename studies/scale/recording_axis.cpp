// Recordings of 1 minute to an hour of a session in which four bots carve, made as fast as it goes.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

#include "bench/support/scenes.h"
#include "bench/support/scratch.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/recording_writer.h"
#include "shared/base/quantile.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "studies/scale/axes.h"

namespace scree {

namespace {

constexpr Tick ticks_a_minute = 3600;
constexpr Tick ticks_a_commit = 30;
constexpr uint64_t session_bots = 4;
constexpr Tick ticks_a_request = 240;  ///< of one bot: 4 s
constexpr size_t seeks = 200;

/// Four persons who walk on circles of their own; one in seven of their requests fills.
std::vector<Command> asked_at(Tick tick, const TerrainSource& terrain, Random& random, uint32_t& asked) {
  std::vector<Command> commands;
  for (uint64_t bot = 0; bot < session_bots; ++bot) {
    if ((tick + bot * 61) % ticks_a_request != 0) continue;
    const float turn = static_cast<float>(tick) * 2e-4F + static_cast<float>(bot) * 1.6F;
    const float x_m = 45.0F * std::cos(turn) + random.unit() * 8.0F;
    const float z_m = 45.0F * std::sin(turn * 1.3F) + random.unit() * 8.0F;
    const CarveRequest blow = blow_at(terrain, x_m, z_m, 0.8F + random.unit(), 16, random.next());
    Command command{bot + 1, ++asked, blow};
    if (asked % 7 == 0) command.body = FillRequest{blow.shape};
    commands.push_back(std::move(command));
  }
  return commands;
}

/// A recording of the session's first minutes.
struct Recorded {
  double minutes = 0.0;
  std::string path;
  std::unique_ptr<RecordingWriter> writer;  ///< until it is finished
};

/// One session, from which each recording has its first minutes. The field's hash after each tick.
Result<std::vector<uint64_t>> record(Axis& axis, const ScaleRun& run, std::vector<Recorded>& recordings) {
  for (Recorded& one : recordings) {
    auto writer = RecordingWriter::create(one.path, {"bench", WorldConfig()});
    TRY(writer);
    one.writer = std::move(*writer);
  }
  World world{WorldConfig()};
  Random random(8);
  uint32_t asked = 0;
  std::vector<uint64_t> hashes;
  const auto ticks = static_cast<Tick>(recordings.back().minutes * ticks_a_minute);
  double simulated_s = 0.0;
  for (Tick tick = 1; tick <= ticks; ++tick) {
    const auto commands = asked_at(tick, world.config().terrain, random, asked);
    const double before_s = thread_cpu_s();
    const auto delta = world.step(commands);
    simulated_s += thread_cpu_s() - before_s;
    hashes.push_back(delta->field_hash);
    for (Recorded& one : recordings) {
      if (!one.writer) continue;
      TRY(one.writer->add(*delta, commands));
      const bool ends = tick == static_cast<Tick>(one.minutes * ticks_a_minute);
      if (auto done = ends                         ? one.writer->finish()
                      : tick % ticks_a_commit == 0 ? one.writer->commit()
                                                   : Result<void>();
          !done)
        return tl::unexpected(done.error());
      if (!ends) continue;
      one.writer.reset();
      axis.curve("simulated", "processor time, s").add(one.minutes, simulated_s);
    }
    if (tick % 600 == 0) run.progress(0.5 * static_cast<double>(tick) / static_cast<double>(ticks));
  }
  return hashes;
}

Result<void> seek_in(Axis& axis, const Recorded& recording, const std::vector<uint64_t>& hashes) {
  const double before_s = thread_cpu_s();
  auto source = TRY(ReplaySource::open(recording.path));
  axis.curve("opened", measure::processor_ms).add(recording.minutes, (thread_cpu_s() - before_s) * 1e3);
  Random random(3);
  std::vector<double> cpu_ms;
  size_t wrong = 0;
  for (size_t i = 0; i < seeks; ++i) {
    const Tick to = 1 + random.below(static_cast<uint32_t>(source->last_tick()));
    const double seek_s = thread_cpu_s();
    const auto jumped = source->jump(to);
    cpu_ms.push_back((thread_cpu_s() - seek_s) * 1e3);
    wrong += jumped && (*jumped)->field_hash == hashes[to - 1] ? 0 : 1;
  }
  axis.curve("seek, median", measure::processor_ms).add(recording.minutes, quantile(cpu_ms, 0.5));
  axis.curve("seek, 99th percentile", measure::processor_ms).add(recording.minutes, quantile(cpu_ms, 0.99));
  axis.checks.push_back({fmt::format("recording_{}_seeks", metric_name(figure(recording.minutes))),
                         wrong == 0, fmt::format("{} of {} random seeks gave another hash", wrong, seeks)});
  return {};
}

Result<void> verify_it(Axis& axis, const Recorded& recording) {
  const auto reader = TRY(RecordingReader::open(recording.path));
  const double before_s = thread_cpu_s();
  const auto verified = verify(*reader);
  TRY(verified);
  axis.curve("verified", "processor time, s").add(recording.minutes, thread_cpu_s() - before_s);
  axis.checks.push_back(
      {fmt::format("recording_{}_verifies", metric_name(figure(recording.minutes))), verified->agrees(),
       verified->agrees() ? fmt::format("{} ticks", verified->ticks) : verified->difference});
  return {};
}

}  // namespace

Result<Axis> measure_recording_axis(const ScaleRun& run) {
  Axis axis{"recording", "Recording", "length of the recording, minutes", "minutes"};
  const ScratchFolder scratch("scale_recording");
  std::vector<Recorded> recordings;
  for (const double minutes :
       run.quick ? std::vector<double>{0.1, 0.25, 0.5} : std::vector<double>{1, 2, 5, 12, 27, 60})
    recordings.push_back({minutes, scratch / fmt::format("{}", minutes), nullptr});
  const auto hashes = TRY(record(axis, run, recordings));
  double done = 0.0, all_minutes = 0.0;
  for (const Recorded& one : recordings) all_minutes += one.minutes;
  for (const Recorded& one : recordings) {
    axis.curve("file", measure::size_mib)
        .add(one.minutes, static_cast<double>(std::filesystem::file_size(one.path)) / 1048576.0);
    TRY(seek_in(axis, one, hashes));
    TRY(verify_it(axis, one));
    run.progress(0.5 + 0.5 * (done += one.minutes) / all_minutes);
  }
  axis.curve("seek, 99th percentile", measure::processor_ms).limit(100.0, "100 ms");
  axis.curve("file", measure::size_mib).limit(100.0 * 1024.0, "a disk's 100 GiB");
  axis.text.push_back(
      fmt::format("One session in which {} bots strike or fill every {} s, as fast as it goes; each "
                  "recording has its first minutes. "
                  "Seeks are {} jumps to random ticks, each compared by hash. Verifying simulates all of it "
                  "again. All times are "
                  "processor time of one thread.",
                  session_bots, ticks_a_request / 60, seeks));
  return axis;
}

}  // namespace scree
