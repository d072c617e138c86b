// Runs many benches or studies, each in a process of its own, so that none meets the memory or the threads of
// another, and a crash ends one alone. Each result is written as soon as it is there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/results/stored_result.h"

namespace scree {

/// One bench or study.
struct MeasuredWork {
  ResultKind kind = ResultKind::bench;
  std::string name;
  std::vector<std::string> arguments;  ///< of this program, without --json and --quick
  uint32_t runs = 1;                   ///< a result of fewer runs does not count as done
};

struct AllRuns {
  bool quick = false;
  bool resume = false;  ///< what the folder has already, of the same work and as many runs, is left
  bool strict = false;
  std::string folder{};  ///< of the results; empty: results_folder()
};

/// bench/results/MACHINE: where the repository keeps the results of this one.
std::string results_folder();

/// Returns the exit status.
int run_all(const std::vector<MeasuredWork>& work, const AllRuns& runs);

}  // namespace scree
