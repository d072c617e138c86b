// Another program on a terminal of its own, at which a test types. Every wait has a deadline.
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <poll.h>
#include <pty.h>
#include <string>
#include <string_view>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "tests/support/patience.h"

namespace scree {

class TerminalProgram {
 public:
  /// `environment`: variables that it gets in addition.
  explicit TerminalProgram(const std::vector<std::string>& command,
                           const std::vector<std::pair<std::string, std::string>>& environment = {}) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const winsize size{24, 200, 0, 0};  // no line is wrapped
    child_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
    if (child_ != 0) return;
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    ::execvp(words.front(), words.data());
    ::_exit(127);
  }
  ~TerminalProgram() {
    ::close(terminal_);
    if (ended_) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  TerminalProgram(const TerminalProgram&) = delete;
  TerminalProgram& operator=(const TerminalProgram&) = delete;

  void type(std::string_view keys) const {
    while (!keys.empty()) {
      const ssize_t typed = ::write(terminal_, keys.data(), keys.size());
      if (typed <= 0) return;
      keys.remove_prefix(static_cast<size_t>(typed));
    }
  }
  /// Whether it prints this, behind what shows() has found before.
  bool shows(std::string_view part) {
    const auto end = std::chrono::steady_clock::now() + patience;
    for (;;) {
      const size_t found = said_.find(part, seen_);
      if (found != std::string::npos) {
        seen_ = found + part.size();
        return true;
      }
      if (!read_more() || std::chrono::steady_clock::now() > end) return false;
    }
  }
  /// Likewise, and it reads keys: before, the terminal itself would take them, Ctrl-D for one.
  bool prompts(std::string_view prompt) {
    if (!shows(prompt)) return false;
    const auto end = std::chrono::steady_clock::now() + patience;
    termios modes{};
    while (::tcgetattr(terminal_, &modes) == 0 && (modes.c_lflag & ICANON) != 0) {
      if (std::chrono::steady_clock::now() > end) return false;
      wait_a_moment();
    }
    return true;
  }
  /// Its exit status; -1: a signal ended it, or it does not end.
  int ends() {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
      int status = 0;
      if (::waitpid(child_, &status, WNOHANG) == child_) {
        ended_ = true;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      }
      read_more(1);  // a terminal that nobody reads stops its program
    }
    return -1;
  }
  /// All that it has printed.
  const std::string& said() const { return said_; }

 private:
  /// False at the end.
  bool read_more(int within_ms = 100) {
    pollfd waiting{terminal_, POLLIN, 0};
    if (::poll(&waiting, 1, within_ms) <= 0) return true;
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(terminal_, bytes.data(), bytes.size());
    if (count <= 0) return false;
    said_.append(bytes.data(), static_cast<size_t>(count));
    return true;
  }

  pid_t child_ = 0;
  int terminal_ = -1;
  bool ended_ = false;
  std::string said_;
  size_t seen_ = 0;
};

}  // namespace scree
