// Runs a study, prints its figures, and writes its report.
#pragma once

#include <string>

#include "studies/support/study.h"

namespace scree {

struct StudyRun {
  bool quick = false;
  std::string folder;     ///< the report's
  std::string json_file;  ///< empty: none
  bool strict = false;
};

/// Returns the exit status.
int run_study(const Study& study, const StudyRun& run);

}  // namespace scree
