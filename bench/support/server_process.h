// The server's program as a process of its own, on a free port, that can be killed.
#pragma once

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace scree {

/// The program scree-server beside the one that runs; it may not have been built.
inline std::filesystem::path server_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "scree-server";
}

class ServerProcess {
 public:
  /// Returns when it listens, or has ended: then port() is 0.
  ServerProcess(const char* program, std::vector<std::string> options) {
    options.insert(options.begin(), program);
    options.insert(options.end(), {"--port", "0", "--log", "off"});
    std::vector<char*> arguments;
    for (std::string& option : options) arguments.push_back(option.data());
    arguments.push_back(nullptr);
    std::array<int, 2> out{};
    if (::pipe(out.data()) != 0) return;
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(out[1], STDOUT_FILENO);
      ::close(out[0]);
      ::close(out[1]);
      ::execv(program, arguments.data());
      ::_exit(127);
    }
    ::close(out[1]);
    std::string line;
    for (char c = 0; line.find('\n') == std::string::npos && ::read(out[0], &c, 1) == 1;) line += c;
    ::close(out[0]);
    const std::string before = "{\"listening\":";
    if (line.rfind(before, 0) == 0) port_ = static_cast<uint16_t>(std::atoi(line.c_str() + before.size()));
  }
  ~ServerProcess() { end(SIGKILL); }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  uint16_t port() const { return port_; }
  pid_t process() const { return process_; }
  /// A line of what Linux says of its memory (VmHWM: most that lay in RAM at once), MiB; 0 when it has ended.
  double memory_mib(const std::string& name) const {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024.0;
    return 0.0;
  }
  /// Sends the signal, once, and waits; the exit status, or -1 when the signal ended it.
  int end(int signal) {
    if (process_ <= 0) return -1;
    ::kill(process_, signal);
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_ = -1;
  uint16_t port_ = 0;
};

}  // namespace scree
