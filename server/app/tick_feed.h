// The source of a server's ticks: the simulation, a recording, or a world that another server tells.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "server/command/command.h"
#include "server/replay/replay_player.h"
#include "server/told/told_source.h"
#include "server/world/tick_delta.h"
#include "server/world/world.h"
#include "shared/base/result.h"

namespace scree {

class TickFeed {
 public:
  virtual ~TickFeed() = default;

  /// The next tick; null at the end.
  virtual Result<std::shared_ptr<const TickDelta>> next(std::span<const Command> commands) = 0;
  /// Whether next() waits for the tick to come; else the server's clock says when it is due.
  virtual bool paces_itself() const { return false; }
  /// Seconds that the last next() waited so.
  virtual double waited_s() const { return 0.0; }
  /// The simulation behind it; null for all others.
  virtual World* world() { return nullptr; }
  /// Takes what somebody wants of a replay; an error for a simulation. From any thread.
  virtual Result<void> control(const ControlReplayRequest&) {
    return fail("this server plays no recording (--replay)");
  }
};

std::unique_ptr<TickFeed> feed_of(std::unique_ptr<World> world);

/// An edge's.
std::unique_ptr<TickFeed> feed_of(std::shared_ptr<ToldSource> told);

struct ReplayOptions {
  std::string path;  ///< empty: no replay
  Tick from = 0;
  float speed = 1.0F;  ///< times real time
  AtEnd at_end = AtEnd::stay;
};

struct ReplayFeed {
  std::unique_ptr<TickFeed> feed;
  WorldConfig world;  ///< of the recording
  Spawn spawn;        ///< where visitors begin until a tick says otherwise
};
/// `ground` gives the recording the ground that it names. `ticks_per_transform`: of the network.
Result<ReplayFeed> replay_feed(const ReplayOptions& options, const GroundGiver& ground,
                               uint32_t ticks_per_transform);

}  // namespace scree
