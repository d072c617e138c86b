// Runs benches, prints their results, and writes these to files.
#pragma once

#include <string>
#include <vector>

#include "bench/support/bench.h"

namespace scree {

struct BenchRuns {
  std::vector<std::string> names;
  BenchOptions options;
  std::string scene{};    ///< of scenes/scene.h, in place of the benches' own ground; empty: none
  uint32_t repeat = 1;    ///< runs of each; in turn, so that other work of the machine slows all of them
  std::string json_file;  ///< of one bench; empty: none
  std::string folder;     ///< NAME.json of each; empty: none
  bool strict = false;    ///< a missed check is told by the exit status
};

/// Returns the exit status.
int run_benches(const BenchRuns& runs);

}  // namespace scree
