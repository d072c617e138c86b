#include "tools/import/process/reader_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <new>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "shared/base/text.h"
#include "tools/import/process/sanitized.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;

/// Waits for the end of a child whose socket is closed.
constexpr int pauses_to_end = 1000, pause_ms = 5;

constexpr int exit_answered = 0;
constexpr int exit_unheard = 3;  ///< the import is gone

/// The child's side of the channel. It waits without end: it dies with the import.
class ChildChannel final : public ReaderChannel {
 public:
  explicit ChildChannel(int socket) : socket_(socket) {}

  bool end(FrameKind kind, std::string_view words) {
    const auto bytes = std::as_bytes(std::span(words.substr(0, limits::reader_words_bytes_max)));
    return socket_.send(kind, {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, forever()) ==
           FrameSocket::Outcome::done;
  }

 protected:
  Result<void> send(std::span<const uint8_t> bytes) override {
    if (socket_.send(FrameKind::values, bytes, forever()) != FrameSocket::Outcome::done) _exit(exit_unheard);
    return {};
  }
  Result<std::vector<uint8_t>> receive() override {
    FrameSocket::Frame frame;
    if (socket_.receive(frame, forever()) != FrameSocket::Outcome::done) _exit(exit_unheard);
    return std::move(frame.bytes);
  }

 private:
  static Clock::time_point forever() { return Clock::time_point::max(); }

  FrameSocket socket_;
};

/// Bytes of address space that this process has.
uint64_t address_space_bytes() {
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  unsigned long long pages = 0;
  const int read = std::fscanf(file, "%llu", &pages);
  std::fclose(file);
  return read == 1 ? pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

void bound(decltype(RLIMIT_AS) resource, rlim_t soft_most, rlim_t hard_most) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) return;
  now.rlim_max = std::min(now.rlim_max, hard_most);
  now.rlim_cur = std::min({now.rlim_cur, now.rlim_max, soft_most});
  ::setrlimit(resource, &now);
}

/// What this process has open is none of the reader's business.
void close_all_but(int socket) {
  const auto one = static_cast<unsigned>(socket);
  constexpr unsigned first = STDERR_FILENO + 1;
  if (one > first) ::close_range(first, one - 1, 0);
  ::close_range(one + 1, ~0U, 0);
}

/// The child dies with the import, leaves no core file, stays within its limits and its walls, and is silent:
/// words of libraries and of the C library would stand between ours.
Result<void> confine(const ReaderLimits& bounds, const Readable& readable, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) _exit(exit_unheard);
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGINT, SIGXCPU})
    if (!is_sanitized) std::signal(number, SIG_DFL);
  bound(RLIMIT_CORE, 0, 0);
  const auto seconds = static_cast<rlim_t>(std::chrono::ceil<std::chrono::seconds>(bounds.time).count());
  bound(RLIMIT_CPU, seconds, seconds + 1);
  if (is_sanitized) return enter_sandbox(readable);
  const rlim_t bytes = address_space_bytes() + bounds.memory_bytes;
  bound(RLIMIT_AS, bytes, bytes);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (nowhere >= 0) ::dup2(nowhere, stream);
  if (nowhere > STDERR_FILENO) ::close(nowhere);
  return enter_sandbox(readable);
}

[[noreturn]] void run_child(int socket, Result<void> done, const std::string& library,
                            const ReaderProcess::Work& work) {
  ChildChannel channel(socket);
  bool heard = false;
  try {
    if (done) done = work(channel);
    if (done) done = channel.flush();
    heard = done.has_value() || channel.end(FrameKind::refusal, done.error().message);
  } catch (const std::bad_alloc&) {
    heard = channel.end(FrameKind::no_memory, {});
  } catch (const std::exception& failure) {
    heard =
        channel.end(FrameKind::refusal, library + " failed on it: the file is damaged, or of a form that " +
                                            library + " does not read well (" + failure.what() + ")");
  } catch (...) {
    heard = channel.end(FrameKind::refusal, "its reader threw an exception without words");
  }
  _exit(heard ? exit_answered : exit_unheard);
}

}  // namespace

Result<std::unique_ptr<ReaderProcess>> ReaderProcess::start(const std::string& library,
                                                            const ReaderLimits& bounds, const Work& work,
                                                            const Readable& readable) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return fail(std::string("no process can be started to read it: ") + std::strerror(errno));
  const pid_t parent = ::getpid();
  const pid_t process = ::fork();
  if (process == 0) {
    close_all_but(ends[1]);
    run_child(ends[1], confine(bounds, readable, parent), library, work);
  }
  ::close(ends[1]);
  if (process > 0)
    return std::unique_ptr<ReaderProcess>(new ReaderProcess(library, process, ends[0], bounds));
  ::close(ends[0]);
  return fail(std::string("no process can be started to read it: ") + std::strerror(errno));
}

ReaderProcess::~ReaderProcess() {
  kill_child();
}

void ReaderProcess::kill_child() {
  if (process_ == 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = 0;
}

Result<void> ReaderProcess::send(std::span<const uint8_t> bytes) {
  const auto began = Clock::now();
  const auto outcome = socket_.send(FrameKind::values, bytes, began + left_);
  left_ -= Clock::now() - began;
  if (outcome == FrameSocket::Outcome::done) return {};
  return tl::unexpected(fault(outcome));
}

Result<std::vector<uint8_t>> ReaderProcess::receive() {
  FrameSocket::Frame frame;
  const auto began = Clock::now();
  const auto outcome = socket_.receive(frame, began + left_);
  left_ -= Clock::now() - began;
  if (outcome != FrameSocket::Outcome::done) return tl::unexpected(fault(outcome));
  if (frame.kind == FrameKind::values) return std::move(frame.bytes);
  kill_child();
  if (frame.kind == FrameKind::no_memory) return fail("it does not fit into memory (--memory-max)");
  return fail(showable(std::string(frame.bytes.begin(), frame.bytes.end()), limits::reader_words_bytes_max));
}

Error ReaderProcess::fault(FrameSocket::Outcome outcome) {
  if (outcome == FrameSocket::Outcome::closed) return end_in_words();
  kill_child();
  if (outcome == FrameSocket::Outcome::late) return out_of_time();
  return {library_ + " failed on it: its process sent no whole answer"};
}

/// The socket is closed: the child has ended, or is about to.
Error ReaderProcess::end_in_words() {
  if (process_ == 0) return {library_ + " has ended, and reads no more of it"};
  int status = 0;
  pid_t ended = 0;
  for (int i = 0; i < pauses_to_end && ended == 0; ++i) {
    ended = ::waitpid(process_, &status, WNOHANG);
    if (ended == 0) ::poll(nullptr, 0, pause_ms);
  }
  if (ended == 0) {
    kill_child();
    return {library_ + " failed on it: its process sent no whole answer"};
  }
  process_ = 0;
  if (ended > 0 && WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    if (number == SIGXCPU) return out_of_time();
    if (number == SIGKILL)
      return {library_ + " was killed while it read it: the machine may be out of memory (--memory-max)"};
    return {library_ + " ended on it by signal " + std::to_string(number) + " (" + ::strsignal(number) +
            "): the file is damaged or nested too deep, or " + library_ + " cannot read such files"};
  }
  return {library_ + " ended without an answer, status " +
          std::to_string(ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1)};
}

Error ReaderProcess::out_of_time() const {
  const auto seconds = std::chrono::duration<double>(bounds_.time).count();
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", seconds);
  return {library_ + " did not finish reading it within " + text.data() + " s (--time-max)"};
}

}  // namespace scree
