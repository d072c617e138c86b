// Where the mass of a world is, in all and by material. The simulation checks the sums after every tick,
// recordings keep the first for each tick.
#pragma once

#include <span>
#include <vector>

#include "shared/field/material_window.h"

namespace scree {

/// Mass in all its places, in units of 1/254 voxel. Invariant, at every tick: terrain + pieces + dust =
/// poured.
struct Ledger {
  MassUnits terrain = 0;  ///< gain of the terrain since the start (negative: loss)
  MassUnits pieces = 0;   ///< in pieces alive; not negative
  MassUnits dust = 0;     ///< merges take it up again; not negative
  MassUnits poured = 0;   ///< added by fills
  MassUnits moved = 0;    ///< taken out of the terrain since the start, in all; for scale

  MassUnits error() const { return terrain + pieces + dust - poured; }
  bool operator==(const Ledger&) const = default;
};

/// What an operation did to the mass of one material. The rest, by which these do not balance, is dust.
struct MaterialFlow {
  Material material{};
  MassUnits terrain = 0;
  MassUnits pieces = 0;
  MassUnits poured = 0;
  MassUnits converted = 0;  ///< into this material, by paint

  bool operator==(const MaterialFlow&) const = default;
};

/// The ledger of each material. Invariants: of each row, terrain + pieces + dust = poured + converted; dust
/// and pieces are not negative; all that is converted sums up to 0.
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

    MassUnits error() const { return terrain + pieces + dust - poured - converted; }
    bool operator==(const Row&) const = default;
  };

  MaterialLedger() = default;
  /// Takes these rows, by material; they need not balance.
  explicit MaterialLedger(std::vector<Row> rows) : rows_(std::move(rows)) {}
  /// The ledger of a world that kept none of its materials: all counts for one, but for what its pieces are
  /// of.
  MaterialLedger(const Ledger& all, const MaterialMasses& pieces, Material material);

  /// Enters one operation's flows, whose sum leaves no dust less than nothing.
  void enter(std::span<const MaterialFlow> flows);

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
