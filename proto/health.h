// Health of a server, as programs ask for it that watch servers: by AskHealth in place of a hello, or by
// HTTP. What it says is for everybody: it names no file and no person.
#pragma once

#include <string>
#include <vector>

#include "shared/base/ids.h"

namespace scree {

/// The only message of its connection.
struct AskHealthMessage {};

struct HealthFault {
  std::string name;   ///< for programs; at most limits::refusal_name_bytes_max
  std::string words;  ///< for people; at most limits::reason_bytes_max
};

struct HealthMessage {
  bool alive = true;  ///< the simulation ticks
  bool well = true;   ///< alive, and does all that it promised
  bool ready = true;  ///< alive, and has a place for a player
  Tick tick = 0;
  std::vector<HealthFault> faults;  ///< at most limits::health_faults_max
};

}  // namespace scree
