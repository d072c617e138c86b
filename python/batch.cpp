#include "python/batch.h"

#include "python/errors.h"
#include "shared/field/mass.h"

namespace scree::python {

void WorldBatch::each(const std::function<void(size_t)>& work) {
  workers_.run(worlds_.size(), work);
  workers_.release_owner();
}

void WorldBatch::advance(std::span<const std::vector<Command>> commands, int64_t ticks,
                         std::span<Step> steps) {
  each([&](size_t i) {
    HeldWorld& held = *worlds_[i];
    for (int64_t tick = 0; tick < ticks; ++tick)
      held.advance(tick == 0 ? std::span<const Command>(commands[i]) : std::span<const Command>(), steps[i]);
    held.world().release_thread();
  });
}

Outcome WorldBatch::act_in(HeldWorld& held, std::span<const float, 3> action) const {
  std::vector<Command> commands;
  if (auto dig = dig_at(held.world().field(), episode_.task, action)) commands.push_back(std::move(*dig));
  held.number(commands);
  Step step;
  for (int tick = 0; tick < episode_.ticks; ++tick)
    held.advance(tick == 0 ? std::span<const Command>(commands) : std::span<const Command>(), step);
  Outcome outcome{.state_hash = step.state_hash};
  const double voxel_m = static_cast<double>(held.voxel_m());
  for (const Reply& reply : step.replies) {
    outcome.refused = outcome.refused || !reply.refusal.empty();
    if (reply.mass)
      outcome.moved_m3 += static_cast<double>(*reply.mass) / units_per_voxel * voxel_m * voxel_m * voxel_m;
  }
  return outcome;
}

void WorldBatch::act(std::span<const float> actions, std::span<const char> begins,
                     std::span<Outcome> outcomes, std::span<float> heights_m) {
  each([&](size_t i) {
    HeldWorld& held = *worlds_[i];
    if (begins[i] == 0) {
      outcomes[i] = act_in(held, actions.subspan(3 * i).first<3>());
      is_over_[i] = static_cast<char>(++used_steps_[i] >= episode_.steps);
    }
    python::observe(held.world().field(), episode_.task,
                    heights_m.subspan(i * heights_of_one(), heights_of_one()));
    held.world().release_thread();
  });
}

void WorldBatch::observe(std::span<float> heights_m) {
  each([&](size_t i) {
    python::observe(worlds_[i]->world().field(), episode_.task,
                    heights_m.subspan(i * heights_of_one(), heights_of_one()));
  });
}

BatchUse::BatchUse(WorldBatch& batch, bool with_worlds) : batch_(batch) {
  if (batch.in_use_.exchange(true, std::memory_order_acquire))
    throw RaisedError("this batch is in use: another thread has not ended its call yet");
  try {
    if (with_worlds) take_worlds();
  } catch (...) {
    worlds_.clear();
    batch.in_use_.store(false, std::memory_order_release);
    throw;
  }
}

void BatchUse::take_worlds() {
  for (const Held& world : batch_.worlds_)
    if (world) worlds_.push_back(std::make_unique<Use>(*world));
}

BatchUse::~BatchUse() {
  worlds_.clear();
  batch_.in_use_.store(false, std::memory_order_release);
}

}  // namespace scree::python
