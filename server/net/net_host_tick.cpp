// NetHost's ticks: what each client is sent of them, and when; and what others are told.
#include <fmt/format.h>
#include <utility>

#include "server/net/net_host.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

void NetHost::begin(const TickDelta& keyframe) {
  CHECK(network_thread_.is_the_same());
  if (keyframe.service && *keyframe.service != service_) grant(*keyframe.service);
  publisher_.begin(keyframe);
  update_stats();
}

void NetHost::publish(const TickDelta& delta, const TickSpan& span, bool more) {
  CHECK(network_thread_.is_the_same());
  CHECK_EQ(publisher_.clients(), sessions_.joined());
  const double begin_s = steady_now_s();
  if (delta.service && *delta.service != service_) grant(*delta.service);
  RefusalCounts& refusals = figures_.counts().refusals;
  for (const Reply& reply : delta.replies)
    if (reply.reason) {
      refusals.add(*reply.reason);
      if (SessionEntry* const entry = sessions_.find(reply.session)) ++entry->refused;
    }
  publisher_.set_refusals(refusals);
  if (delta.tick % config_.tick_rate_hz == 0) publisher_.set_latency(requests_.times().drain_status());
  if (config_.saving) publisher_.set_saving(config_.saving());
  share_bytes_out();
  queue_frames(delta, span.done_s);
  administration_.note_done(delta);
  answer(delta, span);
  flush_queue_.send_turn(delta.tick, more);
  stream_ground();
  for (const Refusal reason : publisher_.take_query_refusals()) refusals.add(reason);
  ground_pace_.ticked(steady_now_s() - begin_s, 1.0 / config_.tick_rate_hz, more);
  update_stats();
}

/// What each may be sent until the next call.
void NetHost::share_bytes_out() {
  std::vector<BytesOut::Receiver> receivers;
  sessions_.charge_bytes(bytes_out_, receivers);
  web_.list_receivers(receivers);
  bytes_out_.share(receivers, steady_now_s());
  web_.go_on();
}

Backlog NetHost::backlog_of(uint64_t session) const {
  const SessionEntry* const entry = sessions_.find(session);
  if (entry == nullptr) return {};
  Backlog backlog = entry->session->backlog();
  backlog.granted_bytes = entry->bytes_out.room;
  return backlog;
}

void NetHost::queue_frames(const TickDelta& delta, double done_s) {
  const auto backlog = [this](uint64_t session) { return backlog_of(session); };
  const auto& entries = sessions_.entries();
  auto found = entries.begin();
  for (Outgoing& outgoing : publisher_.publish(delta, backlog)) {
    // Most come in the sessions' order.
    if (found != entries.end() && found->first < outgoing.session) ++found;
    if (found == entries.end() || found->first != outgoing.session) found = entries.find(outgoing.session);
    if (found == entries.end()) continue;
    flush_queue_.add(found->second.session, delta.tick, done_s);
    found->second.session->queue(std::move(outgoing.bytes));
  }
}

/// Behind the frames of all, for it may take much longer.
void NetHost::stream_ground() {
  publisher_.set_ground_work(ground_pace_.work_per_tick());
  SessionTable::Sessions streamed;
  for (Outgoing& outgoing : publisher_.stream([this](uint64_t session) { return backlog_of(session); })) {
    const SessionEntry* const entry = sessions_.find(outgoing.session);
    if (entry == nullptr) continue;
    entry->session->queue(std::move(outgoing.bytes));
    if (streamed.empty() || streamed.back() != entry->session) streamed.push_back(entry->session);
  }
  for (const auto& session : streamed) session->settle();
}

/// Who asked gets the tick first, and at once, however far this thread lags.
void NetHost::answer(const TickDelta& delta, const TickSpan& span) {
  if (delta.replies.empty()) return;
  const auto latency = [&](const Reply& reply) {
    return requests_.times().answered(reply.session, reply.request, span, steady_now_s());
  };
  SessionTable::Sessions answered;
  for (Outgoing& outgoing : publisher_.answer(delta, latency)) {
    const SessionEntry* const entry = sessions_.find(outgoing.session);
    if (entry == nullptr) continue;
    entry->session->queue(std::move(outgoing.bytes));
    answered.push_back(entry->session);
  }
  for (const auto& session : answered) session->settle();
  figures_.show(requests_.times().counts());
}

// ---- what others are told

HealthMessage NetHost::health() {
  ServerHealth health = config_.health ? config_.health() : ServerHealth();
  if (stopping_) health.add(HealthKind::stopping, "the server stops");
  const double now_s = steady_now_s();
  if (!room_.has_place(sessions_, returns_.tickets().reserved_places(now_s), now_s))
    health.add(HealthKind::full,
               fmt::format("all {} places are taken, or kept for lost connections (sessions-max)",
                           room_.sessions_max()));
  return health.as_of(publisher_.state().tick());
}

NetFigures NetHost::status_figures() {
  update_stats();
  NetFigures figures{.stats = figures_.stats(),
                     .latency = figures_.latency(),
                     .status = publisher_.status(),
                     .sessions = sessions_.rows(steady_now_s()),
                     .health = health(),
                     .messages = messages_,
                     .frame_age = flush_queue_.frame_age()};
  for (const auto& [id, entry] : sessions_.entries()) {
    figures.unsent_bytes += entry.session->backlog_bytes();
    figures.sessions_behind += entry.session->backlog().reads_along() ? 0 : 1;
  }
  return figures;
}

}  // namespace scree
