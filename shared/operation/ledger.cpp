#include "shared/operation/ledger.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

MaterialLedger::MaterialLedger(const Ledger& all, const MaterialMasses& pieces, Material material,
                               const MaterialMasses& stored) {
  row(material) = {.terrain = all.terrain, .dust = all.dust, .poured = all.poured};
  for (const MaterialMass& one : pieces) {
    row(one.material).pieces += one.mass;
    if (one.material != material) row(one.material).converted += one.mass;
  }
  for (const MaterialMass& one : stored) {
    row(one.material).stored += one.mass;
    if (one.material != material) row(one.material).converted += one.mass;
  }
  CHECK_EQ(sum_of(pieces), all.pieces);
  CHECK_EQ(sum_of(stored), all.stored);
  row(material).converted += row(material).error();
}

std::vector<MaterialFlow> flows_poured(std::span<const MaterialMass> masses) {
  std::vector<MaterialFlow> flows;
  for (const MaterialMass& one : masses)
    flows.push_back({.material = one.material, .pieces = one.mass, .poured = one.mass});
  return flows;
}

MaterialLedger::Row& MaterialLedger::row(Material material) {
  if (rows_.size() <= row_number(material)) rows_.resize(row_number(material) + 1);
  return rows_[row_number(material)];
}

bool MaterialLedger::enter(std::span<const MaterialFlow> flows) {
  MassUnits left = 0;
  for (const Row& one : rows_) left += one.dust;
  for (const MaterialFlow& flow : flows) {
    left -= flow.terrain + flow.pieces + flow.stored - flow.poured - flow.converted;
    if (flow.stored < 0 && row(flow.material).stored + flow.stored < 0) return false;
  }
  if (left < 0) return false;
  MassUnits missing = 0;
  for (const MaterialFlow& flow : flows) {
    Row& to = row(flow.material);
    to.terrain += flow.terrain;
    to.pieces += flow.pieces;
    to.stored += flow.stored;
    to.poured += flow.poured;
    to.converted += flow.converted;
    to.dust -= to.error();
    if (to.dust >= 0) continue;
    missing -= to.dust;
    to.converted -= to.dust;
    to.dust = 0;
  }
  if (missing > 0) CHECK_EQ(convert(flows, missing), 0);
  return true;
}

/// Takes the missing mass from dust: first of the flows' own materials, then of any. Returns what is left.
MassUnits MaterialLedger::convert(std::span<const MaterialFlow> flows, MassUnits missing) {
  const auto take = [&](Row& from) {
    const MassUnits taken = std::min(missing, from.dust);
    from.dust -= taken;
    from.converted -= taken;
    missing -= taken;
  };
  for (const MaterialFlow& flow : flows) take(row(flow.material));
  for (Row& one : rows_) take(one);
  return missing;
}

bool MaterialLedger::agrees(const Ledger& all) const {
  Row sum;
  for (const Row& one : rows_) {
    if (one.error() != 0 || one.dust < 0 || one.pieces < 0 || one.stored < 0) return false;
    sum.terrain += one.terrain;
    sum.pieces += one.pieces;
    sum.dust += one.dust;
    sum.poured += one.poured;
    sum.converted += one.converted;
    sum.stored += one.stored;
  }
  return sum == Row{all.terrain, all.pieces, all.dust, all.poured, 0, all.stored};
}

}  // namespace scree
