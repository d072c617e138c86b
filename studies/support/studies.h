// The studies, one function each; all_studies() names them. Each fails where what it measures with is
// missing, as EGL where it draws, and says so.
#pragma once

#include "studies/support/study.h"

namespace scree {

/// Every combination of methods, and the presets.
Result<StudyResult> run_matrix_study(const StudyOptions& options);
/// The paper's experiments (sections 2.5 and 3).
Result<StudyResult> run_paper_study(const StudyOptions& options);
/// Libraries and programs of others on the same work.
Result<StudyResult> run_peers_study(const StudyOptions& options);
/// Curves of cost by the world's size and whatever else grows, what gives way first, and what one machine
/// holds.
Result<StudyResult> run_scale_study(const StudyOptions& options);

}  // namespace scree
