// The control of a replay, and where it stands.
#pragma once

#include <cstdint>
#include <string>

#include "shared/base/ids.h"
#include "shared/base/kind_table.h"

namespace scree {

/// Speed of a replay that clients may ask for, times real time. Beyond: refused.
inline constexpr double replay_speed_least = 0.1;
inline constexpr double replay_speed_most = 16.0;

enum class ReplayPlay : uint8_t { as_it_is, play, pause };

struct ReplayPlayRow {
  std::string_view name;
};

constexpr ReplayPlayRow row_of(ReplayPlay play) {
  switch (play) {
    case ReplayPlay::as_it_is:
      return {"as_it_is"};
    case ReplayPlay::play:
      return {"play"};
    case ReplayPlay::pause:
      return {"pause"};
  }
  return {};
}

enum class ReplayMove : uint8_t { stay, to_tick, by_ticks, to_time, next_event, previous_event };

struct ReplayMoveRow {
  std::string_view name;
};

constexpr ReplayMoveRow row_of(ReplayMove move) {
  switch (move) {
    case ReplayMove::stay:
      return {"stay"};
    case ReplayMove::to_tick:
      return {"to_tick"};
    case ReplayMove::by_ticks:
      return {"by_ticks"};
    case ReplayMove::to_time:
      return {"to_time"};
    case ReplayMove::next_event:
      return {"next_event"};
    case ReplayMove::previous_event:
      return {"previous_event"};
  }
  return {};
}

/// What somebody wants of a replay.
struct ControlReplayRequest {
  ReplayPlay play = ReplayPlay::as_it_is;
  float speed = 0.0F;  ///< times real time, negative: backwards; 0: as it is
  ReplayMove move = ReplayMove::stay;
  int64_t value = 0;  ///< to_tick: a tick; by_ticks: how many; to_time: ms since tick 0

  bool operator==(const ControlReplayRequest&) const = default;
};

/// Where a replay stands.
struct PlaybackMessage {
  Tick moment = 0;  ///< the recording's tick that is shown
  Tick first = 0;   ///< the first that can be shown: the state before the recording's first tick
  Tick last = 0;
  float speed = 1.0F;  ///< never 0
  bool playing = true;
  uint64_t heeded = 0;  ///< wishes carried out since the start, their moves done
  bool grows = false;   ///< the recording is being written: its end moves on
  /// Why the receiver may not control it; empty: it may.
  std::string refusal{};

  bool operator==(const PlaybackMessage&) const = default;
};

}  // namespace scree
