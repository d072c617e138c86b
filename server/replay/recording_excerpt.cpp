#include "server/replay/recording_excerpt.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "server/formats/world_codec.h"
#include "server/replay/recorded_people.h"
#include "server/replay/recorded_world.h"
#include "server/replay/verify.h"
#include "server/store/limits.h"
#include "server/store/recording_writer.h"
#include "shared/base/check.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

/// Ticks between two states that are remembered on the way to the first tick: taking one costs time.
constexpr Tick ticks_per_state = 600;

/// Ticks for which events of the machine, and durations, are read at once.
constexpr Tick machine_batch_ticks = 600;

/// Whether going on from the world's value is going on with the world: there are no bodies, and nothing
/// waits.
bool is_quiet(const TickDelta& delta, const WorldMoment& moment) {
  return delta.pieces.empty() && moment.islands.empty() && moment.refractures.empty() &&
         moment.loosened_bricks.empty() && moment.strained.empty() && moment.requests.parties.empty();
}

/// What is recorded of the machine, as it comes with each tick.
class MachineRows {
 public:
  explicit MachineRows(RecordingReader& recording) : recording_(recording) {}

  /// The tick's events; its duration goes into `times`. To be asked for tick after tick.
  Result<std::vector<Event>> at(Tick tick, StageTimes& times) {
    if (!recording_.events_from()) return std::vector<Event>();
    if (tick > read_to_) {
      read_to_ = tick + machine_batch_ticks - 1;
      auto rows = TRY(recording_.machine(tick, read_to_));
      rows_ = std::move(rows);
    }
    times = {};
    std::vector<Event> events;
    for (const RecordedMachine& row : rows_) {
      if (row.tick < tick) continue;
      const Tick ago = row.tick - tick;
      if (ago < row.tick_us.size()) {
        constexpr double ms_per_us = 1e-3;
        times.ms.front() = row.tick_us[row.tick_us.size() - 1 - static_cast<size_t>(ago)] * ms_per_us;
        times.acted.set(0);
      }
      for (const Event& event : row.events)
        if (event.tick == tick) events.push_back(event);
    }
    return events;
  }

  /// About the tick that was asked for last.
  const std::vector<RecordedMachine>& rows() const { return rows_; }

 private:
  RecordingReader& recording_;
  std::vector<RecordedMachine> rows_;
  Tick read_to_ = 0;
};

class ExcerptWriter {
 public:
  ExcerptWriter(RecordingReader& recording, const GroundGiver& ground, Tick first, Tick last,
                std::function<void(double)> progress)
      : recording_(recording),
        ground_(ground),
        first_(first),
        last_(last),
        progress_(std::move(progress)),
        people_(recording.header().world.tick_rate_hz) {}

  Tick state() const { return state_; }

  /// `may_begin_quiet`: from a state that the recording has not.
  Result<void> write(const std::string& path, bool may_begin_quiet) {
    const auto from = TRY(recording_.state_before(first_ - 1));
    std::optional<WorldSnapshot> quiet;
    const auto observe = [&](World& world, const TickDelta& delta) {
      const bool due = !quiet || delta.tick >= quiet->moment.tick + ticks_per_state;
      if (may_begin_quiet && due && delta.pieces.empty() && is_quiet(delta, world.moment()))
        quiet = world.snapshot();
    };
    RecordedTerrain terrain(recording_);
    auto world = TRY(simulated_to(recording_, first_ - 1, terrain, ground_, show(0.0, 0.4), observe));
    state_ = quiet ? quiet->moment.tick : from;
    auto writer = TRY(begin(path, quiet));
    for (Tick tick = state_ + 1; tick < first_; ++tick) {
      const auto commands = recording_.commands(tick);
      TRY(commands);
      TRY(writer->add_unseen(tick, *commands));
    }
    if (first_ > 1) TRY(writer->begin_at(world->outline(), reader_of(*world)));
    TRY(tell_people(*writer));
    TRY(write_ticks(*writer, world, terrain));
    return writer->finish();
  }

  Result<void> verify_written(const std::string& path) const {
    const auto written = TRY(RecordingReader::open(path));
    const auto report = TRY(verify(*written, show(0.7, 1.0), ground_));
    if (!report.agrees())
      return fail(fmt::format("{} differs at tick {}: {}", path, report.first_difference, report.difference));
    return {};
  }

 private:
  /// Who joined before the first tick.
  Result<void> tell_people(RecordingWriter& writer) {
    for (Tick tick = recording_.first_tick(); tick < first_; tick += machine_batch_ticks) {
      const auto rows = TRY(recording_.machine(tick, std::min(first_ - 1, tick + machine_batch_ticks - 1)));
      people_.add(rows);
    }
    for (const Participant& person : people_.all()) writer.note(person);
    return {};
  }

  /// Progress of a step that takes a part of the whole.
  std::function<void(Tick, Tick)> show(double from, double to) const {
    return [this, from, to](Tick done, Tick all) {
      if (progress_) progress_(from + (to - from) * static_cast<double>(done) / static_cast<double>(all));
    };
  }

  /// A recording that begins with the state, or with the untouched world.
  Result<std::unique_ptr<RecordingWriter>> begin(const std::string& path,
                                                 const std::optional<WorldSnapshot>& quiet) {
    const RecordingHeader header{recording_.header().program, recording_.header().world};
    if (first_ == 1) return RecordingWriter::create(path, header);
    RecordedTerrain terrain(recording_);
    Result<std::unique_ptr<World>> world =
        quiet ? World::restore(*quiet) : world_at(recording_, state_, terrain, ground_);
    if (!world) return fail(fmt::format("{}: {}", recording_.path(), world.error().message));
    return RecordingWriter::create(path, header,
                                   {(*world)->moment(), (*world)->outline(), reader_of(**world)});
  }

  /// As they were recorded: the simulation goes on from the states that they went on from.
  Result<void> write_ticks(RecordingWriter& writer, std::unique_ptr<World>& world, RecordedTerrain& terrain) {
    MachineRows machine(recording_);
    writer.set_clock([this] { return people_.unix_ms(at_); });
    const auto shown = show(0.4, 0.7);
    for (Tick tick = first_; tick <= last_; ++tick) {
      const auto frame = recording_.frame(tick);
      TRY(frame);
      const auto commands = recording_.commands(tick);
      TRY(commands);
      TickDelta delta = *world->step(*commands);
      if (const std::string differs = difference_of(delta, *frame); !differs.empty())
        return fail(fmt::format("{}: at tick {}, {}", recording_.path(), tick, differs));
      const auto noted = TRY(machine.at(tick, delta.times));
      people_.add(machine.rows());
      at_ = tick;
      terrain.make_room(*world);
      auto state = recording_.state(tick);
      TRY(state);
      std::optional<WorldMoment> part;
      if (state->has_value()) {
        world.reset();  // there is room for one
        auto restored = restored_from(std::move(**state), tick, terrain, ground_);
        if (!restored) return fail(fmt::format("{}: {}", recording_.path(), restored.error().message));
        world = std::move(*restored);
        part = world->moment();
      }
      TRY(writer.add(delta, *commands, noted, part ? &*part : nullptr));
      if (tick % limits::ticks_per_keyframe == 0 || tick == last_) TRY(writer.commit());
      if (tick % progress_ticks == 0) shown(tick - first_, last_ - first_ + 1);
    }
    return {};
  }

  RecordingReader& recording_;
  const GroundGiver& ground_;
  const Tick first_, last_;
  const std::function<void(double)> progress_;
  RecordedPeople people_;
  Tick at_ = 0;  ///< that is written
  Tick state_ = 0;
};

}  // namespace

Result<ExcerptReport> write_excerpt(RecordingReader& recording, const std::string& to, Tick first, Tick last,
                                    const GroundGiver& ground, const std::function<void(double)>& progress) {
  if (first < recording.first_tick() || last > recording.last_tick() || first > last)
    return fail(fmt::format("{} has the ticks {} to {}, not {} to {} (--from, --to)", recording.path(),
                            recording.first_tick(), recording.last_tick(), first, last));
  std::error_code error;
  if (fs::exists(to, error)) return fail(to + " exists already: choose another name, or move it away");
  const std::string unfinished = to + ".unfinished";
  remove_recording(unfinished);
  ExcerptWriter cutting(recording, ground, first, last, progress);
  const auto write = [&](bool may_begin_quiet) {
    return with_terrain([&] { return cutting.write(unfinished, may_begin_quiet); });
  };
  auto done = write(true);
  if (done) {
    done = cutting.verify_written(unfinished);
    if (!done && cutting.state() != recording.state_before(first - 1).value_or(0)) {
      remove_recording(unfinished);
      done = write(false);
      if (done) done = cutting.verify_written(unfinished);
    }
  }
  if (done && fs::exists(to, error))
    done = fail(to + " exists already: choose another name, or move it away");
  if (done) {
    fs::rename(unfinished, to, error);
    if (error) done = fail(fmt::format("{} cannot be written: {}", to, error.message()));
  }
  if (!done) {
    remove_recording(unfinished);
    return tl::unexpected(done.error());
  }
  return ExcerptReport{first, last, cutting.state(), fs::file_size(to, error)};
}

}  // namespace scree
