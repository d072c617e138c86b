#include "server/doors/door.h"

#include <algorithm>
#include <asio/ip/address.hpp>
#include <cmath>
#include <functional>

#include "server/doors/crowd.h"
#include "server/doors/limits.h"

namespace scree {

namespace {

constexpr std::string_view this_machine = "loopback";

}  // namespace

std::string door_address(const std::string& ip) {
  asio::error_code error;
  asio::ip::address address = asio::ip::make_address(ip, error);
  if (error) return ip;
  if (address.is_v6() && address.to_v6().is_v4_mapped())
    address = asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
  if (address.is_loopback()) return std::string(this_machine);
  if (address.is_v4()) return address.to_string();
  auto bytes = address.to_v6().to_bytes();
  std::fill(bytes.begin() + 8, bytes.end(), uint8_t{0});
  return asio::ip::address_v6(bytes).to_string() + "/64";
}

bool is_loopback_address(const std::string& ip) {
  return door_address(ip) == this_machine;
}

std::string relayed_address(const std::string& ip) {
  std::string address = door_address(ip);
  return address == this_machine ? "a proxy's own machine" : address;
}

bool Door::is_free(const std::string& address) const {
  return rules_.loopback_is_free && !rules_.loopback_is_shared && address == this_machine;
}

Door::Visitor& Door::visitor(const std::string& address, double now_s, size_t addresses) {
  const auto times = static_cast<double>(addresses);
  const auto known = visitors_.find(address);
  if (known == visitors_.end() && visitors_.size() >= limits::door_addresses_max) forget_the_gone(now_s);
  Visitor& found = visitors_
                       .try_emplace(address, Visitor{.connects = RateLimit(times * rules_.connects_per_second,
                                                                           times * rules_.connects_burst),
                                                     .requests = RateLimit(times * rules_.requests_per_second,
                                                                           times * rules_.requests_burst)})
                       .first->second;
  found.seen_s = now_s;
  return found;
}

/// Forgets addresses without a connection: those that have been quiet for long; if these are too few, all
/// that need not wait after a wrong token; if these are too few, all.
void Door::forget_the_gone(double now_s) {
  const auto forget = [&](double quiet_s, double waits_until_s) {
    if (visitors_.size() < limits::door_addresses_max) return;
    std::erase_if(visitors_, [&](const auto& entry) {
      return entry.second.connections == 0 && now_s - entry.second.seen_s >= quiet_s &&
             entry.second.guess_after_s <= waits_until_s;
    });
  };
  forget(limits::door_memory_s, now_s);
  forget(0.0, now_s);
  forget(0.0, now_s + limits::guess_wait_max_s);
}

std::optional<Refusal> Door::enter(const std::string& address, double now_s) {
  if (is_free(address)) {
    enter_unbounded(address, now_s);
    return std::nullopt;
  }
  const bool is_shared = rules_.loopback_is_free && address == this_machine;
  std::vector<Visitor*> entered;
  const auto enter = [&](const std::string& network, size_t addresses) -> std::optional<Refusal> {
    Visitor& from = visitor(network, now_s, addresses);
    if (!is_shared && !from.connects.try_spend(now_s)) return Refusal::connects_per_second;
    if (from.connections >= addresses * rules_.connections_max) return Refusal::connections_per_address;
    ++from.connections;
    entered.push_back(&from);
    return std::nullopt;
  };
  auto refused = enter(address, 1);
  for (const WideNetwork& wide : wide_networks(address))
    if (!refused && !wide.text.empty()) refused = enter(wide.text, wide.addresses);
  if (refused)
    for (Visitor* const from : entered) --from->connections;
  return refused;
}

void Door::enter_unbounded(const std::string& address, double now_s) {
  ++visitor(address, now_s).connections;
  for (const WideNetwork& wide : wide_networks(address))
    if (!wide.text.empty()) ++visitor(wide.text, now_s, wide.addresses).connections;
}

std::optional<Refusal> Door::move(const std::string& from, const std::string& to, double now_s) {
  const auto is_full = [&](const std::string& network, size_t addresses) {
    return visitor(network, now_s, addresses).connections >= addresses * rules_.connections_max;
  };
  bool full = is_full(to, 1);
  for (const WideNetwork& wide : wide_networks(to))
    full = full || (!wide.text.empty() && is_full(wide.text, wide.addresses));
  if (full && !is_free(to)) return Refusal::connections_per_address;
  enter_unbounded(to, now_s);
  leave(from, now_s);
  return std::nullopt;
}

void Door::leave(const std::string& address, double now_s) {
  const auto leave = [&](const std::string& network, size_t addresses) {
    Visitor& from = visitor(network, now_s, addresses);
    CHECK(from.connections > 0);
    --from.connections;
  };
  leave(address, 1);
  for (const WideNetwork& wide : wide_networks(address))
    if (!wide.text.empty()) leave(wide.text, wide.addresses);
}

bool Door::may_request(const std::string& address, double now_s) {
  if (is_free(address)) return true;
  if (!visitor(address, now_s).requests.try_spend(now_s)) return false;
  return std::ranges::all_of(wide_networks(address), [&](const WideNetwork& wide) {
    return wide.text.empty() || visitor(wide.text, now_s, wide.addresses).requests.try_spend(now_s);
  });
}

double Door::wait_for_guess_s(const std::string& address, double now_s) const {
  const auto known = visitors_.find(address);
  return known == visitors_.end() ? 0.0 : std::max(0.0, known->second.guess_after_s - now_s);
}

bool Door::knows_as_wrong(const std::string& address, const std::string& token) const {
  const auto known = visitors_.find(address);
  return known != visitors_.end() &&
         std::ranges::count(known->second.wrong_tokens, std::hash<std::string>()(token)) != 0;
}

void Door::guessed_wrong(const std::string& address, const std::string& token, double now_s) {
  Visitor& from = visitor(address, now_s);
  from.wrong_tokens.push_back(std::hash<std::string>()(token));
  if (from.wrong_tokens.size() > limits::wrong_tokens_known)
    from.wrong_tokens.erase(from.wrong_tokens.begin());
  if (now_s - from.guess_after_s > limits::door_memory_s) from.wrong_guesses = 0;
  const double wait_s = limits::guess_wait_min_s * std::exp2(std::min(from.wrong_guesses, 30U));
  from.guess_after_s = now_s + std::min(wait_s, limits::guess_wait_max_s);
  ++from.wrong_guesses;
}

}  // namespace scree
