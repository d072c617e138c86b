#include "server/told/told_reader.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <fmt/format.h>
#include <mutex>
#include <pthread.h>
#include <thread>
#include <utility>

#include "server/told/limits.h"
#include "server/told/told_names.h"
#include "server/told/told_parts.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

std::chrono::duration<double> seconds_of(double s) {
  return std::chrono::duration<double>(s);
}

}  // namespace

struct ToldReader::State {
  State(std::shared_ptr<Bus> b, const std::string& world) : bus(std::move(b)), names(world) {}

  void run();
  void listened(std::span<const uint8_t> bytes);
  std::optional<std::vector<uint8_t>> next_message();
  void take(std::span<const uint8_t> bytes);
  void take_tick(ToldAssembly::Value value);
  Result<void> catch_up();
  Result<void> read_on(uint64_t sequence, const ToldWhole& whole, bool needs_keyframe);
  struct Between {
    std::deque<ToldAssembly::Value> ticks;
    size_t bytes = 0;
  };
  Result<void> take_kept(const KeptMessage& message, const ToldWhole& whole, bool& needs_keyframe,
                         Between& between);
  Result<void> give_keyframe(const ToldWhole& whole, std::span<const uint8_t> bytes);
  void give(ReadTold told);
  void refuse();
  void look_at_bus();
  void set_fault(std::string words);

  // Members of the thread.
  const std::shared_ptr<Bus> bus;
  const ToldNames names;
  ToldAssembly live{limits::told_tick_bytes_max};
  ToldAssembly kept_ticks{limits::told_tick_bytes_max};
  ToldAssembly kept_keyframe{limits::told_keyframe_bytes_max};
  uint64_t run_number = 0;  ///< of what was given last; 0: nothing was
  Tick tick = 0;            ///< likewise
  uint64_t connections = 0;
  bool is_behind = true;  ///< the stream has to be read
  double retry_s = 0.0;
  double heard_s = 0.0;        ///< when the last message came, or the stream was read
  uint64_t read_from = 0;      ///< where the keyframe begins from which the stream was read last
  uint64_t next_sequence = 0;  ///< what follows of the stream behind that
  std::unique_ptr<BusSubscription> subscription;
  std::thread thread;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::deque<std::vector<uint8_t>> messages;  ///< that came, and were not looked at
  std::deque<ReadTold> ready;
  bool anew = false;  ///< begin_anew() was called
  bool stopping = false;
  ReaderStatus status;
};

void ToldReader::State::listened(std::span<const uint8_t> bytes) {
  {
    const std::scoped_lock lock(mutex);
    if (messages.size() >= limits::told_messages_max) return;  // the gap is seen by the next tick
    messages.emplace_back(bytes.begin(), bytes.end());
  }
  changed.notify_all();
}

void ToldReader::State::run() {
  ::pthread_setname_np(::pthread_self(), "told reader");
  for (;;) {
    {
      std::unique_lock lock(mutex);
      if (stopping) return;
      if (std::exchange(anew, false)) {
        run_number = tick = 0;
        is_behind = true;
      }
    }
    look_at_bus();
    const double now_s = steady_now_s();
    // A message that came before the subscription, or while it was made again, is seen by the stream alone.
    if (now_s > heard_s + limits::told_silent_s) is_behind = true;
    if (is_behind && now_s >= retry_s && bus->is_connected()) {
      retry_s = now_s + limits::told_retry_s;
      const auto caught_up = catch_up();
      is_behind = !caught_up.has_value();
      heard_s = steady_now_s();
      set_fault(caught_up ? std::string() : caught_up.error().message);
      continue;
    }
    if (const auto message = next_message()) take(*message);
  }
}

void ToldReader::State::look_at_bus() {
  const uint64_t now = bus->connections();
  if (now != connections) {
    connections = now;
    is_behind = true;
    retry_s = 0.0;
  }
  const bool connected = bus->is_connected();
  const std::scoped_lock lock(mutex);
  status.connected = connected;
  if (!connected) status.fault = "NATS is away: " + bus->fault();
}

void ToldReader::State::set_fault(std::string words) {
  const std::scoped_lock lock(mutex);
  status.fault = std::move(words);
}

std::optional<std::vector<uint8_t>> ToldReader::State::next_message() {
  std::unique_lock lock(mutex);
  changed.wait_for(lock, seconds_of(limits::told_wait_s),
                   [this] { return stopping || anew || !messages.empty(); });
  if (stopping || anew || messages.empty()) return std::nullopt;
  auto message = std::move(messages.front());
  messages.pop_front();
  heard_s = steady_now_s();
  return message;
}

void ToldReader::State::take(std::span<const uint8_t> bytes) {
  auto part = decode_told_part(bytes);
  if (!part) return refuse();
  if (auto value = live.add(std::move(*part)); value && !is_behind) take_tick(std::move(*value));
}

/// A tick of another run may be a new simulation's, which a keyframe proves, or anybody's.
void ToldReader::State::take_tick(ToldAssembly::Value value) {
  if (value.run == run_number && value.tick <= tick) return;
  if (value.run != run_number || value.tick != tick + 1) {
    is_behind = true;
    return;
  }
  auto frame = decode_told(value.bytes);
  if (!frame || frame->tick != value.tick) {
    refuse();
    is_behind = true;
    return;
  }
  tick = value.tick;
  give(ReadTick{value.run, std::move(*frame)});
}

void ToldReader::State::refuse() {
  const std::scoped_lock lock(mutex);
  ++status.refused;
}

void ToldReader::State::give(ReadTold told) {
  std::unique_lock lock(mutex);
  changed.wait(lock, [this] { return stopping || anew || ready.size() < limits::told_ready_max; });
  if (stopping || anew) return;
  if (std::holds_alternative<ReadTick>(told))
    ++status.ticks;
  else
    ++status.keyframes;
  ready.push_back(std::move(told));
  lock.unlock();
  changed.notify_all();
}

// ---- the stream

/// Reads what the stream has, up to its end. An error: there is no whole keyframe, or none that helps.
Result<void> ToldReader::State::catch_up() {
  {
    const std::scoped_lock lock(mutex);
    ++status.catch_ups;
  }
  const auto last = TRY(bus->last_kept(names.stream, names.whole()));
  if (!last) return fail("nothing is told of this world");
  const auto whole = decode_told_whole(last->bytes);
  if (!whole) {
    refuse();
    return tl::unexpected(whole.error());
  }
  kept_ticks.reset();
  kept_keyframe.reset();
  const bool needs_keyframe = whole->run != run_number || tick < whole->tick;
  const bool goes_on = !needs_keyframe && read_from == whole->begins;
  read_from = whole->begins;
  return read_on(goes_on ? next_sequence : whole->begins, *whole, needs_keyframe);
}

Result<void> ToldReader::State::read_on(uint64_t sequence, const ToldWhole& whole, bool needs_keyframe) {
  Between between;
  for (;; ++sequence) {
    const auto message = TRY(bus->kept(names.stream, sequence));
    if (!message) break;
    TRY(take_kept(*message, whole, needs_keyframe, between));
    const std::scoped_lock lock(mutex);
    if (stopping || anew) return fail("it is left off");
  }
  next_sequence = sequence;
  if (needs_keyframe) return fail("the stream has no whole keyframe of this world");
  return {};
}

/// Ticks wait until the keyframe before them is whole.
Result<void> ToldReader::State::take_kept(const KeptMessage& message, const ToldWhole& whole,
                                          bool& needs_keyframe, Between& between) {
  const bool is_tick = message.subject == names.tick();
  if (!is_tick && (message.subject != names.keyframe() || !needs_keyframe)) return {};
  auto part = decode_told_part(message.bytes);
  if (!part || part->run != whole.run || (!is_tick && part->tick != whole.tick)) {
    if (!part) refuse();
    return {};
  }
  if (is_tick) {
    auto value = kept_ticks.add(std::move(*part));
    if (!value || value->tick <= whole.tick) return {};
    if (!needs_keyframe) {
      take_tick(std::move(*value));
      return {};
    }
    between.bytes += value->bytes.size();
    if (between.bytes > limits::told_between_bytes_max)
      return fail("too much comes between the parts of a keyframe (limits.told_between_bytes_max)");
    between.ticks.push_back(std::move(*value));
    return {};
  }
  const auto value = kept_keyframe.add(std::move(*part));
  if (!value) return {};
  TRY(give_keyframe(whole, value->bytes));
  needs_keyframe = false;
  for (ToldAssembly::Value& one : between.ticks) take_tick(std::move(one));
  between = {};
  return {};
}

Result<void> ToldReader::State::give_keyframe(const ToldWhole& whole, std::span<const uint8_t> bytes) {
  auto told = decode_told_keyframe(bytes);
  if (!told) {
    refuse();
    return tl::unexpected(told.error());
  }
  run_number = whole.run;
  tick = whole.tick;
  give(ReadKeyframe{whole.run, whole.tick, std::move(*told)});
  return {};
}

// ---- calls

ToldReader::ToldReader(std::unique_ptr<State> state) : state_(std::move(state)) {}

Result<std::unique_ptr<ToldReader>> ToldReader::start(std::shared_ptr<Bus> bus, const std::string& world) {
  if (!is_bus_name(world))
    return fail("'" + world + "' is no name of a world on a bus: write a-z, 0-9, - and _ (--world-name)");
  auto state = std::make_unique<State>(std::move(bus), world);
  State* const s = state.get();
  s->subscription = TRY(s->bus->subscribe(
      s->names.tick(), [s](const std::string&, std::span<const uint8_t> bytes) { s->listened(bytes); }));
  s->thread = std::thread([s] { s->run(); });
  return std::unique_ptr<ToldReader>(new ToldReader(std::move(state)));
}

ToldReader::~ToldReader() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  state_->thread.join();
  state_->subscription.reset();
}

std::optional<ReadTold> ToldReader::next(double wait_s) {
  std::unique_lock lock(state_->mutex);
  state_->changed.wait_for(lock, seconds_of(wait_s), [this] { return !state_->ready.empty(); });
  if (state_->ready.empty()) return std::nullopt;
  ReadTold next = std::move(state_->ready.front());
  state_->ready.pop_front();
  lock.unlock();
  state_->changed.notify_all();
  return next;
}

void ToldReader::begin_anew() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->anew = true;
    state_->ready.clear();
  }
  state_->changed.notify_all();
}

ReaderStatus ToldReader::status() const {
  const std::scoped_lock lock(state_->mutex);
  ReaderStatus status = state_->status;
  status.waiting = state_->ready.size();
  return status;
}

}  // namespace scree
