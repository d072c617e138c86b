#include "server/doors/parties.h"

#include "shared/base/check.h"

namespace scree {

uint64_t Parties::join(const std::string& common, uint64_t session) {
  Party& party = parties_.try_emplace(common, Party{session, 0}).first->second;
  ++party.sessions;
  return party.number;
}

void Parties::leave(const std::string& common) {
  const auto found = parties_.find(common);
  CHECK(found != parties_.end() && found->second.sessions > 0);
  if (--found->second.sessions == 0) parties_.erase(found);
}

}  // namespace scree
