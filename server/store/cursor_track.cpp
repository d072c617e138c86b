#include "server/store/cursor_track.h"

#include <algorithm>

#include "proto/limits.h"

namespace scree {

std::optional<CursorSample> CursorTrack::changes(Tick tick, std::span<const PlayerCursor> cursors) {
  CursorSample sample{tick};
  std::map<uint64_t, PlayerCursor> now;
  for (const PlayerCursor& cursor : cursors.first(std::min(cursors.size(), limits::cursors_max))) {
    const auto known = known_.find(cursor.session);
    if (known == known_.end() || known->second != cursor) sample.moved.push_back(cursor);
    now.emplace(cursor.session, cursor);
  }
  for (const auto& [session, cursor] : known_)
    if (!now.contains(session)) sample.gone.push_back(session);
  known_ = std::move(now);
  if (sample.moved.empty() && sample.gone.empty()) return std::nullopt;
  return sample;
}

}  // namespace scree
