#include "server/net/party_rows.h"

#include <algorithm>
#include <map>

namespace scree {

std::vector<PartyRow> with_sessions(std::vector<PartyRow> work, const SessionTable& sessions) {
  std::map<uint64_t, PartyRow> rows;
  for (PartyRow& row : work) rows.emplace(row.party, std::move(row));
  for (const auto& [id, entry] : sessions.entries()) {
    if (entry.joined_s == 0.0) continue;
    PartyRow& row = rows[entry.party != 0 ? entry.party : id];
    row.party = entry.party != 0 ? entry.party : id;
    if (row.sessions++ == 0) row.address = entry.session->address();
    if (row.name.empty()) row.name = entry.name;
    row.refused += entry.refused;
    row.sent_bytes += entry.session->queued_bytes();
  }
  std::vector<PartyRow> all;
  for (auto& [party, row] : rows) all.push_back(std::move(row));
  std::ranges::stable_sort(all, std::greater(), &PartyRow::clock_us_per_s);
  return all;
}

}  // namespace scree
