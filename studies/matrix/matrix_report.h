// The report of the matrix: from its results to text, tables, plots, figures and files.
#pragma once

#include "studies/matrix/matrix_results.h"
#include "studies/support/study.h"

namespace scree {

StudyReport matrix_report(const MatrixResults& results);
BenchReport matrix_figures(const MatrixResults& results);

/// Into the folder, which must be there: best.json, the balanced combination and the best by each criterion
/// with their scores and conditions, and ranking.csv, all combinations from the best balanced to the worst.
Result<void> write_matrix_files(const MatrixResults& results, const std::string& folder);

/// The median over the wholes of how far each lies from the sum of its parts, as a share of it.
double foretelling_error(const MatrixResults& results);

}  // namespace scree
