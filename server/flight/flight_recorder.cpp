#include "server/flight/flight_recorder.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "proto/limits.h"
#include "server/flight/limits.h"
#include "shared/field/voxel_vector.h"

namespace scree {

namespace {

/// Work in place of requests: what was broken earlier is cut, falls, merges.
std::vector<FlightCause> causes_by_operation(const TickDelta& delta, float voxel_size_m) {
  std::map<std::pair<uint64_t, TickStage>, FlightCause> by_party;
  std::array<uint32_t, tick_stages.size()> all{};
  for (const AppliedOperation& applied : delta.operations) {
    if (!applied.stage || *applied.stage == TickStage::requests) continue;
    ++all[index_of(*applied.stage)];
    FlightCause& cause = by_party[{applied.party, *applied.stage}];
    if (cause.count == 0 && !applied.writes.empty())
      cause.place_m = voxel_size_m * as_vector(first_voxel(applied.writes.front()));
    ++cause.count;
  }
  std::vector<FlightCause> causes;
  for (auto& [who, cause] : by_party) {
    const size_t at = index_of(who.second);
    const float share = static_cast<float>(cause.count) / static_cast<float>(all[at]);
    cause.party = who.first;
    cause.stage = who.second;
    cause.clock_ms = share * static_cast<float>(delta.times.ms[at]);
    cause.price_ms = share * static_cast<float>(delta.times.model_ms[at]);
    causes.push_back(cause);
  }
  return causes;
}

bool is_the_same(const SlowEpisode& before, const SlowEpisode& now) {
  const auto of = [](const SlowEpisode& slow) {
    const bool is_work = slow.diagnosis.culprit == Culprit::work || slow.diagnosis.culprit == Culprit::crowd;
    return std::tuple(slow.diagnosis.culprit, is_work ? slow.diagnosis.stage : TickStage::requests,
                      slow.diagnosis.cause ? slow.diagnosis.cause->party : 0);
  };
  const auto together_ms = static_cast<uint64_t>(limits::slow_together_s * 1e3);
  return of(before) == of(now) && now.worst.unix_ms <= before.worst.unix_ms + together_ms;
}

/// What ticks are compared by: those that made the game late come first.
std::pair<float, float> badness(const FlightTick& tick) {
  return {tick.late_ms(), tick.wall_ms};
}

}  // namespace

std::vector<FlightCause> causes_of(const TickDelta& delta, float voxel_size_m) {
  std::vector<FlightCause> causes = causes_by_operation(delta, voxel_size_m);
  for (const RequestCost& cost : delta.costs) {
    const auto is_same = [&](const FlightCause& cause) {
      return cause.stage == TickStage::requests && cause.session == cost.session &&
             cause.request == cost.kind;
    };
    auto found = std::ranges::find_if(causes, is_same);
    if (found == causes.end()) {
      causes.push_back({.party = cost.party, .session = cost.session, .request = cost.kind});
      found = causes.end() - 1;
    }
    if (cost.clock_us * 1e-3F > found->clock_ms) found->place_m = cost.place_m;
    ++found->count;
    found->clock_ms += cost.clock_us * 1e-3F;
    found->price_ms += cost.price_us * 1e-3F;
  }
  std::ranges::sort(causes, std::greater(), &FlightCause::clock_ms);
  if (causes.size() > limits::flight_causes_a_tick_max) causes.resize(limits::flight_causes_a_tick_max);
  return causes;
}

void describe(const TickDelta& delta, FlightTick& tick) {
  tick.tick = delta.tick;
  for (size_t i = 0; i < tick_stages.size(); ++i) {
    tick.stage_ms[i] = static_cast<float>(delta.times.ms[i]);
    tick.model_ms[i] = static_cast<float>(delta.times.model_ms[i]);
  }
  tick.budget_us = delta.work.budget_us;
  tick.estimate_us = delta.work.estimate_us;
  tick.pieces = static_cast<uint32_t>(delta.pieces.size());
  tick.contacts = static_cast<uint32_t>(delta.work.bodies.contact_points + delta.work.bodies.ground_points);
  tick.requests_waiting = delta.work.requests_waiting;
}

FlightCrowd crowd_of(const TickDelta& delta, const PartyCounts& parties) {
  if (delta.pieces.size() < limits::flight_crowd_pieces) return {};
  struct Box {
    uint32_t pieces = 0;
    glm::vec3 first_m{0.0F};
  };
  std::map<std::tuple<int, int, int>, Box> boxes;
  std::map<uint64_t, uint32_t> by_party;
  for (const PieceState& piece : delta.pieces) {
    const glm::vec3 at_m = dequantise(piece.pose).position_m;
    const auto side = [](float metres) { return floor_to_int(metres / limits::flight_crowd_m); };
    Box& box = boxes[{side(at_m.x), side(at_m.y), side(at_m.z)}];
    if (box.pieces++ == 0) box.first_m = at_m;
    ++by_party[parties.party_of(piece.id)];
  }
  const Box& box =
      std::ranges::max_element(boxes, {}, [](const auto& one) { return one.second.pieces; })->second;
  const auto most = std::ranges::max_element(by_party, {}, [](const auto& one) { return one.second; });
  return {box.pieces, box.first_m, most->first, most->second};
}

FlightRecorder::FlightRecorder(FlightConfig config)
    : config_(std::move(config)), lines_(limits::slow_lines_per_minute / 60.0, limits::slow_lines_burst) {}

Result<std::unique_ptr<FlightRecorder>> FlightRecorder::open(FlightConfig config) {
  const std::string path = config.log_path;
  auto recorder = std::make_unique<FlightRecorder>(std::move(config));
  if (path.empty()) return recorder;
  auto log = TRY(EventLog::open(path));
  recorder->log_ = std::move(log);
  return recorder;
}

void FlightRecorder::add(FlightTick tick, const TickDelta& delta) {
  describe(delta, tick);
  tick.tick_ms = 1e3F / static_cast<float>(config_.tick_rate_hz);
  const std::vector<FlightCause> causes = causes_of(delta, config_.voxel_size_m);
  const std::scoped_lock lock(mutex_);
  parties_.add(tick, causes, delta, seconds_at(tick.tick));
  const bool may_be_slow = static_cast<double>(tick.late_ms()) > config_.slow.late_ms;
  if (may_be_slow) tick.crowd = crowd_of(delta, parties_);
  keep(tick, causes);
  const Diagnosis found = diagnose(tick, causes, config_.slow);
  if (found.culprit != Culprit::none) note_slow(tick, causes, found);
}

void FlightRecorder::keep(const FlightTick& tick, std::span<const FlightCause> causes) {
  if (tick.tick <= last_tick_) {  // a replay went back
    ticks_.clear();
    causes_.clear();
  }
  last_tick_ = tick.tick;
  ticks_.push_back(tick);
  for (const FlightCause& cause : causes) causes_.push_back({tick.tick, cause});
  if (ticks_.size() > limits::flight_ticks_max) ticks_.pop_front();
  while (causes_.size() > limits::flight_causes_max) causes_.pop_front();
}

FlightNames FlightRecorder::names() const {
  return {[this](uint64_t session) {
            const auto found = names_.find(session);
            return found == names_.end() ? std::string() : found->second;
          },
          config_.request_name};
}

SlowEpisode FlightRecorder::episode_of(const FlightTick& tick, const Diagnosis& found) const {
  const FlightNames names = this->names();
  SlowEpisode slow{.worst = tick, .diagnosis = found, .words = words_of(tick, found, names), .name = {}};
  uint64_t who = found.culprit == Culprit::crowd ? tick.crowd.party : 0;
  if (found.culprit == Culprit::work && found.cause)
    who = found.cause->session != 0 ? found.cause->session : found.cause->party;
  if (who != 0) slow.name = names.session(who);
  return slow;
}

void FlightRecorder::note_slow(const FlightTick& tick, std::span<const FlightCause> causes,
                               const Diagnosis& found) {
  SlowEpisode slow = episode_of(tick, found);
  log(slow, causes);
  if (!slow_.empty() && is_the_same(slow_.back(), slow)) {
    SlowEpisode& before = slow_.back();
    const uint32_t ticks = before.ticks + 1;
    if (badness(slow.worst) > badness(before.worst)) before = std::move(slow);
    before.ticks = ticks;
    before.worst.unix_ms = std::max(before.worst.unix_ms, tick.unix_ms);
    return;
  }
  slow_.push_back(std::move(slow));
  if (slow_.size() > limits::slow_rows_max) slow_.pop_front();
}

void FlightRecorder::log(const SlowEpisode& slow, std::span<const FlightCause> causes) {
  if (log_ == nullptr) return;
  if (!lines_.try_spend(static_cast<double>(slow.worst.unix_ms) * 1e-3)) {
    ++lines_left_out_;
    return;
  }
  log_->push(slow_line(slow, causes, names(), std::exchange(lines_left_out_, 0)));
}

void FlightRecorder::name(uint64_t session, const std::string& name) {
  const std::scoped_lock lock(mutex_);
  names_[session] = name;
  if (names_.size() > limits::flight_names_max) names_.erase(names_.begin());
}

std::vector<SlowEpisode> FlightRecorder::slow(uint64_t since_unix_ms) const {
  const std::scoped_lock lock(mutex_);
  std::vector<SlowEpisode> found;
  for (const SlowEpisode& slow : slow_)
    if (slow.worst.unix_ms >= since_unix_ms) found.push_back(slow);
  return found;
}

/// Must be locked.
std::vector<FlightCause> FlightRecorder::causes_in(Tick tick) const {
  std::vector<FlightCause> causes;
  auto kept = std::ranges::lower_bound(causes_, tick, {}, &Kept::tick);
  for (; kept != causes_.end() && kept->tick == tick; ++kept) causes.push_back(kept->cause);
  return causes;
}

/// The simulation may add a tick between two looks at a few.
std::vector<SlowEpisode> FlightRecorder::worst(uint64_t since_unix_ms, size_t most) const {
  constexpr size_t at_once = 2048;
  std::vector<FlightTick> found;
  most = std::min(most, limits::slow_rows_max);
  for (Tick next = 0;;) {
    const std::scoped_lock lock(mutex_);
    auto from = std::ranges::lower_bound(ticks_, next, {}, &FlightTick::tick);
    if (from == ticks_.end()) break;
    for (size_t i = 0; i < at_once && from != ticks_.end(); ++i, ++from) {
      next = from->tick + 1;
      if (from->unix_ms < since_unix_ms) continue;
      found.push_back(*from);
      std::ranges::push_heap(found, std::greater(), badness);
      if (found.size() <= most) continue;
      std::ranges::pop_heap(found, std::greater(), badness);
      found.pop_back();
    }
  }
  std::ranges::sort(found, {}, &FlightTick::tick);
  const std::scoped_lock lock(mutex_);
  std::vector<SlowEpisode> rows;
  for (const FlightTick& tick : found)
    rows.push_back(episode_of(tick, diagnose(tick, causes_in(tick.tick), {-1.0, config_.slow.save_ms})));
  return rows;
}

std::vector<PartyWork> FlightRecorder::parties() const {
  const std::scoped_lock lock(mutex_);
  std::vector<PartyWork> rows = parties_.all(seconds_at(last_tick_));
  const FlightNames known = names();
  for (PartyWork& row : rows) row.name = known.session(row.party);
  return rows;
}

size_t FlightRecorder::bytes_max() {
  return limits::flight_ticks_max * sizeof(FlightTick) + limits::flight_causes_max * sizeof(Kept);
}

size_t FlightRecorder::ticks_kept() const {
  const std::scoped_lock lock(mutex_);
  return ticks_.size();
}

Result<void> FlightRecorder::finish() {
  return log_ ? log_->finish() : Result<void>();
}

}  // namespace scree
