#include "server/doors/tickets.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <tuple>
#include <vector>

#include "crypto/signing_key.h"
#include "proto/limits.h"
#include "server/doors/limits.h"
#include "shared/base/token.h"

namespace scree {

namespace {

/// A ticket is the session's number, which is no secret, and two random numbers.
constexpr size_t number_bytes = sizeof(uint64_t);
constexpr size_t ticket_bytes = 3 * number_bytes;
static_assert(ticket_bytes <= limits::ticket_bytes_max);

std::string bytes_of(uint64_t number) {
  std::string bytes(number_bytes, '\0');
  std::memcpy(bytes.data(), &number, number_bytes);
  return bytes;
}

}  // namespace

std::string Tickets::issue(uint64_t session) {
  erase_departed(session);
  const std::string& secret = secrets_[session] = bytes_of(random_number()) + bytes_of(random_number());
  return bytes_of(session) + secret;
}

void Tickets::erase_departed(uint64_t session) {
  const auto departed = departed_.find(session);
  if (departed == departed_.end()) return;
  crowd_.remove(departed->second.origin);
  departed_.erase(departed);
}

void Tickets::forget(uint64_t session) {
  erase_departed(session);
  if (secrets_.erase(session) != 0) over_(session);
}

std::optional<uint64_t> Tickets::session_of(const std::string& ticket) const {
  if (ticket.size() != ticket_bytes) return std::nullopt;
  uint64_t session = 0;
  std::memcpy(&session, ticket.data(), number_bytes);
  const auto found = secrets_.find(session);
  const std::string_view secret = std::string_view(ticket).substr(number_bytes);
  if (found == secrets_.end() || !same_token(secret, found->second)) return std::nullopt;
  return session;
}

void Tickets::depart(Departed departed) {
  if (!secrets_.contains(departed.session)) return;
  erase_departed(departed.session);
  crowd_.add(departed.origin);
  departed_.emplace(departed.session, std::move(departed));
  if (departed_.size() <= limits::departed_max) return;
  // Several at once: looking at all of them for each one would let who comes and goes keep the server busy.
  const auto rank = [this](const Departed* one) {
    return std::tuple(crowd_.weight(one->origin), one->joined_s - one->departed_s, -one->departed_s);
  };
  std::vector<const Departed*> all;
  for (const auto& [session, one] : departed_) all.push_back(&one);
  const auto kept = all.begin() + static_cast<ptrdiff_t>(limits::departed_max - limits::departed_max / 16);
  std::ranges::nth_element(all, kept, std::ranges::less{}, rank);
  std::vector<uint64_t> sessions;
  for (auto one = kept; one != all.end(); ++one) sessions.push_back((*one)->session);
  for (const uint64_t session : sessions) forget(session);
}

const Departed* Tickets::departed(uint64_t session) const {
  const auto found = departed_.find(session);
  return found == departed_.end() ? nullptr : &found->second;
}

void Tickets::expire(double now_s) {
  forget_departed(
      [&](const Departed& departed) { return now_s > departed.departed_s + limits::ticket_seconds_max; });
}

void Tickets::forget_departed(const std::function<bool(const Departed&)>& unwanted) {
  std::vector<uint64_t> sessions;
  for (const auto& [session, departed] : departed_)
    if (unwanted(departed)) sessions.push_back(session);
  for (const uint64_t session : sessions) forget(session);
}

size_t Tickets::reserved_places(double now_s) const {
  return static_cast<size_t>(
      std::ranges::count_if(departed_, [&](const auto& entry) { return has_place(entry.second, now_s); }));
}

bool has_place(const Departed& departed, double now_s) {
  return departed.reserves_place && now_s <= departed.departed_s + limits::place_kept_seconds_max;
}

}  // namespace scree
