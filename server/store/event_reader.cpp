#include "server/store/event_reader.h"

#include "server/store/schema.h"

namespace scree {

namespace {

std::string rows_of(const std::string& table, Tick from, Tick to) {
  return "SELECT tick, data, checksum FROM " + table + " WHERE tick BETWEEN " + std::to_string(from) +
         " AND " + std::to_string(to) + " ORDER BY tick";
}

}  // namespace

tl::unexpected<Error> EventReader::damaged(const std::string& what) const {
  return fail(database_->path() + ": damaged" + what);
}

Result<EventReader> EventReader::open(Database& database) {
  EventReader reader(database);
  TRY(reader.look());
  return reader;
}

/// Where the first row of the machine's begins. A recording that was gone on with may have it later.
Result<void> EventReader::look() {
  if (from_) return {};
  const auto row = TRY(database_->number("SELECT min(tick) FROM machine"));
  if (!row.has_value()) return {};
  const auto tick = static_cast<Tick>(*row);
  auto select = TRY(database_->prepare(schema::select_from("machine")));
  const auto bytes = TRY(database_->get(select, tick));
  if (!bytes.has_value()) return {};
  const auto machine = decode_recorded_machine(*bytes);
  if (!machine) return damaged(" at tick " + std::to_string(tick) + ": " + machine.error().message);
  from_ = machine->tick + 1 - machine->tick_us.size();
  return {};
}

Result<std::vector<Event>> EventReader::events(Tick from, Tick to) {
  std::vector<Event> events;
  if (!from_) return events;
  const auto take = [&](uint64_t tick, std::span<const uint8_t> data, bool whole) -> Result<void> {
    if (!whole) return damaged(": the events of tick " + std::to_string(tick));
    const auto row = decode_recorded_events(data, tick);
    if (!row) return damaged(" at tick " + std::to_string(tick) + ": " + row.error().message);
    events.insert(events.end(), row->begin(), row->end());
    return {};
  };
  TRY(database_->each(rows_of("events", from, to), take));
  return events;
}

Result<std::vector<RecordedMachine>> EventReader::machine(Tick from, Tick to) {
  std::vector<RecordedMachine> rows;
  if (!from_) return rows;
  const auto take = [&](uint64_t tick, std::span<const uint8_t> data, bool whole) -> Result<void> {
    if (!whole) return damaged(": the durations up to tick " + std::to_string(tick));
    auto row = decode_recorded_machine(data);
    if (!row) return damaged(" at tick " + std::to_string(tick) + ": " + row.error().message);
    if (row->tick != tick)
      return damaged(": durations of another tick than they say, " + std::to_string(tick));
    rows.push_back(std::move(*row));
    return {};
  };
  // A row that ends after `to` has ticks before it.
  TRY(database_->each(rows_of("machine", from, to + limits::ticks_per_row_max), take));
  return rows;
}

Result<std::optional<Tick>> EventReader::tick_of(const std::string& select) {
  if (!from_) return std::optional<Tick>();
  const auto tick = TRY(database_->number(select));
  return tick.has_value() ? std::optional(static_cast<Tick>(*tick)) : std::nullopt;
}

Result<std::optional<Tick>> EventReader::next(Tick tick, Tick last) {
  return tick_of("SELECT min(tick) FROM events WHERE tick > " + std::to_string(tick) +
                 " AND tick <= " + std::to_string(last));
}

Result<std::optional<Tick>> EventReader::previous(Tick tick, Tick first) {
  return tick_of("SELECT max(tick) FROM events WHERE tick < " + std::to_string(tick) +
                 " AND tick >= " + std::to_string(first));
}

}  // namespace scree
