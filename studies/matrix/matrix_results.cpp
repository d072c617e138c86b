#include "studies/matrix/matrix_results.h"

#include <algorithm>
#include <cmath>

namespace scree {

size_t combinations_of(const MatrixResults& results) {
  return results.drawings.size() * results.sessions.size();
}

Combination combination_of(const MatrixResults& results, size_t number) {
  const size_t sessions = results.sessions.size();
  return {results.drawings[number / sessions].drawing, results.sessions[number % sessions].simulated};
}

size_t number_of(const MatrixResults& results, const std::string& drawing, const Simulated& simulated) {
  const std::vector<MeasuredDrawing>& drawings = results.drawings;
  const std::vector<MeasuredSession>& sessions = results.sessions;
  const auto draws = std::ranges::find(drawings, drawing, &MeasuredDrawing::drawing);
  const auto session = std::ranges::find(sessions, simulated, &MeasuredSession::simulated);
  if (draws == drawings.end() || session == sessions.end()) return combinations_of(results);
  return static_cast<size_t>(draws - drawings.begin()) * sessions.size() +
         static_cast<size_t>(session - sessions.begin());
}

MatrixScore score_of(const MatrixResults& results, size_t number) {
  const DrawnFigures& drawn = results.drawings[number / results.sessions.size()].figures;
  const MeasuredSession& session = results.sessions[number % results.sessions.size()];
  const SessionFigures& ticks = session.figures;
  double squares = 0.0;
  for (const double voxels : {session.cells.rms_voxels, session.merge.rms_voxels, ticks.depth_voxels,
                              ticks.body_voxels, drawn.depth_voxels})
    squares += voxels * voxels;
  return {ticks.tick_ms + drawn.frame_ms, ticks.tick_ms, ticks.heap_mib + drawn.memory_mib,
          ticks.dust_percent, std::sqrt(squares)};
}

std::vector<MatrixScore> scores_of(const MatrixResults& results) {
  std::vector<MatrixScore> scores;
  for (size_t i = 0; i < combinations_of(results); ++i) scores.push_back(score_of(results, i));
  return scores;
}

double foretold_ms(const MatrixResults& results, const Combination& combination) {
  const size_t number = number_of(results, combination.drawing, combination.simulated);
  return number < combinations_of(results) ? score_of(results, number)[0] : 0.0;
}

}  // namespace scree
