#include "tools/film/process/program_run.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "shared/base/check.h"

namespace scree {
namespace {

constexpr size_t read_bytes = 4096;
constexpr int signal_status = 128;

std::string read_all(int from) {
  std::string all;
  std::array<char, read_bytes> bytes{};
  for (;;) {
    const ssize_t count = ::read(from, bytes.data(), bytes.size());
    if (count > 0) all.append(bytes.data(), static_cast<size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return all;
  }
}

/// As posix_spawnp(), with the output to that end of a pipe.
int spawn_in(const std::string& folder, int output, pid_t& process, std::vector<char*>& arguments) {
  posix_spawn_file_actions_t files{};
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  const int error = ::posix_spawnp(&process, arguments.front(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

}  // namespace

Result<ProgramEnd> run_to_end(const std::vector<std::string>& command, std::string_view purpose,
                              const std::string& folder) {
  CHECK(!command.empty());
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return fail(command.front() + " cannot be started: " + std::strerror(errno));
  std::vector<std::string> texts = command;
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int error = spawn_in(folder, ends[1], process, arguments);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    if (error == ENOENT)
      return fail("the program " + command.front() + " is not there, " + std::string(purpose));
    return fail(command.front() + " cannot be started: " + std::strerror(error));
  }
  ProgramEnd end;
  end.output = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  end.status = WIFSIGNALED(status) ? signal_status + WTERMSIG(status) : WEXITSTATUS(status);
  return end;
}

}  // namespace scree
