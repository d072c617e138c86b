#include "server/store/recorder.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

#include "server/store/limits.h"
#include "server/store/recorder_state.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr std::chrono::duration<double> disk_patience(limits::recorder_patience_s);

}  // namespace

Recorder::Recorder(std::unique_ptr<State> state) : state_(std::move(state)) {}

Recorder::~Recorder() {
  static_cast<void>(finish());
}

void Recorder::commit_up_to(Tick tick) {
  std::unique_lock lock(state_->mutex);
  state_->wanted = std::max(state_->wanted, tick);
  state_->changed.notify_all();
  const bool is_known = state_->changed.wait_for(lock, disk_patience, [&] {
    return state_->safe >= tick || !state_->health.ok() || !state_->accepts || state_->ended;
  });
  if (!is_known) state_->note_hanging();
}

void Recorder::push(std::shared_ptr<const TickDelta> delta, std::vector<Command> commands,
                    std::vector<Event> noted, std::shared_ptr<const WorldMoment> part,
                    std::optional<std::vector<PlayerCursor>> cursors) {
  CHECK(delta != nullptr);
  {
    State& s = *state_;
    std::unique_lock lock(s.mutex);
    const auto is_full = [&] { return s.entries() >= limits::recorder_queue_max; };
    const auto may_go_on = [&] { return !is_full() || !s.health.ok() || !s.accepts || s.stopping; };
    if (!may_go_on()) ++s.waits;
    if (!s.changed.wait_for(lock, disk_patience, may_go_on)) s.note_hanging();
    if (s.stopping) return;
    if (is_full()) s.accepts = false;  // the disk has failed for so long
    if (!s.accepts) {
      ++s.health.lost;
      return;
    }
    CHECK(s.queue.empty() || s.queue.back().start || delta->tick == s.queue.back().delta->tick + 1);
    if (part) {
      s.part_waits = true;
      s.wants_part = PartWish::none;
    }
    s.queue.push_back(
        {std::move(delta), std::move(commands), std::move(noted), std::move(part), std::move(cursors)});
    CHECK(s.entries() <= limits::recorder_queue_max);
    if (!s.must_wake()) return;
  }
  state_->changed.notify_all();
}

bool Recorder::wants_start() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->wants_start;
}

void Recorder::begin_again(RecordingStart start) {
  {
    const std::scoped_lock lock(state_->mutex);
    if (!std::exchange(state_->wants_start, false) || state_->stopping) return;
    CHECK(state_->queue.empty() && !state_->accepts);
    state_->accepts = true;
    State::Entry entry;
    entry.start = std::make_shared<const RecordingStart>(std::move(start));
    state_->queue.push_back(std::move(entry));
  }
  state_->changed.notify_all();
}

Result<void> Recorder::finish(double last_tries_s) {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
    state_->last_until_s = steady_now_s() + last_tries_s;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
  if (state_->health.ok()) return {};
  if (!state_->begun)
    return fail(fmt::format("nothing of this session is recorded (--record {}): {} ticks are in no part: {}",
                            state_->family, state_->health.lost, *state_->health.because));
  return fail(fmt::format("the recording {} has no ticks after {}, and {} are in no part of it: {}",
                          state_->path, state_->safe, state_->health.lost, *state_->health.because));
}

StoreHealth Recorder::health() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->health;
}

std::string Recorder::path() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->path;
}

uint64_t Recorder::ticks_written() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->ticks_written;
}

PartWish Recorder::wants_part() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->wants_part;
}

RecordingSize Recorder::size() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->size;
}

uint64_t Recorder::waits() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->waits;
}

size_t Recorder::waiting() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->entries();
}

Durations Recorder::commits() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->commits;
}

}  // namespace scree
