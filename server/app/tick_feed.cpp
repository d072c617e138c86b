#include "server/app/tick_feed.h"

#include "server/log/log.h"
#include "server/replay/replay_source.h"
#include "shared/base/log_limit.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

class LiveFeed final : public TickFeed {
 public:
  explicit LiveFeed(std::unique_ptr<World> world) : world_(std::move(world)) {}
  Result<std::shared_ptr<const TickDelta>> next(std::span<const Command> commands) override {
    try {
      return world_->step(commands);
    } catch (const ChunkUnreadable& unreadable) {
      return fail(std::string("the world cannot go on, and stays as it was saved: ") + unreadable.what());
    }
  }
  World* world() override { return world_.get(); }

 private:
  std::unique_ptr<World> world_;
};

class ToldFeed final : public TickFeed {
 public:
  explicit ToldFeed(std::shared_ptr<ToldSource> told) : told_(std::move(told)) {}
  Result<std::shared_ptr<const TickDelta>> next(std::span<const Command>) override { return told_->next(); }
  bool paces_itself() const override { return true; }
  double waited_s() const override { return told_->waited_s(); }

 private:
  std::shared_ptr<ToldSource> told_;
};

class RecordedFeed final : public TickFeed {
 public:
  RecordedFeed(std::unique_ptr<ReplaySource> source, const PlayerOptions& options)
      : player_(std::move(source), options) {}
  Result<std::shared_ptr<const TickDelta>> next(std::span<const Command>) override { return player_.next(); }
  Result<void> control(const ControlReplayRequest& wish) override { return player_.request(wish); }

 private:
  ReplayPlayer player_;
};

}  // namespace

std::unique_ptr<TickFeed> feed_of(std::unique_ptr<World> world) {
  return std::make_unique<LiveFeed>(std::move(world));
}

std::unique_ptr<TickFeed> feed_of(std::shared_ptr<ToldSource> told) {
  return std::make_unique<ToldFeed>(std::move(told));
}

Result<ReplayFeed> replay_feed(const ReplayOptions& options, const GroundGiver& ground,
                               uint32_t ticks_per_transform) {
  auto source = TRY(ReplaySource::open(options.path, options.from, ground, WithoutTicks::awaited));
  const WorldConfig world = source->header().world;
  if (source->last_tick() == 0)
    log_of(LogPart::replay).warn("{} has no tick yet: the replay waits for the first", options.path);
  else if (!source->is_ended())
    log_of(LogPart::replay)
        .warn("{} is being written, or was cut short: it plays to its last whole tick, {}", options.path,
              source->last_tick());
  const PlayerOptions player{
      options.at_end, options.speed, ticks_per_transform,
      [path = options.path, limit = std::make_shared<LogLimit>()](const std::string& what) {
        if (const auto more = limit->admit("replay", steady_now_s()))
          log_of(LogPart::replay).warn("{}: {}{}", path, what, *more);
      }};
  const Spawn spawn = source->spawn();
  return ReplayFeed{std::make_unique<RecordedFeed>(std::move(source), player), world, spawn};
}

}  // namespace scree
