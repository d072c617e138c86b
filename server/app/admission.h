// What stands between clients' requests and the simulation: an edit waits here until the chunks that it
// touches are in memory, and a little until their terrain is generated. It is refused when there is no room
// for it, or when they cannot be read.
//
// The simulation gets a command when nothing of that is open any more, and the tick that gets it is what a
// recording says. So neither depends on the speed of a disk. A session's commands keep their order. Used by
// the simulation's thread alone.
#pragma once

#include <deque>
#include <map>
#include <set>
#include <vector>

#include "server/app/terrain_ahead.h"
#include "server/app/terrain_pager.h"
#include "server/command/command.h"
#include "server/world/world.h"

namespace scree {

struct Admitted {
  std::vector<Command> commands;  ///< for the next tick
  std::vector<Reply> refused;
};

/// What edits wait for.
struct EditGround {
  World& world;
  TerrainPager& pager;
  TerrainAhead* ahead = nullptr;  ///< null: ticks generate what they need
  bool room_will_come = false;    ///< chunks go out when they are saved
};

class Admission {
 public:
  /// The commands that arrived, and those that waited.
  Admitted admit(std::vector<Command> arrived, const EditGround& ground);
  /// The tick answered these.
  void answered(const std::vector<Reply>& replies);
  /// Commands that had to wait, since the start.
  uint64_t held() const { return held_count_; }

 private:
  struct Held {
    Command command;
    double since_s = 0.0;  ///< by steady_now_s(): what it waits for is a disk
  };
  enum class Verdict { admit, hold };
  tl::expected<Verdict, Refused> judge(const Held& held, const EditGround& ground, double now_s);
  /// Every command that the simulation is given gets an answer.
  Verdict admit_with(const Command& command, double added_bytes);

  std::deque<Held> held_;
  /// What commands without an answer hold, by session and number, which a client may use again and again.
  std::map<std::pair<uint64_t, uint32_t>, std::multiset<double>> reserved_bytes_;
  double reserved_sum_bytes_ = 0.0;
  uint64_t held_count_ = 0;
};

}  // namespace scree
