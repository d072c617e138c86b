#include "tools/film/process/child_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "shared/base/check.h"

namespace scree {
namespace {

/// Waits for the end of a child that reads no more.
constexpr int pauses_to_end = 100;

/// How the child begins: it reads from that socket, none of our signals is blocked in it, and it is in a
/// group of its own, so that a Ctrl-C reaches us alone, who end it in order.
class Beginning {
 public:
  explicit Beginning(int input) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~Beginning() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  Beginning(const Beginning&) = delete;
  Beginning& operator=(const Beginning&) = delete;

  /// As posix_spawnp().
  int spawn(pid_t& process, std::vector<char*>& arguments) const {
    return ::posix_spawnp(&process, arguments.front(), &files_, &attributes_, arguments.data(), environ);
  }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

Result<std::unique_ptr<ChildProcess>> ChildProcess::start(const std::vector<std::string>& command,
                                                          std::string_view purpose) {
  CHECK(!command.empty());
  // A socket, for one can write to it without a signal when nobody reads any more.
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return fail(command.front() + " cannot be started: " + std::strerror(errno));
  std::vector<std::string> texts = command;
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int error = Beginning(ends[1]).spawn(process, arguments);
  ::close(ends[1]);
  if (error == 0) return std::unique_ptr<ChildProcess>(new ChildProcess(command.front(), process, ends[0]));
  ::close(ends[0]);
  if (error == ENOENT)
    return fail("the program " + command.front() + " is not there, " + std::string(purpose));
  return fail(command.front() + " cannot be started: " + std::strerror(error));
}

ChildProcess::~ChildProcess() {
  end_input();
  if (process_ == 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

Result<size_t> ChildProcess::give(std::span<const uint8_t> bytes, int within_ms) {
  pollfd input{input_, POLLOUT, 0};
  if (::poll(&input, 1, within_ms) <= 0) return size_t{0};
  const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (sent >= 0) return static_cast<size_t>(sent);
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return size_t{0};
  // It is about to end, if it has not yet; then its status says more.
  end_input();
  for (int i = 0; i < pauses_to_end; ++i) {
    const auto ended = TRY(wait(within_ms));
    if (ended) break;
  }
  return fail(program_ + " takes no more input");
}

void ChildProcess::end_input() {
  if (input_ >= 0) ::close(input_);
  input_ = -1;
}

Result<bool> ChildProcess::wait(int within_ms) {
  CHECK(process_ != 0);
  int status = 0;
  const pid_t ended = ::waitpid(process_, &status, WNOHANG);
  if (ended == 0) {
    ::poll(nullptr, 0, within_ms);
    return false;
  }
  process_ = 0;
  if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
  return tl::unexpected(ended_with(status));
}

Error ChildProcess::ended_with(int status) const {
  if (WIFSIGNALED(status)) return {program_ + " was ended by signal " + std::to_string(WTERMSIG(status))};
  return {program_ + " ended with status " + std::to_string(WEXITSTATUS(status)) +
          "; its own words are above"};
}

}  // namespace scree
