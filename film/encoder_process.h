// The program ffmpeg as a child: bytes go to its standard input, its errors to ours. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <sys/types.h>
#include <vector>

#include "shared/base/result.h"

namespace scree {

class EncoderProcess {
 public:
  /// `command`: the program, which is looked for in PATH, and its arguments.
  static Result<std::unique_ptr<EncoderProcess>> start(const std::vector<std::string>& command);
  /// Kills it, if it did not end.
  ~EncoderProcess();
  EncoderProcess(const EncoderProcess&) = delete;
  EncoderProcess& operator=(const EncoderProcess&) = delete;

  /// Gives it as many bytes as it takes within a time; how many these were.
  Result<size_t> give(std::span<const uint8_t> bytes, int within_ms);
  /// There are no more.
  void end_input();
  /// Waits for its end; false: not yet. An error when it ended by another status than 0.
  Result<bool> wait(int within_ms);

 private:
  EncoderProcess(std::string program, pid_t process, int input)
      : program_(std::move(program)), process_(process), input_(input) {}
  Error ended_with(int status) const;

  std::string program_;
  pid_t process_;  ///< 0: it ended
  int input_;      ///< a socket; -1: closed
};

}  // namespace scree
