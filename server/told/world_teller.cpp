#include "server/told/world_teller.h"

#include <utility>

#include "server/told/world_teller_state.h"
#include "server/world/settings.h"
#include "shared/base/check.h"

namespace scree {

WorldTeller::State::State(std::shared_ptr<Bus> b, const TellerConfig& c, const RecordingHeader& h, uint64_t r)
    : bus(std::move(b)),
      config(c),
      names(c.world),
      run_number(r),
      settings(print(h.world)),
      header(encode(to_recorded(h))) {}

WorldTeller::WorldTeller(std::unique_ptr<State> state) : state_(std::move(state)) {}

WorldTeller::~WorldTeller() {
  stop();
}

Result<std::unique_ptr<WorldTeller>> WorldTeller::start(std::shared_ptr<Bus> bus, const TellerConfig& config,
                                                        const RecordingHeader& header, uint64_t run) {
  CHECK(run != 0);
  if (!is_bus_name(config.world))
    return fail("'" + config.world +
                "' is no name of a world on a bus: write a-z, 0-9, - and _ (--world-name)");
  auto state = std::make_unique<State>(std::move(bus), config, header, run);
  auto teller = std::unique_ptr<WorldTeller>(new WorldTeller(std::move(state)));
  teller->state_->thread = std::thread([s = teller->state_.get()] { s->run(); });
  return teller;
}

bool WorldTeller::wants_start() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->wants_start;
}

void WorldTeller::begin(TickDelta keyframe, ReadChunk read) {
  {
    const std::scoped_lock lock(state_->mutex);
    if (!std::exchange(state_->wants_start, false)) return;
    auto start = std::make_shared<State::Start>(State::Start{std::move(keyframe), std::move(read)});
    state_->queue.push_back({nullptr, std::move(start)});
  }
  state_->changed.notify_all();
}

void WorldTeller::push(std::shared_ptr<const TickDelta> delta) {
  CHECK(delta != nullptr);
  {
    const std::scoped_lock lock(state_->mutex);
    State& s = *state_;
    if (s.queue.size() >= limits::told_waiting_max) {
      s.status.health.lost += s.queue.size();
      s.queue.clear();
      s.wants_start = true;
    }
    if (s.wants_start || s.stopping) {
      ++s.status.health.lost;
      return;
    }
    s.queue.push_back({std::move(delta), nullptr});
  }
  state_->changed.notify_all();
}

TellerStatus WorldTeller::status() const {
  const std::scoped_lock lock(state_->mutex);
  TellerStatus status = state_->status;
  status.waiting = state_->queue.size();
  return status;
}

void WorldTeller::stop() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
}

}  // namespace scree
