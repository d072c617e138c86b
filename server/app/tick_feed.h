// The source of a server's ticks: the simulation, or a recording.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "server/work/command.h"
#include "server/world/tick_delta.h"
#include "server/world/world.h"
#include "shared/base/result.h"

namespace scree {

class TickFeed {
 public:
  virtual ~TickFeed() = default;

  /// The next tick; null at the end.
  virtual Result<std::shared_ptr<const TickDelta>> next(std::span<const Command> commands) = 0;
  /// The simulation behind it; null for a recording.
  virtual World* world() { return nullptr; }
};

std::unique_ptr<TickFeed> feed_of(std::unique_ptr<World> world);
/// Refuses a configuration that no world runs with. `threads`: of the world (World::create).
Result<std::unique_ptr<TickFeed>> live_feed(const WorldConfig& config, size_t threads);

struct ReplayOptions {
  std::string path;  ///< empty: no replay
  Tick from = 0;
  double speed = 1.0;  ///< times real time
  bool loop = false;   ///< starts over at the end
};

struct ReplayFeed {
  std::unique_ptr<TickFeed> feed;
  WorldConfig world;  ///< of the recording
};
/// `ground` gives the recording the ground that it names.
Result<ReplayFeed> replay_feed(const ReplayOptions& options, const GroundGiver& ground);

}  // namespace scree
