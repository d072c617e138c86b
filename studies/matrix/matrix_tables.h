// Sections of the matrix's report that are tables.
#pragma once

#include "studies/matrix/matrix_results.h"
#include "studies/report/report.h"

namespace scree {

/// ", the least of 2 sessions": how a drawing's times came about, beside "the median of a session's frames";
/// empty where each was measured once.
std::string least_of_rounds(const MatrixResults& results);

/// The first few by each criterion.
ReportSection ranking_section(const MatrixResults& results, const std::vector<MatrixScore>& scores);
/// Each value of each choice, by medians over all sessions that have it.
ReportSection choices_section(const MatrixResults& results);
ReportSection drawings_section(const MatrixResults& results);
ReportSection profiles_section(const MatrixResults& results);

/// Which drawing is the fastest on fresh ground, with pieces in flight and at the end; a sentence.
std::string situations_text(const MatrixResults& results);

}  // namespace scree
