// NetHost: a tick's messages and replies on their way to the sessions.
#include <spdlog/spdlog.h>

#include "server/net/net_host.h"
#include "shared/base/timing.h"

namespace scree {

/// Null when there is no such session.
std::shared_ptr<ClientSession> NetHost::queue(Outgoing&& outgoing) {
  const auto entry = sessions_.find(outgoing.session);
  if (entry == sessions_.end()) return nullptr;
  entry->second.session->queue(std::move(outgoing.bytes));
  return entry->second.session;
}

/// Who asked gets the tick first, and at once, however far this thread lags.
void NetHost::answer(const TickDelta& delta, const TickSpan& span) {
  if (delta.replies.empty()) return;
  const auto latency = [&](const Reply& reply) {
    return request_times_.answered(reply.session, reply.request, span, steady_now_s());
  };
  std::vector<std::shared_ptr<ClientSession>> answered;
  for (Outgoing& outgoing : publisher_.answer(delta, latency))
    if (auto session = queue(std::move(outgoing))) answered.push_back(std::move(session));
  for (const auto& session : answered) session->settle();
  const std::scoped_lock lock(stats_mutex_);
  latency_ = request_times_.counts();
}

/// What was asked for is logged once it is so.
void NetHost::log_settings(const TickDelta& delta) {
  if (settings_asked_.empty()) return;
  for (const Reply& reply : delta.replies) {
    const auto asked = settings_asked_.extract({reply.session, reply.request});
    if (!asked.empty() && reply.refusal.empty()) spdlog::info("{}", asked.mapped());
  }
}

LatencyCounts NetHost::latency() const {
  const std::scoped_lock lock(stats_mutex_);
  return latency_;
}

}  // namespace scree
