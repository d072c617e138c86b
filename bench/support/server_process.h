// The server's program as a process of its own, on a free port, that can be killed.
#pragma once

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <poll.h>

#include "bench/support/measured_process.h"
#include "shared/base/timing.h"

namespace scree {

/// The program scree-server beside the one that runs; it may not have been built.
inline std::filesystem::path server_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "scree-server";
}

class ServerProcess {
 public:
  /// Returns when it listens; port() is 0 when it has ended, or does not listen within so many seconds.
  ServerProcess(const char* program, std::vector<std::string> options, double listens_within_s = 10.0) {
    options.insert(options.end(), {"--port", "0", "--log", "off"});
    std::array<int, 2> out{};
    if (::pipe2(out.data(), O_CLOEXEC) != 0) return;
    process_ = std::make_unique<MeasuredProcess>(program, std::move(options), out[1]);
    ::close(out[1]);
    const std::string line = first_line(out[0], listens_within_s);
    ::close(out[0]);
    const std::string before = "{\"listening\":";
    if (line.rfind(before, 0) == 0) port_ = static_cast<uint16_t>(std::atoi(line.c_str() + before.size()));
  }

  uint16_t port() const { return port_; }
  pid_t process() const { return process_ ? process_->process() : -1; }
  /// As MeasuredProcess says of these.
  double memory_mib(const std::string& name) const { return process_ ? process_->memory_mib(name) : 0.0; }
  double cpu_s() const { return process_ ? process_->cpu_s() : 0.0; }
  double thread_cpu_s(const std::string& name) const { return process_ ? process_->thread_cpu_s(name) : 0.0; }
  int end(int signal, double patience_s = 0.0) { return process_ ? process_->end(signal, patience_s) : -1; }

 private:
  /// Empty: none came within so many seconds, or until the end.
  static std::string first_line(int out, double within_s) {
    const double until_s = steady_now_s() + within_s;
    std::string line;
    for (char c = 0; c != '\n'; line += c) {
      pollfd readable{out, POLLIN, 0};
      const auto left_ms = static_cast<int>((until_s - steady_now_s()) * 1e3);
      if (left_ms <= 0 || ::poll(&readable, 1, left_ms) <= 0 || ::read(out, &c, 1) != 1) return {};
    }
    return line;
  }

  std::unique_ptr<MeasuredProcess> process_;
  uint16_t port_ = 0;
};

}  // namespace scree
