// A told world as a stream of ticks with the same content as live ones: what an edge publishes to its
// clients, who cannot see the difference. As in a replay the kernels apply the operations to a plain field,
// and the hash of every tick is compared (PlayedWorld).
//
// The ticks have numbers of their own, without a gap from the first on, so that nobody is reset. While the
// world is away they go on with the same state. What was missed becomes one tick in which everything differs
// at once. As long as nothing was missed they are the simulation's. One thread at a time, but for status().
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "server/replay/played_world.h"
#include "server/store/recording.h"
#include "server/told/told_reader.h"
#include "server/world/world_config.h"

namespace scree {

struct ToldStatus {
  ReaderStatus reader;
  Tick tick = 0;  ///< of the simulation
  uint64_t run = 0;
  uint64_t resyncs = 0;  ///< keyframes that were taken after the first
  bool away = false;     ///< no tick has come for limits::edge_away_s
};

class ToldSource {
 public:
  /// Waits limits::edge_begins_s for the world; an error: it is not told. `ground` gives it the ground that
  /// it names. `ticks_per_transform`: of the network.
  static Result<std::unique_ptr<ToldSource>> open(std::shared_ptr<Bus> bus, const std::string& world,
                                                  const GroundGiver& ground, uint32_t ticks_per_transform);

  const RecordingHeader& header() const { return header_; }  ///< with its ground
  uint64_t run() const { return run_; }
  uint64_t world_number() const { return world_number_; }  ///< as of WelcomeMessage::world
  /// The whole state, as it stands: what the first tick follows.
  std::shared_ptr<TickDelta> keyframe();
  /// The next tick, as soon as it comes; one in which nothing changes after limits::edge_still_s. Null: the
  /// simulation has begun anew, or what was told does not agree with its hash. Then an edge begins anew, too.
  std::shared_ptr<const TickDelta> next();

  /// Seconds that the last next() waited for a tick.
  double waited_s() const { return waited_s_; }
  /// Whether next() has come to its end.
  bool is_over() const { return is_over_; }

  /// From any thread.
  ToldStatus status() const;

 private:
  ToldSource(std::unique_ptr<ToldReader> reader, std::string world, RecordingHeader header,
             const ReadKeyframe& first, uint32_t ticks_per_transform);
  Result<void> begin(const ReadKeyframe& keyframe);
  Result<std::shared_ptr<TickDelta>> move();
  Result<std::shared_ptr<TickDelta>> jump();
  void look_whether_away(bool came);
  bool may_jump() const { return (number_ + 1) % ticks_per_transform_ == 0; }

  const std::unique_ptr<ToldReader> reader_;
  const std::string world_name_;
  const RecordingHeader header_;
  const uint64_t run_, world_number_;
  const uint32_t ticks_per_transform_;
  PlayedWorld world_;
  std::optional<ReadKeyframe> pending_;  ///< waits for a tick with poses
  Tick number_ = 0;
  double waited_s_ = 0.0;
  double came_s_ = 0.0;  ///< when the last tick came
  std::atomic<Tick> tick_ = 0;
  std::atomic<uint64_t> resyncs_ = 0;
  std::atomic<bool> away_ = false, is_over_ = false;
};

}  // namespace scree
