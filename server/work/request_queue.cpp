#include "server/work/request_queue.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "server/work/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

std::string in_ms(float us) {
  return std::to_string(static_cast<int>(std::lround(us / 1000.0F))) + " ms";
}

}  // namespace

RequestQueue::RequestQueue(float client_us_per_s) : client_us_per_s_(client_us_per_s) {
  CHECK(client_us_per_s > 0.0F);
}

Result<void> RequestQueue::push(WaitingRequest request) {
  CHECK(request.cost_us >= 0.0F);
  const uint64_t session = request.command.session;
  const auto found = clients_.find(session);
  const size_t own = found == clients_.end() ? 0 : found->second.requests.size();
  if (own >= limits::requests_waiting_max - size_)
    return fail(
        std::to_string(own) + " requests of this client are waiting, as many as there are places left of " +
        std::to_string(limits::requests_waiting_max) + " (limits.requests_waiting_max): ask again later");
  if (own > 0) {
    const size_t busy = turns_.size() + passed_over_.size();
    const float share_us = client_us_per_s_ / static_cast<float>(busy) * limits::waiting_work_max_s;
    const float waiting_us = found->second.waiting_us;
    if (waiting_us + request.cost_us > share_us)
      return fail("work of about " + in_ms(waiting_us) + " waits for this client already, and each of " +
                  std::to_string(busy) + " busy clients gets about " + in_ms(share_us) +
                  " a second (limits.waiting_work_max_s): ask for less, or less often");
  }
  Client& client = found == clients_.end() ? clients_[session] : found->second;
  if (own == 0) {
    client.charged_ns = std::max(client.charged_ns, served_ns_);
    turns_.insert({client.charged_ns, session});
  }
  client.waiting_us += request.cost_us;
  client.requests.push_back(std::move(request));
  ++size_;
  return {};
}

const WaitingRequest* RequestQueue::next() const {
  return turns_.empty() ? nullptr : &clients_.at(turns_.begin()->second).requests.front();
}

void RequestQueue::pop(float charged_us) {
  CHECK(!turns_.empty() && charged_us >= 0.0F);
  const Turn turn = *turns_.begin();
  turns_.erase(turns_.begin());
  Client& client = clients_.at(turn.second);
  CHECK(!client.requests.empty() && client.charged_ns == turn.first);
  served_ns_ = std::max(served_ns_, client.charged_ns);
  client.charged_ns += static_cast<uint64_t>(charged_us * 1000.0F);
  client.waiting_us -= client.requests.front().cost_us;
  client.requests.pop_front();
  if (client.requests.empty()) client.waiting_us = 0.0F;  // no rounding is carried over
  --size_;
  if (!client.requests.empty()) turns_.insert({client.charged_ns, turn.second});
}

void RequestQueue::pass_over() {
  CHECK(!turns_.empty());
  passed_over_.insert(*turns_.begin());
  turns_.erase(turns_.begin());
}

void RequestQueue::begin_tick() {
  turns_.merge(passed_over_);
  CHECK(passed_over_.empty());
  forget_the_idle();
}

bool RequestQueue::others_wait(uint64_t session) const {
  const size_t waiting = turns_.size() + passed_over_.size();
  const auto found = clients_.find(session);
  const bool itself = found != clients_.end() && !found->second.requests.empty();
  return waiting > (itself ? 1U : 0U);
}

void RequestQueue::forget_the_idle() {
  if (size_ == 0) {
    for (const auto& [session, client] : clients_) served_ns_ = std::max(served_ns_, client.charged_ns);
    clients_.clear();
    return;
  }
  std::erase_if(clients_, [&](const auto& entry) {
    return entry.second.requests.empty() && entry.second.charged_ns <= served_ns_;
  });
}

}  // namespace scree
