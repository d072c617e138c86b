#include "server/replay/replay_source.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <utility>

#include "server/replay/replay_state.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Work of the operations that ticks may have together, by the model, µs: half of what a client takes in one
/// frame (limits::mirror_frame_work_max_us). One tick has as much as it has.
constexpr float joint_work_max_us = 1.0e6F;

/// Ticks that are looked through for the next event of a recording without a log: ten minutes at 60 Hz.
constexpr Tick looked_through_max = 36000;

/// Puts the next tick behind the ones before.
void append(TickDelta& to, const TickDelta& next) {
  to.tick = next.tick;
  to.operations.insert(to.operations.end(), next.operations.begin(), next.operations.end());
  to.spawned.insert(to.spawned.end(), next.spawned.begin(), next.spawned.end());
  std::ranges::stable_sort(to.spawned, {}, &SpawnedPiece::id);
  std::vector<BrickState> bricks;
  // Where both changed a brick, the first one counts, which is the later.
  std::ranges::set_union(next.bricks, to.bricks, std::back_inserter(bricks), {}, &BrickState::coord,
                         &BrickState::coord);
  to.bricks = std::move(bricks);
  to.pieces = next.pieces;
  to.props_spawned.insert(to.props_spawned.end(), next.props_spawned.begin(), next.props_spawned.end());
  std::ranges::stable_sort(to.props_spawned, {}, &SpawnedProp::id);
  to.props = next.props;
  for (const PlacedStone& gone : next.stones_gone)
    if (std::erase_if(to.stones, [&](const PlacedStone& one) { return one.stone.id == gone.stone.id; }) == 0)
      to.stones_gone.push_back(gone);
  to.stones.insert(to.stones.end(), next.stones.begin(), next.stones.end());
  to.joints_added.insert(to.joints_added.end(), next.joints_added.begin(), next.joints_added.end());
  to.joints_removed.insert(to.joints_removed.end(), next.joints_removed.begin(), next.joints_removed.end());
  sort_joints(to);
  if (next.regions != nullptr) to.regions = next.regions;
  if (next.signs != nullptr) to.signs = next.signs;
  to.notices.insert(to.notices.end(), next.notices.begin(), next.notices.end());
  std::vector<StoreContent> stores;
  std::ranges::set_union(next.stores, to.stores, std::back_inserter(stores), std::less<>(),
                         &StoreContent::store, &StoreContent::store);
  to.stores = std::move(stores);
  if (!next.settings.empty()) to.settings = next.settings;
  to.ledger = next.ledger;
  to.materials = next.materials;
  to.field_hash = next.field_hash;
  to.state_hash = next.state_hash;
}

}  // namespace

ReplaySource::ReplaySource(std::unique_ptr<State> state) : state_(std::move(state)) {}
ReplaySource::~ReplaySource() = default;

Result<std::unique_ptr<ReplaySource>> ReplaySource::open(const std::string& path, Tick from,
                                                         const GroundGiver& ground,
                                                         WithoutTicks without_ticks) {
  auto reader = TRY(RecordingReader::open(path, without_ticks));
  RecordingHeader header = reader->header();
  if (auto given = give_ground(header.world.ground, header.world.terrain, ground); !given)
    return fail(fmt::format("{}: {}", path, given.error().message));
  auto source = std::unique_ptr<ReplaySource>(
      new ReplaySource(std::make_unique<State>(std::move(reader), std::move(header))));
  TRY(source->seek(from));
  return source;
}

const RecordingHeader& ReplaySource::header() const {
  return state_->header;
}
Tick ReplaySource::tick() const {
  return state_->world.tick();
}
Tick ReplaySource::first_tick() const {
  return state_->start();
}
Tick ReplaySource::last_tick() const {
  return state_->reader->last_tick();
}
bool ReplaySource::is_ended() const {
  return state_->reader->is_ended();
}
Result<void> ReplaySource::refresh() {
  return state_->reader->refresh();
}
void ReplaySource::let_go() {
  state_->reader->let_go();
}

Result<std::vector<PlayerCursor>> ReplaySource::cursors() {
  return state_->cursors.at(*state_->reader, state_->world.tick());
}

Result<std::shared_ptr<const MarksMessage>> ReplaySource::marks() {
  if (!state_->reader->events_from()) return nullptr;
  TRY(state_->marks.read_on(*state_->reader));
  return state_->marks.message();
}

Result<std::shared_ptr<const TickDelta>> ReplaySource::next() {
  return next(1);
}

Result<std::shared_ptr<const TickDelta>> ReplaySource::next(Tick count) {
  CHECK(count > 0);
  if (std::exchange(state_->keyframe_due, false)) return state_->world.whole_state();
  if (state_->world.tick() >= last_tick()) return nullptr;
  CHECK(state_->world.tick() >= first_tick());
  auto joint = TRY(state_->advance());
  float work_us = state_->world.work_us();
  for (; count > 1 && state_->world.tick() < last_tick() && work_us < joint_work_max_us; --count) {
    const auto more = TRY(state_->advance());
    append(*joint, *more);
    work_us += state_->world.work_us();
  }
  state_->world.tell_spawn(*joint);
  return joint;
}

Result<std::shared_ptr<const TickDelta>> ReplaySource::jump(Tick to) {
  CHECK(to >= first_tick() && to <= last_tick());
  BricksBefore before;
  const PlayedMoment from = state_->world.moment();
  TRY(state_->go_to(to, before));
  auto delta = state_->world.differences(from, before);
  state_->world.tell_spawn(*delta);
  return delta;
}

Spawn ReplaySource::spawn() {
  return state_->world.spawn();
}

std::shared_ptr<const TickDelta> ReplaySource::same() const {
  return state_->world.unchanged();
}

Result<std::optional<Tick>> ReplaySource::next_event(Tick after) {
  if (state_->reader->events_from()) return state_->reader->next_event(after);
  const Tick end = std::min(last_tick(), after + looked_through_max);
  for (Tick at = after + 1; at <= end; ++at) {
    const auto begins = TRY(state_->begins_something(at));
    if (begins) return std::optional(at);
  }
  return std::optional<Tick>();
}

Result<std::optional<Tick>> ReplaySource::previous_event(Tick before) {
  if (state_->reader->events_from()) return state_->reader->previous_event(before);
  for (Tick at = before, looked = 0; at > first_tick() + 1 && looked < looked_through_max; ++looked) {
    const auto begins = TRY(state_->begins_something(--at));
    if (begins) return std::optional(at);
  }
  return std::optional<Tick>();
}

Result<void> ReplaySource::seek(Tick tick) {
  if (tick > last_tick())
    return fail(
        fmt::format("{}: tick {} is after its end, {} (--from)", state_->reader->path(), tick, last_tick()));
  const Tick start = first_tick();
  if (tick == 0) tick = start;
  if (tick < start)
    return fail(
        fmt::format("{}: tick {} is before its start, {} (--from)", state_->reader->path(), tick, start));
  BricksBefore forgotten;
  TRY(state_->restore_before(tick, forgotten));
  TRY(state_->go_to(tick, forgotten));
  state_->keyframe_due = tick != 0 || last_tick() == 0;
  return {};
}

}  // namespace scree
