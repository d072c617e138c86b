// NetHost's part of a tick: its messages are composed, queued, and handed to the sockets.
#include <chrono>
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
  auto found = sessions_.begin();
  for (Outgoing& outgoing : publisher_.publish(delta, backlog)) {
    // Most come in the sessions' order.
    if (found != sessions_.end() && found->first < outgoing.session) ++found;
    if (found == sessions_.end() || found->first != outgoing.session)
      found = sessions_.find(outgoing.session);
    if (found == sessions_.end()) continue;
    Entry& entry = found->second;
    if (!std::exchange(entry.unflushed, true)) unflushed_.push_back(entry.session);
    entry.session->queue(std::move(outgoing.bytes));
  }
  log_settings(delta);
  answer(delta, span);
  if (flush_rate_.due(more))
    flush();
  else if (!more)
    flush_later();
  update_stats();
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
  flush_timer_.cancel();
  const double begin_s = steady_now_s();
  using Session = std::shared_ptr<ClientSession>;
  workers_.share(std::span(unflushed_), limits::sessions_per_part, [](size_t, std::span<Session> sessions) {
    for (const Session& session : sessions) session->send_now();
  });
  for (const Session& session : std::exchange(unflushed_, {})) {
    if (const auto found = sessions_.find(session->id()); found != sessions_.end())
      found->second.unflushed = false;
    session->settle();
  }
  flush_rate_.flushed(steady_now_s() - begin_s);
}

}  // namespace scree
