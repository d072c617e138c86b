// Another program, which runs beside a test and is ended with it, by its own number.
#pragma once

#include <csignal>
#include <fcntl.h>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace scree {

class BackgroundProgram {
 public:
  /// What it prints goes into the file `said`.
  BackgroundProgram(const std::vector<std::string>& command, const std::string& said) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    child_ = ::fork();
    if (child_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // where a test is killed itself, nobody else would end this
    const int file = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::execvp(words.front(), words.data());
    ::_exit(127);
  }
  ~BackgroundProgram() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  pid_t number() const { return child_; }

 private:
  pid_t child_ = 0;
};

}  // namespace scree
