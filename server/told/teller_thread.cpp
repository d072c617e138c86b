// WorldTeller's thread.
#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <pthread.h>

#include "server/log/log.h"
#include "server/told/told_parts.h"
#include "server/told/world_teller_state.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

void WorldTeller::State::run() {
  ::pthread_setname_np(::pthread_self(), "teller");
  for (bool last = false; !last;) {
    auto entries = take(last);
    look_at_bus();
    for (Entry& entry : entries) tell(entry);
    if (is_keyframe_due(steady_now_s())) begin_keyframe();
    if (sending) send_parts();
  }
}

std::deque<WorldTeller::State::Entry> WorldTeller::State::take(bool& last) {
  std::unique_lock lock(mutex);
  if (!sending)
    changed.wait_for(lock, std::chrono::duration<double>(limits::told_wait_s),
                     [this] { return stopping || !queue.empty(); });
  last = stopping;
  status.connected = bus->is_connected();
  return std::exchange(queue, {});
}

void WorldTeller::State::tell(Entry& entry) {
  if (entry.start) {
    if (const auto begun = begin_with(*entry.start); !begun) lose_state(begun.error().message);
    return;
  }
  if (writer == nullptr) return count_lost(1);  // of a state that was lost
  if (const auto told = tell_tick(*entry.delta); !told) lose_state(told.error().message);
}

Result<void> WorldTeller::State::begin_with(Start& start) {
  sending.reset();
  rows = std::make_unique<ToldRows>();
  writer = std::make_unique<KeyframeWriter>(*rows, settings);
  writer->begin(start.keyframe, published, std::move(start.read));
  TRY(writer->put(published));
  keyframe_is_due = true;
  return {};
}

/// The state goes on, told or not. An error: it cannot.
Result<void> WorldTeller::State::tell_tick(const TickDelta& delta) {
  const bool tells = may_tell();
  const std::vector<uint8_t> bytes =
      tells ? encode_told(to_recorded(delta, published)) : std::vector<uint8_t>();
  has_changed = has_changed || !delta.bricks.empty() || !delta.pieces.empty();
  TRY(writer->apply(delta, published));
  if (!tells) {
    count_lost(1);
    leave_gap("NATS is away");
    return {};
  }
  if (bytes.size() > limits::told_tick_bytes_max) {
    count_lost(1);
    leave_gap("a tick is too large (limits.told_tick_bytes_max)");
    return {};
  }
  const size_t part_bytes = told_part_bytes(bus->payload_max());
  for (uint32_t number = 0; number < told_parts_of(bytes.size(), part_bytes); ++number) {
    const auto kept =
        bus->keep_later(names.tick(), encode(told_part(run_number, delta.tick, bytes, part_bytes, number)));
    if (kept) continue;
    count_lost(1);
    leave_gap(kept.error().message);
    stream_is_open = false;  // no tick waits for the next answer
    retry_s = steady_now_s() + limits::told_retry_s;
    return {};
  }
  tail_bytes += static_cast<double>(bytes.size());
  count_told(bytes.size());
  return {};
}

void WorldTeller::State::lose_state(const std::string& why) {
  writer.reset();
  rows.reset();
  sending.reset();
  log_of(LogPart::bus).error("the world {} is told anew: {}", config.world, why);
  const std::scoped_lock lock(mutex);
  wants_start = true;
}

/// A connection that was lost may have lost messages, and so has a stream that did not keep one.
void WorldTeller::State::look_at_bus() {
  const uint64_t now = bus->connections();
  if (now != connections && bus->is_connected()) {
    connections = now;
    stream_is_open = false;
    retry_s = 0.0;
    leave_gap("");
  }
  if (const uint64_t failed = bus->keep_failures(); failed != failures) {
    failures = failed;
    leave_gap(bus->fault());
    stream_is_open = false;
  }
  if (!bus->is_connected()) return note("NATS is away: " + bus->fault());
  const double now_s = steady_now_s();
  if (stream_is_open || now_s < retry_s) return;
  retry_s = now_s + limits::told_retry_s;
  const auto opened =
      bus->open_stream({names.stream, names.kept(), static_cast<uint64_t>(stream_bytes()), config.in_memory});
  stream_is_open = opened.has_value();
  if (!opened) note(opened.error().message);
}

void WorldTeller::State::leave_gap(const std::string& why) {
  sending.reset();
  keyframe_is_due = true;
  if (!why.empty()) note(why);
}

void WorldTeller::State::count_lost(uint64_t ticks) {
  const std::scoped_lock lock(mutex);
  status.health.lost += ticks;
}

void WorldTeller::State::count_told(size_t bytes) {
  const std::scoped_lock lock(mutex);
  ++status.ticks;
  status.bytes += bytes;
}

/// Each fault once, and its end.
void WorldTeller::State::note(const std::optional<std::string>& because) {
  bool is_new = false;
  uint64_t lost = 0;
  {
    const std::scoped_lock lock(mutex);
    StoreHealth& health = status.health;
    is_new = health.ok() == because.has_value();
    if (because && health.ok()) health.since_unix_ms = unix_now_ms();
    if (!because) health.since_unix_ms = 0;
    health.because = because;
    lost = health.lost;
  }
  if (!is_new) return;
  const auto more = log_limit.admit(because ? "not told" : "told again", steady_now_s());
  if (!more) return;
  if (because)
    log_of(LogPart::bus).warn("the world {} is not told: {}{}", config.world, *because, *more);
  else
    log_of(LogPart::bus).info("the world {} is told; {} ticks were not{}", config.world, lost, *more);
}

// ---- keyframes

bool WorldTeller::State::is_keyframe_due(double now_s) const {
  if (sending || writer == nullptr || !may_tell() || now_s < retry_s) return false;
  if (keyframe_is_due || tail_bytes > limits::told_tail_share * stream_bytes()) return true;
  const double usual_s = has_changed ? config.keyframe_s : limits::told_still_keyframe_s;
  return now_s - keyframe_s > std::max(usual_s, keyframe_took_s / limits::told_keyframe_share);
}

Result<void> WorldTeller::State::compose_keyframe(std::vector<uint8_t>& bytes) {
  TRY(writer->put(published));
  bytes = encode(TRY(rows->keyframe(header, config.world_number)));
  return {};
}

void WorldTeller::State::begin_keyframe() {
  const double begun_s = steady_now_s();
  Sending next{published.tick(), {}, 0, 0, bus->keep_failures()};
  if (const auto composed = compose_keyframe(next.bytes); !composed)
    return lose_state(composed.error().message);
  keyframe_s = begun_s;
  keyframe_took_s = steady_now_s() - begun_s;
  has_changed = false;
  const double most_bytes = std::min(limits::told_keyframe_bytes_share * stream_bytes(),
                                     static_cast<double>(limits::told_keyframe_bytes_max));
  if (static_cast<double>(next.bytes.size()) > most_bytes) {
    retry_s = begun_s + limits::told_still_keyframe_s;
    return note(
        fmt::format("a keyframe of {} MB is more than {:.0f} MB, which the stream has for it "
                    "(--nats-stream-mb)",
                    next.bytes.size() / 1000000, most_bytes / 1e6));
  }
  sending = std::move(next);
}

void WorldTeller::State::send_parts() {
  for (int sent = 0; sending && sent < limits::told_parts_at_once; ++sent)
    if (const auto part = send_part(); !part) {
      retry_s = steady_now_s() + limits::told_retry_s;
      return leave_gap(part.error().message);
    }
}

/// The first part's place is known before the next is sent; and the last message follows when all are kept.
Result<void> WorldTeller::State::send_part() {
  Sending& now = *sending;
  const size_t part_bytes = told_part_bytes(bus->payload_max());
  if (now.next == told_parts_of(now.bytes.size(), part_bytes)) {
    TRY(bus->keep(names.whole(), encode(ToldWhole{run_number, now.tick, now.begins})));
    if (bus->keep_failures() != now.failures || bus->connections() != connections)
      return fail("a part of a keyframe was lost");
    finish_keyframe();
    return {};
  }
  const auto part = encode(told_part(run_number, now.tick, now.bytes, part_bytes, now.next));
  if (now.next == 0)
    now.begins = TRY(bus->keep(names.keyframe(), part));
  else
    TRY(bus->keep_later(names.keyframe(), part));
  ++now.next;
  return {};
}

void WorldTeller::State::finish_keyframe() {
  const size_t bytes = sending->bytes.size();
  sending.reset();
  keyframe_is_due = false;
  tail_bytes = 0.0;
  {
    const std::scoped_lock lock(mutex);
    ++status.keyframes;
    status.keyframe_bytes += bytes;
    status.last_keyframe_bytes = bytes;
  }
  note(std::nullopt);
}

}  // namespace scree
