// What the programs that import and export have in common: how they are parsed, how they end, and how they
// show that they work.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <string>
#include <unistd.h>

#include "shared/base/option_check.h"
#include "shared/base/progress_bar.h"
#include "shared/base/result.h"

namespace scree {

/// What was asked for could not be done: the standard error says why.
inline constexpr int exit_failed = 1;
/// The command line is wrong.
inline constexpr int exit_usage = 2;

inline int refuse(const CLI::App& app, const Error& error) {
  std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.message.c_str());
  return exit_failed;
}

/// Parses; nothing when the program goes on, else its exit status: --help and --version end it, too.
inline std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  refuse_not_finite(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }
  return std::nullopt;
}

/// Does the work with a bar on the terminal: work(progress), whose parts go from 0 to 1.
template <typename Work>
auto with_bar(const Work& work) {
  ProgressBar bar(isatty(STDERR_FILENO) != 0);
  auto done = work(std::function<void(double)>([&](double part) { bar.show(part); }));
  bar.end();
  return done;
}

}  // namespace scree
