#include "shared/fracture/cell_groups.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

static_assert(limits::seeds_max <= std::numeric_limits<CellLabel>::max());

CellGroups::CellGroups(const std::vector<MassUnits>& cells,
                       const std::vector<std::pair<CellLabel, CellLabel>>& touching)
    : parent_(cells.size()), mass_(cells) {
  CHECK(!cells.empty() && cells.size() <= limits::seeds_max);
  CHECK_DEBUG(std::ranges::is_sorted(touching));
  std::iota(parent_.begin(), parent_.end(), CellLabel{0});
  for (bool joined = true; joined;) joined = join_round(touching);
  join_stragglers();
}

CellLabel CellGroups::root(CellLabel cell) const {
  CHECK_DEBUG(cell < parent_.size());
  while (parent_[cell] != cell) cell = parent_[cell];
  return cell;
}

bool CellGroups::light(CellLabel root) const {
  return mass_[root] < limits::piece_mass_min;
}

/// The lower index stays the root, so that pieces keep the order of their first seeds.
void CellGroups::join(CellLabel a, CellLabel b) {
  CHECK_DEBUG(a != b && parent_[a] == a && parent_[b] == b);
  const auto [low, high] = std::minmax(a, b);
  parent_[high] = low;
  mass_[low] += mass_[high];
}

bool CellGroups::join_round(const std::vector<std::pair<CellLabel, CellLabel>>& touching) {
  std::vector<int> heaviest(parent_.size(), -1);
  const auto offer = [&](CellLabel to, CellLabel other) {
    if (light(to) && (heaviest[to] < 0 || mass_[other] > mass_[static_cast<size_t>(heaviest[to])]))
      heaviest[to] = other;
  };
  for (const auto& [a, b] : touching) {
    const CellLabel ra = root(a), rb = root(b);
    if (ra == rb) continue;
    offer(ra, rb);
    offer(rb, ra);
  }
  bool joined = false;
  for (size_t i = 0; i < heaviest.size(); ++i) {
    if (heaviest[i] < 0) continue;
    const CellLabel a = root(static_cast<CellLabel>(i)), b = root(static_cast<CellLabel>(heaviest[i]));
    if (a == b || !light(a)) continue;
    join(a, b);
    joined = true;
  }
  return joined;
}

void CellGroups::join_stragglers() {
  CellLabel heaviest = 0;
  for (size_t i = 0; i < parent_.size(); ++i)
    if (parent_[i] == i && mass_[i] > mass_[heaviest]) heaviest = static_cast<CellLabel>(i);
  for (size_t i = 0; i < parent_.size(); ++i) {
    const auto cell = static_cast<CellLabel>(i);
    heaviest = root(heaviest);
    if (parent_[i] == i && light(cell) && cell != heaviest) join(cell, heaviest);
  }
}

}  // namespace scree
