#include "server/doors/bytes_out.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "server/doors/limits.h"
#include "shared/base/check.h"

namespace scree {

/// The receivers of one address.
struct BytesOut::Group {
  Tank* tank = nullptr;  ///< null: a proxy's
  std::vector<ByteAccount*> accounts;
  std::vector<int64_t> wants;
  int64_t wanted = 0;
};

std::vector<int64_t> even_parts(const std::vector<int64_t>& wants, int64_t total) {
  std::vector<size_t> order(wants.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) { return wants[i]; });
  std::vector<int64_t> parts(wants.size());
  int64_t left = std::max<int64_t>(0, total);
  for (size_t i = 0; i < order.size(); ++i) {
    const auto others = static_cast<int64_t>(order.size() - i);
    parts[order[i]] = std::clamp<int64_t>(wants[order[i]], 0, left / others);
    left -= parts[order[i]];
  }
  return parts;
}

BytesOut::BytesOut(const Rules& rules, const Door& door) : rules_(rules), door_(door) {
  CHECK(rules.per_address >= 0.0 && rules.all >= 0.0);
  all_.bytes = rules_.all * limits::bytes_out_saved_s_all;
}

bool BytesOut::is_free(const std::string& address) const {
  return !address.empty() && door_.is_free(address);
}

void BytesOut::refill(Tank& tank, double per_second, double saved_s, double now_s) {
  tank.bytes = std::min(per_second * saved_s, tank.bytes + std::max(0.0, now_s - tank.filled_s) * per_second);
  tank.filled_s = now_s;
}

BytesOut::Tank& BytesOut::tank_of(const std::string& address, double now_s) {
  const double full = rules_.per_address * limits::bytes_out_saved_s;
  Tank& tank = tanks_.try_emplace(address, Tank{full, now_s}).first->second;
  refill(tank, rules_.per_address, limits::bytes_out_saved_s, now_s);
  return tank;
}

/// Where the limit is 0, as much as anybody wants.
int64_t BytesOut::left_in(const Tank& tank) const {
  const double per_second = &tank == &all_ ? rules_.all : rules_.per_address;
  return per_second == 0.0 ? limits::bytes_without_limit : static_cast<int64_t>(std::max(0.0, tank.bytes));
}

void BytesOut::open(const Receiver& receiver, double now_s) {
  ByteAccount& account = *receiver.account;
  if (is_free(receiver.address)) {
    account.room = limits::bytes_without_limit;
    return;
  }
  refill(all_, rules_.all, limits::bytes_out_saved_s_all, now_s);
  Tank* const tank = receiver.address.empty() ? nullptr : &tank_of(receiver.address, now_s);
  // No more than a part: many that open at once leave something to the others.
  constexpr int64_t part = 4;
  const int64_t left =
      std::min(left_in(all_), tank != nullptr ? left_in(*tank) : limits::bytes_without_limit);
  const int64_t granted = std::clamp<int64_t>(left / part, 0, limits::bytes_out_at_once - account.room);
  account.room += granted;
  all_.bytes -= static_cast<double>(granted);
  if (tank != nullptr) tank->bytes -= static_cast<double>(granted);
}

void BytesOut::charge(ByteAccount& account, uint64_t bytes) {
  account.room -= static_cast<int64_t>(bytes);
  account.charged += bytes;
  bytes_ += bytes;
}

void BytesOut::close(const Receiver& receiver) {
  const auto left = static_cast<double>(receiver.account->room);
  receiver.account->room = 0;
  if (is_free(receiver.address)) return;
  all_.bytes += left;  // as far as there is room for it, at the next refill
  if (receiver.address.empty()) return;
  if (const auto tank = tanks_.find(receiver.address); tank != tanks_.end())
    tank->second.bytes += left;
  else if (left < 0.0)
    tanks_.emplace(receiver.address,
                   Tank{rules_.per_address * limits::bytes_out_saved_s + left, all_.filled_s});
}

void BytesOut::share(const std::vector<Receiver>& receivers, double now_s) {
  refill(all_, rules_.all, limits::bytes_out_saved_s_all, now_s);
  std::map<std::string, Group> groups;
  for (const auto& [address, account] : receivers) {
    if (is_free(address)) {
      account->room = limits::bytes_without_limit;
      continue;
    }
    held_back_ += account->room <= 0 ? 1 : 0;
    account->room = std::max(account->room, -limits::bytes_owed_max);
    Group& group = groups[address];
    group.accounts.push_back(account);
    group.wants.push_back(std::max<int64_t>(0, limits::bytes_out_at_once - account->room));
    group.wanted += group.wants.back();
  }
  std::vector<int64_t> wants;
  for (auto& [address, group] : groups) {
    if (!address.empty()) group.tank = &tank_of(address, now_s);
    wants.push_back(group.tank != nullptr ? std::min(group.wanted, left_in(*group.tank)) : group.wanted);
  }
  const std::vector<int64_t> granted = even_parts(wants, left_in(all_));
  auto part = granted.begin();
  for (auto& [address, group] : groups) {
    const std::vector<int64_t> parts = even_parts(group.wants, *part);
    for (size_t i = 0; i < parts.size(); ++i) group.accounts[i]->room += parts[i];
    all_.bytes -= static_cast<double>(*part);
    if (group.tank != nullptr) group.tank->bytes -= static_cast<double>(*part);
    ++part;
  }
  forget_the_full(now_s);
}

void BytesOut::forget_the_full(double now_s) {
  const double full = rules_.per_address * limits::bytes_out_saved_s;
  for (auto tank = tanks_.begin(); tank != tanks_.end();) {
    refill(tank->second, rules_.per_address, limits::bytes_out_saved_s, now_s);
    tank = tank->second.bytes >= full ? tanks_.erase(tank) : std::next(tank);
  }
}

}  // namespace scree
