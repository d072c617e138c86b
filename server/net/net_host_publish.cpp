// NetHost's part of a tick: its messages are composed, queued, and handed to the sockets.
#include <algorithm>
#include <chrono>
#include <iterator>
#include <span>
#include <utility>

#include "server/net/net_host.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

void NetHost::publish(const TickDelta& delta, const TickSpan& span, bool more) {
  CHECK(network_thread_.is_the_same());
  CHECK_EQ(publisher_.clients(), joined_count());
  if (delta.service && *delta.service != service_) grant(*delta.service);
  for (const Reply& reply : delta.replies)
    if (reply.reason) counts_.refusals.add(*reply.reason);
  publisher_.set_refusals(counts_.refusals);
  const auto backlog = [this](uint64_t id) {
    const auto entry = sessions_.find(id);
    return entry == sessions_.end() ? Backlog() : entry->second.session->backlog();
  };
  if (delta.tick % config_.tick_rate_hz == 0) publisher_.set_latency(request_times_.take_status());
  if (config_.saving) publisher_.set_saving(config_.saving());
  auto found = sessions_.begin();
  for (Outgoing& outgoing : publisher_.publish(delta, backlog)) {
    // Most come in the sessions' order.
    if (found != sessions_.end() && found->first < outgoing.session) ++found;
    if (found == sessions_.end() || found->first != outgoing.session)
      found = sessions_.find(outgoing.session);
    if (found == sessions_.end()) continue;
    Entry& entry = found->second;
    if (!std::exchange(entry.unflushed, true)) unflushed_.push_back({entry.session, delta.tick});
    entry.session->queue(std::move(outgoing.bytes));
  }
  log_settings(delta);
  answer(delta, span);
  flush_some(delta.tick, more);
  update_stats();
}

/// Those whose turn it is: they wait in the order in which they began to. A recording's ticks may go back.
void NetHost::flush_some(Tick tick, bool more) {
  const auto waits_still = [&](const Unflushed& one) {
    return one.since <= tick && tick - one.since + 1 < limits::ticks_per_flush_max;
  };
  const auto waited = std::ranges::find_if(unflushed_, waits_still) - unflushed_.begin();
  flush(flush_rate_.due(unflushed_.size(), static_cast<size_t>(waited), more));
  if (!more && !unflushed_.empty()) flush_later();
}

/// In case that no tick follows soon.
void NetHost::flush_later() {
  const std::chrono::duration<double> wait_s(limits::flush_wait_ticks_max / config_.tick_rate_hz);
  flush_timer_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(wait_s));
  flush_timer_.async_wait([this](asio::error_code error) {
    if (!error) flush();
  });
}

void NetHost::flush() {
  flush(unflushed_.size());
}

/// The first `count` that wait.
void NetHost::flush(size_t count) {
  CHECK(count <= unflushed_.size());
  flush_timer_.cancel();
  const double begin_s = steady_now_s();
  const auto end = unflushed_.begin() + static_cast<std::ptrdiff_t>(count);
  std::vector<Unflushed> turn(std::make_move_iterator(unflushed_.begin()), std::make_move_iterator(end));
  unflushed_.erase(unflushed_.begin(), end);
  workers_.share(std::span(turn), limits::sessions_per_part, [](size_t, std::span<Unflushed> some) {
    for (const Unflushed& one : some) one.session->send_now();
  });
  for (const auto& [session, since] : turn) {
    const auto found = sessions_.find(session->id());
    const bool is_its =
        found != sessions_.end() && found->second.session == session;  // or it goes on as another
    if (is_its) found->second.unflushed = false;
    session->settle();
  }
  flush_rate_.flushed(count, steady_now_s() - begin_s);
}

}  // namespace scree
