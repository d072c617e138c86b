// All that the matrix measured, and the scores that follow from it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "studies/matrix/profiles.h"
#include "studies/matrix/ranking.h"
#include "studies/matrix/shapes.h"

namespace scree {

struct MeasuredSession {
  Simulated simulated;
  SessionFigures figures;
  CellErrorFigures cells;
  MergeFigures merge;
};

struct MeasuredDrawing {
  std::string drawing;
  DrawnFigures figures;
};

/// A combination measured whole, to compare with what its parts foretell: as often as drawings are, and its
/// tick, as a session's, by the first time alone.
struct MeasuredWhole {
  Combination combination;
  DrawnFigures figures;
};

struct MatrixResults {
  bool quick = false;
  std::string renderer;                   ///< OpenGL's name of what draws
  std::vector<MeasuredSession> sessions;  ///< whose pieces become terrain again: they are ranked
  std::vector<MeasuredSession> frozen;    ///< by Recombination::off, as a control: the cycle stays open
  std::vector<MeasuredDrawing> drawings;
  int draw_rounds = 1;  ///< drawings and whole combinations are measured so often, and each time is the least
  std::vector<std::string> left_out;  ///< drawings that this machine lacks, with the reason
  std::vector<MeasuredWhole> whole;
  std::vector<double> repeated_ms;  ///< the tick of the defaults, measured again and again
  std::vector<std::pair<Preset, ProfileFigures>> profiles;
};

/// Combination number i is drawing i / sessions.size() with session i % sessions.size().
size_t combinations_of(const MatrixResults& results);
Combination combination_of(const MatrixResults& results, size_t number);
/// Its number, or combinations_of() where it was not measured.
size_t number_of(const MatrixResults& results, const std::string& drawing, const Simulated& simulated);

/// Drawing and session are measured apart and added up. Frame = tick + update + drawing. Memory = the world's
/// heap + the method's memory. Mass error = the moved mass that is dust at the end. Surface error = the root
/// of the sum of five squares. These are the distances of pieces from their cells, of merged terrain from the
/// exact union, of pieces into rock, of bodies from their pieces, and of the drawn surface from the field.
MatrixScore score_of(const MatrixResults& results, size_t number);
std::vector<MatrixScore> scores_of(const MatrixResults& results);

/// What the parts foretell of a whole frame's and tick's time, milliseconds; 0 where a part is missing.
double foretold_ms(const MatrixResults& results, const Combination& combination);

}  // namespace scree
