// Tests of folders of rules, run one after another and told as they end.
#pragma once

#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

struct RulesTestOptions {
  std::string folder;
  std::string filter;  ///< tests whose names contain it
  bool log = false;    ///< what is said in tests that pass, too
  bool json = false;   ///< one object at the end; else lines as they come
};

/// Whether all passed. An error: there are none, or none of that filter.
Result<bool> run_rules_tests(const RulesTestOptions& options);

}  // namespace scree
