#include "server/replay/export_lines.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

#include "server/replay/recorded_people.h"
#include "server/store/event_deriver.h"
#include "server/store/event_lines.h"
#include "server/world/settings.h"

namespace scree {

namespace {

/// Ticks that are read at once.
constexpr Tick batch_ticks = 3600;
constexpr float us_per_ms = 1000.0F;

using Durations = std::map<Tick, float>;

struct Batch {
  std::vector<Event> events;  ///< ordered by tick
  Durations ms;
};

/// `people` takes what the rows say; may be null.
Result<Batch> read_batch(RecordingReader& recording, Tick from, Tick to, RecordedPeople* people = nullptr) {
  auto events = recording.events(from, to);
  TRY(events);
  const auto rows = TRY(recording.machine(from, to));
  if (people != nullptr) people->add(rows);
  Batch batch{std::move(*events), {}};
  for (const RecordedMachine& row : rows) {
    const Tick first = row.tick + 1 - row.tick_us.size();
    for (size_t i = 0; i < row.tick_us.size(); ++i)
      batch.ms[first + i] = static_cast<float>(row.tick_us[i]) / us_per_ms;
    for (const Event& event : row.events)
      if (event.tick >= from && event.tick <= to) batch.events.push_back(event);
  }
  std::ranges::stable_sort(batch.events, {}, &Event::tick);
  return batch;
}

std::optional<float> ms_of(const Durations& ms, Tick tick) {
  const auto known = ms.find(tick);
  return known == ms.end() ? std::nullopt : std::optional(known->second);
}

Result<void> derive_events(const std::string& path, const GroundGiver& ground, const EventVisitor& visit) {
  auto source = TRY(ReplaySource::open(path, 0, ground));
  const WorldConfig& world = source->header().world;
  EventDeriver deriver(world.terrain.voxel_size_m, print(world));
  for (;;) {
    const auto delta = TRY(source->next());
    if (delta == nullptr) return {};
    for (const Event& event : deriver.events_of(*delta)) visit(event, {world.tick_rate_hz});
  }
}

struct LedgerColumn {
  std::string_view name;
  MassUnits (*of)(const Ledger&);
};

constexpr std::array ledger_columns = {
    LedgerColumn{"terrain_m3", [](const Ledger& l) { return l.terrain; }},
    LedgerColumn{"pieces_m3", [](const Ledger& l) { return l.pieces; }},
    LedgerColumn{"dust_m3", [](const Ledger& l) { return l.dust; }},
    LedgerColumn{"poured_m3", [](const Ledger& l) { return l.poured; }},
    LedgerColumn{"moved_m3", [](const Ledger& l) { return l.moved; }},
    LedgerColumn{"error_m3", [](const Ledger& l) { return l.error(); }},
    LedgerColumn{"stored_m3", [](const Ledger& l) { return l.stored; }},
};

std::string tick_line(const RecordedFrame& frame, const WorldConfig& world, const Durations& ms,
                      LineFormat format) {
  const bool csv = format == LineFormat::csv;
  const double voxel_m = world.terrain.voxel_size_m;
  const double unit_m3 = voxel_m * voxel_m * voxel_m / units_per_voxel;
  const Ledger ledger = frame.ledger;
  const double time_s = static_cast<double>(frame.tick) / world.tick_rate_hz;
  std::string line = csv ? fmt::format("{},{:.3f}", frame.tick, time_s)
                         : fmt::format(R"({{"tick":{},"time_s":{:.3f})", frame.tick, time_s);
  if (const auto took = ms_of(ms, frame.tick))
    line += csv ? fmt::format(",{:.3f}", *took) : fmt::format(R"(,"ms":{:.3f})", *took);
  else if (csv)
    line += ",";
  line += csv ? fmt::format(",{}", frame.operations.size())
              : fmt::format(R"(,"operations":{})", frame.operations.size());
  for (const LedgerColumn& column : ledger_columns) {
    const double value_m3 = static_cast<double>(column.of(ledger)) * unit_m3;
    line += csv ? fmt::format(",{:.6f}", value_m3) : fmt::format(R"(,"{}":{:.6f})", column.name, value_m3);
  }
  return csv ? line : line + "}";
}

}  // namespace

Result<void> each_event(RecordingReader& recording, const GroundGiver& ground, const EventVisitor& visit) {
  if (!recording.events_from()) return derive_events(recording.path(), ground, visit);
  const Tick last = recording.last_tick();
  const uint32_t tick_rate_hz = recording.header().world.tick_rate_hz;
  RecordedPeople people(tick_rate_hz);
  for (Tick from = recording.first_tick(); from <= last; from += batch_ticks) {
    const auto batch = TRY(read_batch(recording, from, std::min(last, from + batch_ticks - 1), &people));
    for (const Event& event : batch.events)
      visit(event, {tick_rate_hz, ms_of(batch.ms, event.tick), people.unix_ms(event.tick),
                    event.session == 0 ? Participant() : people.find(event.session)});
  }
  return {};
}

Result<void> export_events(const std::string& path, const GroundGiver& ground, LineFormat format,
                           const LineSink& write) {
  const auto recording = TRY(RecordingReader::open(path));
  const bool csv = format == LineFormat::csv;
  if (csv) write(std::string(event_csv_heads));
  return each_event(*recording, ground, [&](const Event& event, const EventContext& context) {
    write(csv ? csv_line(event, context) : json_line(event, context));
  });
}

Result<void> export_ticks(RecordingReader& recording, LineFormat format, const LineSink& write) {
  if (format == LineFormat::csv) {
    std::string heads = "tick,time_s,ms,operations";
    for (const LedgerColumn& column : ledger_columns) {
      heads += ',';
      heads += column.name;
    }
    write(heads);
  }
  Batch batch;
  for (Tick tick = recording.first_tick(), read = tick; tick <= recording.last_tick(); ++tick) {
    if (tick == read) {
      read = tick + batch_ticks;
      auto next = TRY(read_batch(recording, tick, read - 1));
      batch = std::move(next);
    }
    const auto frame = recording.frame(tick);
    TRY(frame);
    write(tick_line(*frame, recording.header().world, batch.ms, format));
  }
  return {};
}

}  // namespace scree
