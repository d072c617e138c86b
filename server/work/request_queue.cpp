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
  if (party.size() == 0) turns_.wait(party_id, in_ns(request.cost_us));
  party.push(session_id, std::move(request));
  ++size_;
  expect_next(party_id, party);
  return {};
}

Result<void> RequestQueue::may_wait(const WaitingRequest& request) const {
  CHECK(size_ <= limits::requests_waiting_max);
  const auto party = parties_.find(party_of(request.command));
  const size_t own = party == parties_.end() ? 0 : party->second.size();
  if (own >= limits::requests_waiting_max - size_)
    return fail(std::to_string(own) +
                " requests of this client, or of clients with its address or token, are waiting, and only " +
                std::to_string(limits::requests_waiting_max - size_) + " of " +
                std::to_string(limits::requests_waiting_max) +
                " places are free (limits.requests_waiting_max): ask again later");
  if (party == parties_.end()) return {};
  const auto& sessions = party->second.lines();
  const auto session = sessions.find(request.command.session);
  if (session == sessions.end()) return {};
  const size_t busy = turns_.waiting() * sessions.size();
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

void RequestQueue::expect_next(uint64_t id, const Party& party) {
  if (!party.empty()) turns_.expect(id, in_ns(party.next().cost_us));
}

void RequestQueue::pop(float charged_us) {
  CHECK(!turns_.empty() && charged_us >= 0.0F);
  using Then = FairTurns::Then;
  const uint64_t id = turns_.next();
  Party& party = parties_.at(id);
  party.pop(charged_us);
  --size_;
  turns_.charge(in_ns(charged_us), party.size() == 0 ? Then::leaves
                                   : party.empty()   ? Then::is_passed_over
                                                     : Then::waits);
  expect_next(id, party);
}

void RequestQueue::pass_over() {
  CHECK(!turns_.empty());
  const uint64_t id = turns_.next();
  Party& party = parties_.at(id);
  party.pass_over();
  if (party.empty()) turns_.pass_over();
  expect_next(id, party);
}

std::vector<Command> RequestQueue::drop(uint64_t session) {
  bring_back();
  std::vector<Command> dropped;
  for (auto& [id, party] : parties_) {  // it may have come again as one of another party
    if (!party.waits(session)) continue;
    for (WaitingRequest& request : party.drop(session)) {
      dropped.push_back(std::move(request.command));
      --size_;
    }
    if (party.size() == 0) turns_.leave(id);
    expect_next(id, party);
  }
  return dropped;
}

void RequestQueue::bring_back() {
  turns_.bring_back();
  for (auto& [id, party] : parties_) {
    party.bring_back();
    expect_next(id, party);
  }
}

void RequestQueue::begin_tick() {
  bring_back();
  turns_.forget_the_idle();
  for (auto& [id, party] : parties_)
    party.begin_tick();  // or a party whose sessions come and go would grow for ever
  std::erase_if(parties_, [](const auto& entry) { return entry.second.size() == 0; });
}

bool RequestQueue::waits(uint64_t party) const {
  const auto found = parties_.find(party);
  return found != parties_.end() && found->second.size() > 0;
}

bool RequestQueue::others_wait(uint64_t party) const {
  return turns_.waiting() > (waits(party) ? 1U : 0U);
}

RequestsValue RequestQueue::value() const {
  RequestsValue value{turns_.value(), {}};
  for (const auto& [id, party] : parties_) {
    PartyValue& one = value.parties.emplace_back(PartyValue{id, party.turns(), {}});
    for (const auto& [session_id, line] : party.lines()) {
      SessionValue& waiting = one.sessions.emplace_back(SessionValue{session_id, line.waiting_us, {}});
      for (const WaitingRequest& request : line.items)
        waiting.requests.push_back({request.command, request.cost_us, request.since});
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
    if (party.waits(session.session)) return fail("a session's requests come twice");
    for (const auto& [command, cost_us, since] : session.requests) {
      if (command.session != session.session || party_of(command) != value.party || !may_cost(cost_us))
        return fail("a request waits where another one's turn is, or costs too much");
      party.push(command.session, {command, cost_us, since});
    }
    party.lines().at(session.session).waiting_us = session.waiting_us;
    with_requests.push_back(session.session);
  }
  if (!agrees(value.turns, with_requests))
    return fail("sessions wait without a turn, or the other way round");
  party.restore_turns(value.turns);
  size_ += party.size();
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
