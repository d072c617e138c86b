// Another program, run to its end for what it prints. Its errors go to ours.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"

namespace scree {

struct ProgramEnd {
  int status = 0;  ///< with which it ended; 128 and the signal's number, where one ended it
  std::string output;
};

/// `command`: the program, which is looked for in PATH, and its arguments. `purpose` says what it is for and
/// what to do without it: the error's end where the program is not there. `folder`: where it runs.
Result<ProgramEnd> run_to_end(const std::vector<std::string>& command, std::string_view purpose,
                              const std::string& folder);

}  // namespace scree
