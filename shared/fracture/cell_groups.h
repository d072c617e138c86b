// Groups the cells of a broken volume into pieces. Deterministic.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "shared/field/mass.h"

namespace scree {

/// Index of a cell: the index of its seed.
using CellLabel = uint16_t;

/// Cells too light to stand alone (limits::piece_mass_min) join the heaviest piece that they touch; cells
/// that touch nothing join the heaviest of all. So no piece is light, unless all cells together are.
class CellGroups {
 public:
  /// `cells`: the masses of the cells, at least one. `touching`: pairs (low, high) of cells that touch,
  /// sorted.
  CellGroups(const std::vector<MassUnits>& cells,
             const std::vector<std::pair<CellLabel, CellLabel>>& touching);

  /// The first cell of the piece that the cell belongs to.
  CellLabel root(CellLabel cell) const;

 private:
  bool light(CellLabel root) const;
  void join(CellLabel a, CellLabel b);
  bool join_round(const std::vector<std::pair<CellLabel, CellLabel>>& touching);
  void join_stragglers();

  std::vector<CellLabel> parent_;
  std::vector<MassUnits> mass_;
};

}  // namespace scree
