#include "server/store/machine_writer.h"

#include <cmath>
#include <utility>

#include "server/formats/event_codec.h"
#include "server/store/schema.h"
#include "server/world/world.h"

namespace scree {

namespace {

/// Ticks of one row: a second of them at 60 Hz. Each begins with a tick in which cursors are sampled.
constexpr Tick ticks_per_machine_row = 60;
static_assert(ticks_per_machine_row % ticks_per_physics == 0);
static_assert(ticks_per_machine_row <= limits::ticks_per_row_max);
constexpr double us_per_ms = 1000.0;

}  // namespace

Result<MachineWriter> MachineWriter::create(Database& database) {
  MachineWriter writer(database);
  auto prepared = TRY(database.prepare(schema::put_into("machine")));
  writer.put_row_ = std::move(prepared);
  return writer;
}

/// A row is not written at each tick: it would be most of a quiet recording.
Result<void> MachineWriter::add(const TickDelta& delta, std::span<const Event> noted,
                                const std::optional<std::vector<PlayerCursor>>& cursors) {
  if (cursors) last_cursors_ = *cursors;
  if (cursors || row_.tick_us.empty()) add_cursors(delta.tick);
  row_.tick = delta.tick;
  row_.tick_us.push_back(static_cast<uint32_t>(std::lround(delta.times.total_ms() * us_per_ms)));
  for (const Event& event : noted) {
    roster_.note(event);
    if (row_.events.size() < limits::events_per_row_max) row_.events.push_back(event);
  }
  // The first one says at once where the log of events begins.
  const bool is_due = !has_row_ || (delta.tick + 1) % ticks_per_machine_row == 0;
  has_row_ = true;
  return is_due ? put() : Result<void>();
}

/// Each row stands for itself, so that any moment has its cursors without the rows before.
void MachineWriter::add_cursors(Tick tick) {
  auto sample = cursors_.changes(tick, last_cursors_);
  if (!sample) return;
  cursor_entries_ += sample->moved.size() + sample->gone.size();
  if (cursor_entries_ <= limits::cursors_per_row_max) row_.cursors.push_back(std::move(*sample));
}

Result<void> MachineWriter::put() {
  if (row_.tick_us.empty()) return {};
  RecordedMachine row = std::exchange(row_, {});
  row.unix_ms = unix_ms_();
  if (std::exchange(tells_persons_, false)) row.persons = roster_.all();
  cursors_.forget();
  cursor_entries_ = 0;
  return database_->put(put_row_, row.tick, encode(row));
}

}  // namespace scree
