// What a host's rules show and tell, and what programs tell rules, as messages of the wire
// (proto/game.proto).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/ids.h"
#include "shared/game/notice.h"
#include "shared/game/sign.h"

namespace scree {

/// Either way: bytes of a game's own, to its rules or from them.
struct ChannelMessage : ChannelData {};

// ---- server to client

/// All signs that the receiver is to see, in order; at most limits::signs_max.
struct SignsMessage {
  std::vector<Sign> signs;
};

/// Sounds and puffs of a tick.
struct CuesMessage {
  Tick tick = 0;
  std::vector<Cue> cues;  ///< at most limits::notices_a_tick_max
};

// ---- administrators

enum class RulesControl : uint8_t { list, reload, console };

struct RulesControlRow {
  std::string_view name;
};

constexpr RulesControlRow row_of(RulesControl control) {
  switch (control) {
    case RulesControl::list:  // the rules that run, and what became of their handlers
      return {"list"};
    case RulesControl::reload:  // reads them again
      return {"reload"};
    case RulesControl::console:  // runs a line
      return {"console"};
  }
  return {};
}

/// Answered by an AdminListMessage with `text`.
struct ControlRulesRequest {
  RulesControl control = RulesControl::list;
  std::string rules;  ///< the name of the rules that a line is for; empty: the first ones
  std::string line;   ///< of a console; at most limits::console_line_bytes_max
};

}  // namespace scree
