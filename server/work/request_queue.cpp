#include "server/work/request_queue.h"

#include <cmath>
#include <string>

#include "server/work/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// The estimated cost of a kept request, and of all of a session's, microseconds: an hour, so that sums of
/// nanoseconds fit. Above: refused.
constexpr float kept_cost_max_us = 3.6e9F;

bool may_cost(float cost_us) {
  return cost_us >= 0.0F && cost_us <= kept_cost_max_us;
}

uint64_t in_ns(float us) {
  return static_cast<uint64_t>(us * 1000.0F);
}

std::string in_ms(float us) {
  return std::to_string(static_cast<int>(std::lround(us / 1000.0F))) + " ms";
}

}  // namespace

RequestQueue::RequestQueue(float client_us_per_s) : client_us_per_s_(client_us_per_s) {
  CHECK(client_us_per_s > 0.0F);
}

Result<void> RequestQueue::push(WaitingRequest request) {
  CHECK(request.cost_us >= 0.0F);
  TRY(may_wait(request));
  const uint64_t party_id = party_of(request.command), session_id = request.command.session;
  Party& party = parties_[party_id];
  const uint64_t cost_ns = in_ns(request.cost_us);
  if (party.requests == 0) turns_.wait(party_id, cost_ns);
  Session& session = party.sessions[session_id];
  if (session.requests.empty()) party.turns.wait(session_id, cost_ns);
  session.waiting_us += request.cost_us;
  session.requests.push_back(std::move(request));
  ++party.requests;
  ++size_;
  expect_next(party_id, party);
  return {};
}

Result<void> RequestQueue::may_wait(const WaitingRequest& request) const {
  CHECK(size_ <= limits::requests_waiting_max);
  const auto party = parties_.find(party_of(request.command));
  const size_t own = party == parties_.end() ? 0 : party->second.requests;
  if (own >= limits::requests_waiting_max - size_)
    return fail(std::to_string(own) +
                " requests of this client, or of clients with its address or token, are waiting, and only " +
                std::to_string(limits::requests_waiting_max - size_) + " of " +
                std::to_string(limits::requests_waiting_max) +
                " places are free (limits.requests_waiting_max): ask again later");
  if (party == parties_.end()) return {};
  const auto session = party->second.sessions.find(request.command.session);
  if (session == party->second.sessions.end()) return {};
  const size_t busy = turns_.waiting() * party->second.sessions.size();
  const float share_us = client_us_per_s_ / static_cast<float>(busy) * limits::waiting_work_max_s;
  const float waiting_us = session->second.waiting_us;
  if (waiting_us + request.cost_us <= share_us) return {};
  return fail("work of about " + in_ms(waiting_us) + " waits for this client already, and each of " +
              std::to_string(busy) + " busy clients gets about " + in_ms(share_us) +
              " a second (limits.waiting_work_max_s): ask for less, or less often");
}

const WaitingRequest* RequestQueue::next() const {
  return turns_.empty() ? nullptr : &parties_.at(turns_.next()).next();
}

const WaitingRequest& RequestQueue::Party::next() const {
  return sessions.at(turns.next()).requests.front();
}

void RequestQueue::expect_next(uint64_t id, const Party& party) {
  if (!party.turns.empty()) turns_.expect(id, in_ns(party.next().cost_us));
}

void RequestQueue::pop(float charged_us) {
  CHECK(!turns_.empty() && charged_us >= 0.0F);
  using Then = FairTurns::Then;
  const uint64_t id = turns_.next();
  Party& party = parties_.at(id);
  const auto session = party.sessions.find(party.turns.next());
  CHECK(session != party.sessions.end() && !session->second.requests.empty());
  session->second.waiting_us -= session->second.requests.front().cost_us;
  session->second.requests.pop_front();
  --party.requests;
  --size_;
  const uint64_t charged_ns = in_ns(charged_us);
  const bool more = !session->second.requests.empty();
  party.turns.charge(charged_ns, more ? Then::waits : Then::leaves);
  if (more) party.turns.expect(session->first, in_ns(session->second.requests.front().cost_us));
  if (!more) party.sessions.erase(session);  // no rounding of waiting_us is carried over
  turns_.charge(charged_ns, party.requests == 0   ? Then::leaves
                            : party.turns.empty() ? Then::is_passed_over
                                                  : Then::waits);
  expect_next(id, party);
}

void RequestQueue::pass_over() {
  CHECK(!turns_.empty());
  const uint64_t id = turns_.next();
  Party& party = parties_.at(id);
  party.turns.pass_over();
  if (party.turns.empty()) turns_.pass_over();
  expect_next(id, party);
}

std::vector<Command> RequestQueue::drop(uint64_t session) {
  bring_back();
  std::vector<Command> dropped;
  for (auto& [id, party] : parties_) {  // it may have come again as one of another party
    const auto found = party.sessions.find(session);
    if (found == party.sessions.end()) continue;
    for (WaitingRequest& request : found->second.requests) dropped.push_back(std::move(request.command));
    party.requests -= found->second.requests.size();
    size_ -= found->second.requests.size();
    party.sessions.erase(found);
    party.turns.leave(session);
    if (party.requests == 0) turns_.leave(id);
    expect_next(id, party);
  }
  return dropped;
}

void RequestQueue::bring_back() {
  turns_.bring_back();
  for (auto& [id, party] : parties_) {
    party.turns.bring_back();
    expect_next(id, party);
  }
}

void RequestQueue::begin_tick() {
  bring_back();
  turns_.forget_the_idle();
  for (auto& [id, party] : parties_)
    party.turns.forget_the_idle();  // or a party whose sessions come and go would grow for ever
  std::erase_if(parties_, [](const auto& entry) { return entry.second.requests == 0; });
}

bool RequestQueue::waits(uint64_t party) const {
  const auto found = parties_.find(party);
  return found != parties_.end() && found->second.requests > 0;
}

bool RequestQueue::others_wait(uint64_t party) const {
  return turns_.waiting() > (waits(party) ? 1U : 0U);
}

RequestsValue RequestQueue::value() const {
  RequestsValue value{turns_.value(), {}};
  for (const auto& [id, party] : parties_) {
    PartyValue& one = value.parties.emplace_back(PartyValue{id, party.turns.value(), {}});
    for (const auto& [session_id, session] : party.sessions) {
      SessionValue& waiting = one.sessions.emplace_back(SessionValue{session_id, session.waiting_us, {}});
      for (const WaitingRequest& request : session.requests) {
        const auto& [asker, number, body, in_common] = request.command;
        waiting.requests.push_back({{asker, number, body, in_common}, request.cost_us, request.since});
      }
    }
  }
  return value;
}

namespace {

/// Whether those with requests are those that wait for a turn.
bool agrees(const TurnsValue& turns, const std::vector<uint64_t>& with_requests) {
  std::vector<uint64_t> waiting;
  for (const TurnsValue::Turn& turn : turns.turns)
    if (turn.waits) waiting.push_back(turn.who);
  return waiting == with_requests;
}

}  // namespace

Result<void> RequestQueue::restore_party(const PartyValue& value) {
  if (parties_.contains(value.party)) return fail("a party's requests come twice");
  Party party;
  std::vector<uint64_t> with_requests;
  for (const SessionValue& session : value.sessions) {
    if (session.requests.empty() || !may_cost(session.waiting_us))
      return fail("a session without requests, or that waits for less than nothing or too much");
    Session& one = party.sessions[session.session];
    if (!one.requests.empty()) return fail("a session's requests come twice");
    one.waiting_us = session.waiting_us;
    for (const auto& [recorded, cost_us, since] : session.requests) {
      const auto& [asker, number, body, in_common] = recorded;
      const Command command{asker, number, body, in_common};
      if (asker != session.session || party_of(command) != value.party || !may_cost(cost_us))
        return fail("a request waits where another one's turn is, or costs too much");
      one.requests.push_back({command, cost_us, since});
    }
    party.requests += one.requests.size();
    with_requests.push_back(session.session);
  }
  if (!agrees(value.turns, with_requests))
    return fail("sessions wait without a turn, or the other way round");
  party.turns.restore(value.turns, [&](uint64_t session) {
    return in_ns(party.sessions.at(session).requests.front().cost_us);
  });
  size_ += party.requests;
  parties_.emplace(value.party, std::move(party));
  return {};
}

Result<void> RequestQueue::restore(const RequestsValue& value) {
  const auto refused = [this](const std::string& why) {
    *this = RequestQueue(client_us_per_s_);
    return fail(why);
  };
  *this = RequestQueue(client_us_per_s_);
  std::vector<uint64_t> with_requests;
  for (const PartyValue& party : value.parties) {
    if (Result<void> taken = restore_party(party); !taken) return refused(taken.error().message);
    if (!party.sessions.empty()) with_requests.push_back(party.party);
  }
  if (!agrees(value.turns, with_requests))
    return refused("parties wait without a turn, or the other way round");
  if (size_ > limits::requests_waiting_max)
    return refused(std::to_string(size_) + " requests wait, more than " +
                   std::to_string(limits::requests_waiting_max) + " (limits.requests_waiting_max)");
  turns_.restore(value.turns, [&](uint64_t party) { return in_ns(parties_.at(party).next().cost_us); });
  return {};
}

}  // namespace scree
