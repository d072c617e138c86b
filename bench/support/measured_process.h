// Another program that is measured: started, its memory and processor time looked at, and ended by its
// number.
#pragma once

#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace scree {

class MeasuredProcess {
 public:
  /// `out` and `error` are descriptors that the program writes to; below 0: as this process does. A program
  /// that cannot be started ends with 127.
  MeasuredProcess(const std::string& program, std::vector<std::string> options, int out = -1,
                  int error = -1) {
    options.insert(options.begin(), program);
    std::vector<char*> arguments;
    for (std::string& option : options) arguments.push_back(option.data());
    arguments.push_back(nullptr);
    process_ = ::fork();
    if (process_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive a killed bench
    if (out >= 0) ::dup2(out, STDOUT_FILENO);
    if (error >= 0) ::dup2(error, STDERR_FILENO);
    ::execv(program.c_str(), arguments.data());
    ::_exit(127);
  }
  ~MeasuredProcess() { end(SIGKILL); }
  MeasuredProcess(const MeasuredProcess&) = delete;
  MeasuredProcess& operator=(const MeasuredProcess&) = delete;

  /// Below 0: it has ended, and was waited for.
  pid_t process() const { return process_; }
  /// A line of what Linux says of its memory (VmHWM: most that lay in RAM at once), MiB; 0 when it has ended.
  double memory_mib(const std::string& name) const {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024.0;
    return 0.0;
  }
  /// Seconds of processor time that all its threads have taken; 0 when it has ended.
  double cpu_s() const {
    clockid_t clock{};
    timespec taken{};
    if (process_ <= 0 || ::clock_getcpuclockid(process_, &clock) != 0) return 0.0;
    if (::clock_gettime(clock, &taken) != 0) return 0.0;
    return static_cast<double>(taken.tv_sec) + static_cast<double>(taken.tv_nsec) * 1e-9;
  }
  /// The same of its threads of that name, as Linux's scheduler counts it.
  double thread_cpu_s(const std::string& name) const {
    double taken_s = 0.0;
    std::error_code none;  // threads come and go
    for (const auto& thread :
         std::filesystem::directory_iterator("/proc/" + std::to_string(process_) + "/task", none)) {
      std::ifstream names(thread.path() / "comm"), times(thread.path() / "schedstat");
      std::string its_name;
      double taken_ns = 0.0;
      if (std::getline(names, its_name) && its_name == name && times >> taken_ns) taken_s += taken_ns * 1e-9;
    }
    return taken_s;
  }
  /// Sends the signal, once, and waits; the exit status, or -1 when a signal ended it. Kills what has not
  /// ended after so many seconds; 0: waits as long as it takes.
  int end(int signal, double patience_s = 0.0) {
    if (process_ <= 0) return -1;
    ::kill(process_, signal);
    int status = 0;
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
    while (patience_s > 0.0 && ::waitpid(process_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        continue;
      }
      ::kill(process_, SIGKILL);
      patience_s = 0.0;
    }
    if (patience_s <= 0.0) ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_ = -1;
};

}  // namespace scree
