#include "server/doors/parties.h"

#include <algorithm>

#include "server/doors/limits.h"
#include "shared/base/check.h"

namespace scree {

uint64_t Parties::join(const std::string& common, uint64_t session, double now_s) {
  CHECK(!common.empty());
  forget_the_old(now_s);
  const auto found =
      std::ranges::find_if(parties_, [&](const auto& entry) { return entry.second.common == common; });
  return enter(found == parties_.end() ? session : found->first, common);
}

uint64_t Parties::join_apart(uint64_t session, uint64_t before, double now_s) {
  forget_the_old(now_s);
  if (parties_.contains(before)) return enter(before, {});
  uint64_t last = 0;
  double left_s = 0.0;
  for (const auto& [number, party] : parties_) {
    if (!party.common.empty() || party.sessions != 0 || (last != 0 && party.left_s < left_s)) continue;
    last = number;
    left_s = party.left_s;
  }
  return enter(last == 0 ? session : last, {});
}

/// A session that goes on from elsewhere finds its number taken by itself.
uint64_t Parties::enter(uint64_t party, const std::string& common) {
  ++parties_.try_emplace(party, Party{common}).first->second.sessions;
  return party;
}

void Parties::leave(uint64_t party, double now_s) {
  const auto found = parties_.find(party);
  CHECK(found != parties_.end() && found->second.sessions > 0);
  --found->second.sessions;
  found->second.left_s = now_s;
}

void Parties::forget_the_old(double now_s) {
  std::erase_if(parties_, [&](const auto& entry) {
    return entry.second.sessions == 0 && now_s - entry.second.left_s > limits::party_memory_s;
  });
}

}  // namespace scree
