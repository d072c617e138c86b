// Where the mass of a world is, in all and by material. The simulation checks the sums after every tick,
// recordings keep the first for each tick.
#pragma once

#include <span>
#include <vector>

#include "shared/field/material_window.h"

namespace scree {

namespace limits {
/// Mass in any place of a ledger, to either side of 0, as a file or a message may name it. A world stays
/// below: its box has fewer than 2^46 voxels (81,920² · 10,240: world_half_width_m, voxel_size_min_m), which
/// weigh less than 2^54. The sums over time, such as of what was poured, grow by less than 2^34 a second
/// (edit_voxel_cost_us): 2^55 is three weeks of nothing but edits on a whole core. The sum of a row, and that
/// of a member over 255 rows, stay below 2^63. Above: refused.
inline constexpr MassUnits ledger_mass_max = MassUnits{1} << 55U;
}  // namespace limits

/// Mass in all its places, in units of 1/254 voxel. Invariant, at every tick: terrain + pieces + dust +
/// stored = poured.
struct Ledger {
  MassUnits terrain = 0;  ///< gain of the terrain since the start (negative: loss)
  MassUnits pieces = 0;   ///< in pieces alive; not negative
  MassUnits dust = 0;     ///< merges take it up again; not negative
  MassUnits poured = 0;   ///< added by fills, and by pieces that requests bring
  MassUnits moved = 0;    ///< taken out of the terrain since the start, in all; for scale
  MassUnits stored = 0;   ///< dug, and not placed since (store.h); not negative

  MassUnits error() const { return terrain + pieces + dust + stored - poured; }
  bool operator==(const Ledger&) const = default;
};

/// What an operation did to the mass of one material. The rest, by which these do not balance, is dust.
struct MaterialFlow {
  Material material{};
  MassUnits terrain = 0;
  MassUnits pieces = 0;
  MassUnits poured = 0;
  MassUnits converted = 0;  ///< into this material, by paint
  MassUnits stored = 0;

  bool operator==(const MaterialFlow&) const = default;
};

/// The flows of a piece of these masses that is poured in.
std::vector<MaterialFlow> flows_poured(std::span<const MaterialMass> masses);

/// The ledger of each material. Invariants: of each row, terrain + pieces + dust + stored = poured +
/// converted; dust, pieces and what is stored are not negative; all that is converted sums up to 0.
///
/// A voxel counts for one material, also where rests of two lie in it. What a merge gave too much to one, and
/// too little to another, the dust of these takes and gives; where there is not enough, it is `converted`.
class MaterialLedger {
 public:
  struct Row {
    MassUnits terrain = 0;
    MassUnits pieces = 0;
    MassUnits dust = 0;
    MassUnits poured = 0;
    MassUnits converted = 0;
    MassUnits stored = 0;

    MassUnits error() const { return terrain + pieces + dust + stored - poured - converted; }
    bool operator==(const Row&) const = default;
  };

  MaterialLedger() = default;
  /// Takes these rows, by material; they need not balance.
  explicit MaterialLedger(std::vector<Row> rows) : rows_(std::move(rows)) {}
  /// The ledger of a world that kept none of its materials: all counts for one, but for what its pieces and
  /// its stores are of.
  MaterialLedger(const Ledger& all, const MaterialMasses& pieces, Material material,
                 const MaterialMasses& stored = {});

  /// Enters one operation's flows, one of each material. False, and nothing is entered, when they need more
  /// dust than there is, or more than is stored: no world's operations do, and those of a file may.
  [[nodiscard]] bool enter(std::span<const MaterialFlow> flows);

  /// By material; those beyond have nothing.
  const std::vector<Row>& rows() const { return rows_; }
  /// Whether the invariants hold, and the sums are those of the whole.
  bool agrees(const Ledger& all) const;
  bool operator==(const MaterialLedger&) const = default;

 private:
  Row& row(Material material);
  MassUnits convert(std::span<const MaterialFlow> flows, MassUnits missing);

  std::vector<Row> rows_;
};

}  // namespace scree
