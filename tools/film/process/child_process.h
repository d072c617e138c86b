// Another program as a child: bytes go to its standard input, its errors to ours, what else it prints
// nowhere. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

#include "shared/base/result.h"

namespace scree {

class ChildProcess {
 public:
  /// `command`: the program, which is looked for in PATH, and its arguments. `purpose` says what it is for
  /// and what to do without it: the error's end where the program is not there.
  static Result<std::unique_ptr<ChildProcess>> start(const std::vector<std::string>& command,
                                                     std::string_view purpose);
  /// Kills it, if it did not end.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Gives it as many bytes as it takes within a time; how many these were.
  Result<size_t> give(std::span<const uint8_t> bytes, int within_ms);
  /// There are no more.
  void end_input();
  /// Waits for its end; false: not yet. An error when it ended by another status than 0.
  Result<bool> wait(int within_ms);

 private:
  ChildProcess(std::string program, pid_t process, int input)
      : program_(std::move(program)), process_(process), input_(input) {}
  Error ended_with(int status) const;

  std::string program_;
  pid_t process_;  ///< 0: it ended
  int input_;      ///< a socket; -1: closed
};

}  // namespace scree
