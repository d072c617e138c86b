#include "server/replay/recorded_cursors.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "server/formats/event_codec.h"

namespace scree {

namespace {

/// Ticks between two samples of a person who moves. A longer time was spent standing still.
constexpr Tick sample_gap_max = 12;
/// Farther between two samples, nobody moves but is elsewhere.
constexpr float jump_m = 20.0F;

Tick first_of(const RecordedMachine& row) {
  return row.tick + 1 - row.tick_us.size();
}

/// On the way to the person's next sample.
void move_on(PlayerCursor& cursor, Tick since, const CursorSample& next, Tick tick) {
  const auto to = std::ranges::find(next.moved, cursor.session, &PlayerCursor::session);
  if (to == next.moved.end() || glm::distance(cursor.eye_m, to->eye_m) > jump_m) return;
  const float part = static_cast<float>(tick - since) / static_cast<float>(next.tick - since);
  cursor.eye_m = glm::mix(cursor.eye_m, to->eye_m, part);
  cursor.aim_m = glm::mix(cursor.aim_m, to->aim_m, part);
}

/// The row's persons after the tick. `after`: the row after it; null: there is none.
std::vector<PlayerCursor> cursors_of(const RecordedMachine& row, const RecordedMachine* after, Tick tick) {
  std::map<uint64_t, PlayerCursor> there;
  Tick since = first_of(row);
  const CursorSample* next = nullptr;
  for (const CursorSample& sample : row.cursors) {
    if (sample.tick > tick) {
      next = &sample;
      break;
    }
    since = sample.tick;
    for (const PlayerCursor& cursor : sample.moved) there.insert_or_assign(cursor.session, cursor);
    for (const uint64_t session : sample.gone) there.erase(session);
  }
  if (next == nullptr && after != nullptr && !after->cursors.empty()) next = &after->cursors.front();
  std::vector<PlayerCursor> cursors;
  for (auto& [session, cursor] : there) {
    if (next != nullptr && next->tick - since <= sample_gap_max) move_on(cursor, since, *next, tick);
    cursors.push_back(std::move(cursor));
  }
  return cursors;
}

}  // namespace

Result<std::vector<PlayerCursor>> RecordedCursors::at(RecordingReader& recording, Tick tick) {
  const auto row_of = [&] {
    return std::ranges::find_if(
        rows_, [&](const RecordedMachine& row) { return row.tick >= tick && first_of(row) <= tick; });
  };
  if (row_of() == rows_.end() || row_of() + 1 == rows_.end()) {
    auto rows = TRY(recording.machine(tick, tick));
    rows_ = std::move(rows);
  }
  const auto row = row_of();
  if (row == rows_.end()) {
    const bool comes = !recording.is_ended() && tick + limits::ticks_per_row_max > recording.last_tick();
    if (!comes) last_.clear();
    return last_;
  }
  last_ = cursors_of(*row, row + 1 == rows_.end() ? nullptr : &*(row + 1), tick);
  return last_;
}

}  // namespace scree
