// Runs the viewer's program in a process of its own, for tests that need another environment.
// SCREE_VIEWER_PROGRAM is its path.
#pragma once

#include <array>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <utility>

namespace scree {

/// Runs the program; returns its exit status and its output.
inline std::pair<int, std::string> run_viewer(const std::string& environment, const std::string& arguments) {
  const std::string command = "env " + environment + " XDG_CONFIG_HOME=" + testing::TempDir() +
                              "scree_nobody XDG_CACHE_HOME=" + testing::TempDir() +
                              "scree_nobody " SCREE_VIEWER_PROGRAM " " + arguments + " 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {-1, "cannot be run"};
  std::string said;
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) said += buffer.data();
  const int status = ::pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said};
}

}  // namespace scree
