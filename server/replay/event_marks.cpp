#include "server/replay/event_marks.h"

#include <algorithm>

namespace scree {

namespace {

/// Ticks to read at once: at first, at least and at most; and events in them, by which the number of ticks is
/// doubled or halved: some hundred take about as many microseconds.
constexpr Tick step_first = 600, step_min = 60, step_max = 7200;
constexpr size_t events_few = 128, events_many = 512;

/// Calls of read_on() after which what has changed is put together: half a second of ticks at 60 Hz.
constexpr uint64_t marks_period = 30;

}  // namespace

void EventMarks::add(const Event& event) {
  if (event.tick <= first_) return;
  while ((event.tick - first_ - 1) / ticks_per_column_ >= limits::mark_columns_max) lengthen_columns();
  uint32_t& counted = counts_[static_cast<size_t>(event.kind)][(event.tick - first_ - 1) / ticks_per_column_];
  counted = std::min(counted + 1, limits::mark_count_max);
  changed_ = true;
}

void EventMarks::lengthen_columns() {
  ticks_per_column_ *= 2;
  for (Columns& columns : counts_)
    for (size_t i = 0; i < columns.size(); ++i) {
      const bool beyond = 2 * i + 1 >= columns.size();
      columns[i] = beyond ? 0 : std::min(columns[2 * i] + columns[2 * i + 1], limits::mark_count_max);
    }
}

MarksMessage EventMarks::put_together() const {
  MarksMessage message{first_, ticks_per_column_, 0, read_to_};
  for (const EventKind kind : all_kinds<EventKind>) {
    const Columns& columns = counts_[static_cast<size_t>(kind)];
    for (uint32_t i = 0; i < columns.size(); ++i)
      if (columns[i] > 0) message.marks.push_back({kind, i, columns[i]});
  }
  return message;
}

/// A row of the machine's comes later than its ticks, and is read when it is there.
Result<void> EventMarks::read_up_to(RecordingReader& recording, Tick to) {
  if (read_to_ == to && machine_read_to_ >= to) return {};
  const auto events = recording.events(read_to_ + 1, to);
  TRY(events);
  const auto rows = TRY(recording.machine(machine_read_to_ + 1, to));
  for (const Event& event : *events) add(event);
  for (const RecordedMachine& row : rows) {
    machine_read_to_ = row.tick;
    for (const Event& event : row.events) add(event);
  }
  changed_ = changed_ || read_to_ != to;
  read_to_ = to;
  if (events->size() < events_few) step_ = std::min(step_ * 2, step_max);
  if (events->size() > events_many) step_ = std::max(step_ / 2, step_min);
  return {};
}

Result<void> EventMarks::read_on(RecordingReader& recording) {
  if (!begun_) {
    begun_ = true;
    first_ = recording.first_tick() - 1;
    read_to_ = first_;
    machine_read_to_ = first_;
    step_ = step_first;
  }
  const Tick last = recording.last_tick();
  // So that the bar is filled by the recording, and each column grows once for each time that it doubles.
  while ((std::max(last, first_ + 1) - first_ - 1) / ticks_per_column_ >= limits::mark_columns_max)
    lengthen_columns();
  TRY(read_up_to(recording, std::min(last, read_to_ + step_)));
  const bool is_time = ++calls_ % marks_period == 0 || message_ == nullptr;
  if (changed_ && is_time) message_ = std::make_shared<MarksMessage>(put_together());
  if (is_time) changed_ = false;
  return {};
}

}  // namespace scree
