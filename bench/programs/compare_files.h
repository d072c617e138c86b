// Compares two results, or all of two folders.
#pragma once

#include <string>

namespace scree {

struct ComparedFiles {
  std::string before, after;  ///< both files, or both folders
  bool strict = false;        ///< what only `before` has counts as worse: metrics, checks, whole results
};

/// Prints the comparison, and returns the exit status: exit_worse when something became worse.
int compare_files(const ComparedFiles& files);

}  // namespace scree
