// The form of every study: many measurements that answer a question, and a report for people.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/support/bench.h"
#include "studies/report/report.h"

namespace scree {

struct StudyOptions {
  bool quick = false;  ///< fewer rounds and points, only to show that it runs
  std::string folder;  ///< the report's; what a study keeps to go on after a break lies there, too
  std::function<void(double fraction)> progress = [](double) {};
};

struct StudyResult {
  StudyReport report;
  BenchReport figures;  ///< the same in numbers, for comparing
};

struct Study {
  std::string name;
  std::string summary;
  Result<StudyResult> (*run)(const StudyOptions&);
};

/// Every study there is, in alphabetical order.
const std::vector<Study>& all_studies();

}  // namespace scree
