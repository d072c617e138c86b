// How far the surfaces of pieces and of merged terrain lie from the exact ones, and the mass that a merge
// misses by.
#pragma once

#include <array>

#include "studies/matrix/combination.h"
#include "studies/matrix/results_log.h"

namespace scree {

/// RMS distance between the surfaces of the pieces of a blow, as they were cut, and the exact cells: the
/// volume that was carved out, within the half-spaces nearer to the piece's seeds than to any other one.
struct CellErrorFigures {
  double rms_voxels = 0.0;

  static constexpr auto fields() {
    return std::array{FigureField<CellErrorFigures>{"rms_voxels", &CellErrorFigures::rms_voxels}};
  }
};

Result<CellErrorFigures> measure_cell_error(Cutter cutter, SeedPattern pattern, uint32_t seeds);

/// The same pieces, merged each at a place of its own: RMS distance of the terrain from the union of terrain
/// and piece; mean error of the mass gained, in percent of a piece. Recombination::off merges nothing: no
/// error.
struct MergeFigures {
  double rms_voxels = 0.0;
  double mass_percent = 0.0;

  static constexpr auto fields() {
    using F = FigureField<MergeFigures>;
    return std::array{F{"rms_voxels", &MergeFigures::rms_voxels},
                      F{"mass_percent", &MergeFigures::mass_percent}};
  }
};

Result<MergeFigures> measure_merge(Cutter cutter, SeedPattern pattern, Recombination recombine,
                                   uint32_t seeds);

}  // namespace scree
