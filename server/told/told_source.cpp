#include "server/told/told_source.h"

#include <fmt/format.h>
#include <utility>

#include "server/log/log.h"
#include "server/told/limits.h"
#include "server/told/told_rows.h"
#include "server/world/settings.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"

namespace scree {

ToldSource::ToldSource(std::unique_ptr<ToldReader> reader, std::string world, RecordingHeader header,
                       const ReadKeyframe& first, uint32_t ticks_per_transform)
    : reader_(std::move(reader)),
      world_name_(std::move(world)),
      header_(std::move(header)),
      run_(first.run),
      world_number_(first.told.world),
      ticks_per_transform_(ticks_per_transform),
      world_("the world " + world_name_ + " on the bus", header_.world.terrain) {}

Result<std::unique_ptr<ToldSource>> ToldSource::open(std::shared_ptr<Bus> bus, const std::string& world,
                                                     const GroundGiver& ground,
                                                     uint32_t ticks_per_transform) {
  auto reader = TRY(ToldReader::start(std::move(bus), world));
  std::optional<ReadTold> first = reader->next(limits::edge_begins_s);
  const auto* const keyframe = first ? std::get_if<ReadKeyframe>(&*first) : nullptr;
  if (keyframe == nullptr) {
    const std::string why = reader->status().fault;
    return fail(fmt::format("the world {} has no keyframe on the bus: {}", world,
                            why.empty() ? "nothing has come" : why));
  }
  auto header = TRY(from_recorded(TRY(header_of(keyframe->told))));
  if (auto given = give_ground(header.world.ground, header.world.terrain, ground); !given)
    return fail(fmt::format("the world {}: {}", world, given.error().message));
  auto source = std::unique_ptr<ToldSource>(
      new ToldSource(std::move(reader), world, std::move(header), *keyframe, ticks_per_transform));
  TRY(source->begin(*keyframe));
  return source;
}

Result<void> ToldSource::begin(const ReadKeyframe& keyframe) {
  auto parts = parts_of(keyframe.told, keyframe.tick, print(header_.world), world_.known());
  if (!parts) return world_.damaged("the keyframe: " + parts.error().message);
  BricksBefore forgotten;
  TRY(world_.restore(std::move(*parts), forgotten));
  number_ = tick_ = world_.tick();
  came_s_ = steady_now_s();
  return {};
}

std::shared_ptr<TickDelta> ToldSource::keyframe() {
  auto delta = world_.whole_state();
  delta->tick = number_;
  return delta;
}

/// What was missed, as one tick in which everything differs at once.
Result<std::shared_ptr<TickDelta>> ToldSource::jump() {
  const ReadKeyframe keyframe = *std::exchange(pending_, std::nullopt);
  auto parts = parts_of(keyframe.told, keyframe.tick, print(header_.world), world_.known());
  if (!parts) return world_.damaged("the keyframe: " + parts.error().message);
  const PlayedMoment from = world_.moment();
  BricksBefore before;
  TRY(world_.restore(std::move(*parts), before));
  ++resyncs_;
  log_of(LogPart::bus).info("the world {} goes on at tick {}", world_name_, world_.tick());
  return world_.differences(from, before);
}

/// Nothing: the simulation has begun anew.
Result<std::shared_ptr<TickDelta>> ToldSource::move() {
  waited_s_ = 0.0;
  if (pending_) return may_jump() ? jump() : world_.unchanged();
  const double asked_s = steady_now_s();
  auto told = reader_->next(limits::edge_still_s);
  waited_s_ = steady_now_s() - asked_s;
  look_whether_away(told.has_value());
  if (!told) return world_.unchanged();
  return std::visit(Overloaded{[&](ReadTick& tick) -> Result<std::shared_ptr<TickDelta>> {
                                 if (tick.run != run_ || tick.frame.tick != world_.tick() + 1)
                                   return world_.damaged("a tick does not follow");
                                 return world_.advance(std::move(tick.frame));
                               },
                               [&](ReadKeyframe& keyframe) -> Result<std::shared_ptr<TickDelta>> {
                                 if (keyframe.run != run_) return nullptr;
                                 pending_ = std::move(keyframe);
                                 return may_jump() ? jump() : world_.unchanged();
                               }},
                    *told);
}

std::shared_ptr<const TickDelta> ToldSource::next() {
  auto moved = move();
  is_over_ = !moved || *moved == nullptr;
  if (!moved) {
    log_of(LogPart::bus).error("the edge begins anew: {}", moved.error().message);
    return nullptr;
  }
  if (*moved == nullptr) {
    log_of(LogPart::bus)
        .info("the simulation of the world {} has begun anew, and so does this edge", world_name_);
    return nullptr;
  }
  tick_ = world_.tick();
  world_.tell_spawn(**moved);
  (*moved)->tick = ++number_;
  return std::move(*moved);
}

void ToldSource::look_whether_away(bool came) {
  const double now_s = steady_now_s();
  if (came) came_s_ = now_s;
  const bool away = now_s - came_s_ > limits::edge_away_s;
  if (away_.exchange(away) == away) return;
  if (away)
    log_of(LogPart::bus)
        .warn("the world {} is away: this edge shows it as it was at tick {}", world_name_, world_.tick());
  else
    log_of(LogPart::bus).info("the world {} is back", world_name_);
}

ToldStatus ToldSource::status() const {
  return {reader_->status(), tick_, run_, resyncs_, away_};
}

}  // namespace scree
