#include "server/store/event_log.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include "server/store/limits.h"
#include "server/store/store_fault.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

/// Bytes at the end of a file in which its last line begins, if that is one of ours.
constexpr off_t line_bytes_max = 65536;

std::string said_by_system(const std::string& path) {
  const int error = errno;
  return fmt::format("{} cannot be written: {}", path, words_of(fault_of_system(error), error));
}

/// A pipe that nobody reads is refused, not waited for. Reading is for the end of what is there; of a pipe
/// nothing is read.
int open_to_append(const std::string& path) {
  struct stat there {};
  const bool is_pipe = ::stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode);
  const int how = is_pipe ? O_WRONLY : O_RDWR;
  const int file = ::open(path.c_str(), how | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (file >= 0) ::fcntl(file, F_SETFL, how | O_APPEND);
  return file;
}

/// Nothing of a pipe, and other things that are no files.
std::optional<off_t> size_of(int file) {
  struct stat now {};
  if (::fstat(file, &now) != 0 || !S_ISREG(now.st_mode)) return std::nullopt;
  return now.st_size;
}

/// Cuts off half a line of ours at the end of the file. False: the file ends within a line that stays.
bool mend_end(int file) {
  const off_t size = size_of(file).value_or(0);
  if (size == 0) return true;
  const off_t from = std::max<off_t>(0, size - line_bytes_max);
  std::string tail(static_cast<size_t>(size - from), '\0');
  if (::pread(file, tail.data(), tail.size(), from) != static_cast<ssize_t>(tail.size())) return true;
  if (tail.back() == '\n') return true;
  const size_t last = tail.find_last_of('\n');
  const size_t begins = last == std::string::npos ? 0 : last + 1;
  if (last == std::string::npos && from > 0) return false;
  return tail[begins] == '{' && ::ftruncate(file, from + static_cast<off_t>(begins)) == 0;
}

}  // namespace

struct EventLog::State {
  void run();
  /// Writes lines, and leaves in it those that are not written.
  Result<void> write(std::vector<std::string>& lines);
  Result<void> follow_name();
  void note(const Result<void>& result, uint64_t written);
  /// How many of the bytes were written; less than all after an error.
  size_t write_bytes(const std::string& bytes) const;

  std::string path;
  int file = -1;
  bool torn = false;  ///< the file ends within a line; used by the thread only
  RetryPause pause;   ///< likewise
  std::thread thread;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::vector<std::string> waiting;
  size_t writing = 0;  ///< lines that the thread has taken out of them
  bool stopping = false;
  Status status;
};

size_t EventLog::State::write_bytes(const std::string& bytes) const {
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count > 0) done += static_cast<size_t>(count);
    if (count < 0 && errno != EINTR) break;
  }
  return done;
}

/// The file that has the name now is written, not one that was moved or removed.
Result<void> EventLog::State::follow_name() {
  struct stat opened {
  }, named{};
  if (::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
      opened.st_dev == named.st_dev)
    return {};
  const int anew = open_to_append(path);
  if (anew < 0) return fail(said_by_system(path));
  ::close(std::exchange(file, anew));
  torn = !mend_end(file);
  return {};
}

Result<void> EventLog::State::write(std::vector<std::string>& lines) {
  TRY(follow_name());
  std::string bytes = torn ? "\n" : "";
  for (const std::string& line : lines) bytes += line + "\n";
  const auto before = size_of(file);
  const size_t done = write_bytes(bytes);
  const auto error = done == bytes.size() ? Result<void>() : Result<void>(fail(said_by_system(path)));
  size_t whole = 0, end = torn ? 1 : 0;
  for (; whole < lines.size() && end + lines[whole].size() < done; ++whole) end += lines[whole].size() + 1;
  lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(whole));
  if (done > 0) torn = bytes[done - 1] != '\n';
  if (!torn || !before) return error;
  const bool is_alone = size_of(file) == *before + static_cast<off_t>(done);  // nobody else appends
  if (is_alone && ::ftruncate(file, *before + static_cast<off_t>(done > end ? end : 0)) == 0) torn = false;
  return error;
}

/// With the mutex.
void EventLog::State::note(const Result<void>& result, uint64_t written) {
  status.written += written;
  StoreHealth& health = status.health;
  if (result) {
    health.because.reset();
    health.since_unix_ms = 0;
    return;
  }
  if (health.ok()) health.since_unix_ms = unix_now_ms();
  health.because = result.error().message;
  pause.failed(steady_now_s(), false);
}

void EventLog::State::run() {
  for (;;) {
    std::vector<std::string> lines;
    bool last = false;
    {
      std::unique_lock lock(mutex);
      if (!status.health.ok() && !stopping) {
        const std::chrono::duration<double> left(std::max(0.0, pause.next_s() - steady_now_s()));
        changed.wait_for(lock, left, [this] { return stopping; });
      }
      changed.wait(lock, [this] { return stopping || !waiting.empty(); });
      if (waiting.empty()) return;
      last = stopping;
      lines.swap(waiting);
      writing = lines.size();
    }
    const size_t count = lines.size();
    const Result<void> done = write(lines);
    {
      const std::scoped_lock lock(mutex);
      note(done, count - lines.size());
      if (!done && last) status.health.lost += lines.size();
      if (!done && !last) waiting.insert(waiting.begin(), lines.begin(), lines.end());
      writing = 0;
    }
    changed.notify_all();
    if (last && !done) return;
  }
}

EventLog::EventLog(std::unique_ptr<State> state) : state_(std::move(state)) {}

EventLog::~EventLog() {
  static_cast<void>(finish());
  ::close(state_->file);
}

Result<void> EventLog::finish() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
  const StoreHealth& health = state_->status.health;
  if (health.ok()) return {};
  return fail(fmt::format("{} events are lost (--events): {}", health.lost, *health.because));
}

Result<std::unique_ptr<EventLog>> EventLog::open(const std::string& path) {
  const int file = open_to_append(path);
  if (file < 0) return fail(said_by_system(path) + " (--events)");
  auto state = std::make_unique<State>();
  state->path = path;
  state->file = file;
  state->torn = !mend_end(file);
  state->thread = std::thread([s = state.get()] { s->run(); });
  return std::unique_ptr<EventLog>(new EventLog(std::move(state)));
}

void EventLog::push(std::string line) {
  {
    const std::scoped_lock lock(state_->mutex);
    if (state_->waiting.size() + state_->writing >= limits::event_lines_max) {
      ++state_->status.health.lost;
      return;
    }
    state_->waiting.push_back(std::move(line));
  }
  state_->changed.notify_all();
}

EventLog::Status EventLog::status() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->status;
}

void EventLog::flush() {
  std::unique_lock lock(state_->mutex);
  state_->changed.wait(lock, [this] {
    return state_->writing == 0 && (state_->waiting.empty() || !state_->status.health.ok());
  });
}

}  // namespace scree
