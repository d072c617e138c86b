#include "server/net/request_times.h"

#include <algorithm>
#include <vector>

#include "proto/limits.h"
#include "server/net/limits.h"
#include "shared/base/check.h"
#include "shared/base/quantile.h"

namespace scree {

namespace {

constexpr double us_per_s = 1e6;
constexpr double us_per_ms = 1e3;

uint32_t us_between(double from_s, double to_s) {
  const double us = (to_s - from_s) * us_per_s;
  return static_cast<uint32_t>(std::clamp(us, 0.0, static_cast<double>(limits::latency_max_us)));
}

}  // namespace

void RequestTimes::received(uint64_t session, uint32_t request, double now_s) {
  if (waiting_count_ >= limits::requests_timed_max) return;
  waiting_[session].push_back({request, now_s});
  ++waiting_count_;
}

void RequestTimes::forget(uint64_t session) {
  const auto found = waiting_.find(session);
  if (found == waiting_.end()) return;
  CHECK(found->second.size() <= waiting_count_);
  waiting_count_ -= found->second.size();
  waiting_.erase(found);
}

ServerLatency RequestTimes::answered(uint64_t session, uint32_t request, const TickSpan& tick, double now_s) {
  const auto found = waiting_.find(session);
  if (found == waiting_.end()) return {};
  std::deque<Waiting>& of_session = found->second;
  const auto one = std::ranges::find(of_session, request, &Waiting::request);
  if (one == of_session.end()) return {};
  const ServerLatency latency{us_between(one->received_s, tick.taken_s),
                              us_between(tick.taken_s, tick.done_s), us_between(tick.done_s, now_s)};
  of_session.erase(one);
  --waiting_count_;
  if (of_session.empty()) waiting_.erase(found);
  for (size_t i = 0; i < latency_stages.size(); ++i)
    counts_[i].add(static_cast<double>(latency.*latency_stages[i].us) / us_per_ms);
  if (answered_.size() >= limits::requests_timed_max) answered_.pop_front();
  answered_.push_back(latency);
  return latency;
}

LatencyStatus RequestTimes::drain_status() {
  LatencyStatus status;
  for (const LatencyStageRow& stage : latency_stages) {
    std::vector<double> samples;
    for (const ServerLatency& each : answered_) samples.push_back(static_cast<double>(each.*stage.us));
    status.median.*stage.us = static_cast<uint32_t>(quantile(samples, 0.5));
    status.worst.*stage.us = static_cast<uint32_t>(quantile(samples, 1.0));
  }
  answered_.clear();
  return status;
}

}  // namespace scree
