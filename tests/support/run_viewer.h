// Runs the viewer's program in a process of its own, for tests that need another environment.
// SCREE_VIEWER_PROGRAM is its path.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace scree {

/// Runs the program; returns its exit status and its output.
inline std::pair<int, std::string> run_viewer(const std::string& environment, const std::string& arguments) {
  const std::string command = "env " + environment + " XDG_CONFIG_HOME=" + testing::TempDir() +
                              "scree_nobody XDG_CACHE_HOME=" + testing::TempDir() +
                              "scree_nobody " SCREE_VIEWER_PROGRAM " " + arguments;
  return run_program(command);
}

}  // namespace scree
