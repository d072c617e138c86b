#include "server/store/event_reader.h"

#include <algorithm>
#include <fmt/format.h>

#include "server/store/schema.h"

namespace scree {

namespace {

std::string rows_of(const std::string& table, Tick from, Tick to) {
  return fmt::format("SELECT tick, data, checksum FROM {} WHERE tick BETWEEN {} AND {} ORDER BY tick", table,
                     from, to);
}

}  // namespace

tl::unexpected<Error> EventReader::damaged(const std::string& what) const {
  return fail(fmt::format("{}: damaged{}", database_->path(), what));
}

Result<EventReader> EventReader::open(Database& database) {
  EventReader reader(database);
  TRY(reader.find_start());
  return reader;
}

/// Finds where the first row of the machine begins. A recording that was continued may have it later.
Result<void> EventReader::find_start() {
  if (from_) return {};
  const auto row = TRY(database_->number("SELECT min(tick) FROM machine"));
  if (!row.has_value()) return {};
  const auto tick = static_cast<Tick>(*row);
  auto select = TRY(database_->prepare(schema::select_from("machine")));
  const auto bytes = TRY(database_->get(select, tick));
  if (!bytes.has_value()) return {};
  const auto machine = decode_recorded_machine(*bytes);
  if (!machine) return damaged(fmt::format(" at tick {}: {}", tick, machine.error().message));
  from_ = machine->tick + 1 - machine->tick_us.size();
  return {};
}

Result<std::vector<Event>> EventReader::events(Tick from, Tick to) {
  std::vector<Event> events;
  if (!from_) return events;
  const auto add_row = [&](uint64_t tick, std::span<const uint8_t> data, bool whole) -> Result<void> {
    if (!whole) return damaged(fmt::format(": the events of tick {}", tick));
    const auto row = decode_recorded_events(data, tick);
    if (!row) return damaged(fmt::format(" at tick {}: {}", tick, row.error().message));
    events.insert(events.end(), row->begin(), row->end());
    return {};
  };
  TRY(database_->each(rows_of("events", from, to), add_row));
  return events;
}

Result<std::vector<RecordedMachine>> EventReader::machine(Tick from, Tick to) {
  std::vector<RecordedMachine> rows;
  if (!from_) return rows;
  const auto add_row = [&](uint64_t tick, std::span<const uint8_t> data, bool whole) -> Result<void> {
    if (!whole) return damaged(fmt::format(": the durations up to tick {}", tick));
    auto row = decode_recorded_machine(data);
    if (!row) return damaged(fmt::format(" at tick {}: {}", tick, row.error().message));
    if (row->tick != tick) return damaged(fmt::format(": durations of another tick than they say, {}", tick));
    rows.push_back(std::move(*row));
    return {};
  };
  // A row that ends after `to` has ticks before it.
  TRY(database_->each(rows_of("machine", from, to + limits::ticks_per_row_max), add_row));
  return rows;
}

Result<std::optional<Tick>> EventReader::tick_of(const std::string& select) {
  if (!from_) return std::optional<Tick>();
  const auto tick = TRY(database_->number(select));
  return tick.has_value() ? std::optional(static_cast<Tick>(*tick)) : std::nullopt;
}

/// From that row on: contacts are several a second where rubble falls.
Result<std::optional<Tick>> EventReader::beside_contacts(std::optional<Tick> tick,
                                                         const std::function<std::string(Tick)>& select) {
  while (tick) {
    const auto there = events(*tick, *tick);
    TRY(there);
    if (!std::ranges::all_of(*there, [](const Event& e) { return e.kind == EventKind::contact; })) break;
    tick = TRY(tick_of(select(*tick)));
  }
  return tick;
}

Result<std::optional<Tick>> EventReader::next(Tick tick, Tick last) {
  const auto select = [last](Tick from) {
    return fmt::format("SELECT min(tick) FROM events WHERE tick > {} AND tick <= {}", from, last);
  };
  const auto nearest = TRY(tick_of(select(tick)));
  return beside_contacts(nearest, select);
}

Result<std::optional<Tick>> EventReader::previous(Tick tick, Tick first) {
  const auto select = [first](Tick from) {
    return fmt::format("SELECT max(tick) FROM events WHERE tick < {} AND tick >= {}", from, first);
  };
  const auto nearest = TRY(tick_of(select(tick)));
  return beside_contacts(nearest, select);
}

}  // namespace scree
