#include "python/held_world.h"

#include "python/errors.h"
#include "server/formats/world_value.h"
#include "server/world/settings.h"

namespace scree::python {

HeldWorld::HeldWorld(std::unique_ptr<World> world)
    : world_(std::move(world)), voxel_m_(world_->config().terrain.voxel_size_m) {
  follow_anew();
}

void HeldWorld::follow_anew() {
  events_ = std::make_unique<EventDeriver>(voxel_m_, print(world_->config()));
}

std::vector<uint32_t> HeldWorld::number(std::span<Command> commands) {
  std::vector<uint32_t> numbers;
  numbers.reserve(commands.size());
  for (Command& command : commands) numbers.push_back(command.request = ++last_number_);
  return numbers;
}

void HeldWorld::advance(std::span<const Command> commands, Step& step) {
  const std::shared_ptr<const TickDelta> delta = world_->step(commands);
  step.tick = delta->tick;
  step.replies.insert(step.replies.end(), delta->replies.begin(), delta->replies.end());
  const std::vector<Event> events = events_->events_of(*delta);
  step.events.insert(step.events.end(), events.begin(), events.end());
  step.ledger = delta->ledger;
  step.state_hash = delta->state_hash;
  step.field_hash = delta->field_hash;
  step.operations += delta->operations.size();
}

uint64_t HeldWorld::state_hash() const {
  return world_->moment().state_hash;
}

Use::Use(HeldWorld& held) : held_(held) {
  if (held.in_use_.exchange(true, std::memory_order_acquire))
    throw RaisedError(
        "this world is in use: another thread has not ended its call yet, or one call names it twice");
}

Use::~Use() {
  held_.world_->release_thread();
  held_.in_use_.store(false, std::memory_order_release);
}

}  // namespace scree::python
