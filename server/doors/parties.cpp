#include "server/doors/parties.h"

#include "server/doors/limits.h"
#include "shared/base/check.h"

namespace scree {

uint64_t Parties::join(const std::string& common, uint64_t session, double now_s) {
  std::erase_if(parties_, [&](const auto& entry) {
    return entry.second.sessions == 0 && now_s - entry.second.left_s > limits::party_memory_s;
  });
  Party& party = parties_.try_emplace(common, Party{session}).first->second;
  ++party.sessions;
  return party.number;
}

void Parties::leave(const std::string& common, double now_s) {
  const auto found = parties_.find(common);
  CHECK(found != parties_.end() && found->second.sessions > 0);
  --found->second.sessions;
  found->second.left_s = now_s;
}

}  // namespace scree
