#include "server/store/event_log.h"

#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <mutex>
#include <thread>
#include <unistd.h>
#include <utility>

#include "server/store/limits.h"

namespace scree {

namespace {

/// As a crash may have left it.
bool ends_within_a_line(const std::string& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown) || std::filesystem::file_size(path, unknown) == 0)
    return false;
  std::ifstream in(path, std::ios::binary);
  in.seekg(-1, std::ios::end);
  char last = '\n';
  return in.get(last) && last != '\n';
}

}  // namespace

struct EventLog::State {
  void run();
  void write(const std::vector<std::string>& lines);
  /// How many of the bytes were written; less than all after an error.
  size_t write_bytes(const std::string& bytes) const;

  std::string path;
  int file = -1;
  bool torn = false;  ///< the file ends within a line; used by the thread only
  std::thread thread;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::vector<std::string> waiting;
  bool writing = false;
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

void EventLog::State::write(const std::vector<std::string>& lines) {
  std::string bytes = torn ? "\n" : "";
  for (const std::string& line : lines) bytes += line + "\n";
  const size_t done = write_bytes(bytes);
  const int reason = errno;
  uint64_t whole = 0;
  for (size_t at = torn ? 1 : 0; whole < lines.size() && at + lines[whole].size() < done; ++whole)
    at += lines[whole].size() + 1;
  if (done > 0) torn = bytes[done - 1] != '\n';
  const std::scoped_lock lock(mutex);
  status.written += whole;
  status.lost += lines.size() - whole;
  status.error = done == bytes.size()
                     ? std::nullopt
                     : std::optional(fmt::format("{} cannot be written: {}", path, std::strerror(reason)));
}

void EventLog::State::run() {
  for (;;) {
    std::vector<std::string> lines;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return stopping || !waiting.empty(); });
      if (waiting.empty()) return;
      lines.swap(waiting);
      writing = true;
    }
    write(lines);
    {
      const std::scoped_lock lock(mutex);
      writing = false;
    }
    changed.notify_all();
  }
}

EventLog::EventLog(std::unique_ptr<State> state) : state_(std::move(state)) {}

EventLog::~EventLog() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  state_->thread.join();
  ::close(state_->file);
}

Result<std::unique_ptr<EventLog>> EventLog::open(const std::string& path) {
  // A pipe that nobody reads is refused, not waited for.
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (file < 0) return fail(fmt::format("{} cannot be written: {} (--events)", path, std::strerror(errno)));
  auto state = std::make_unique<State>();
  state->path = path;
  state->file = file;
  state->torn = ends_within_a_line(path);
  ::fcntl(file, F_SETFL, O_WRONLY | O_APPEND);
  state->thread = std::thread([s = state.get()] { s->run(); });
  return std::unique_ptr<EventLog>(new EventLog(std::move(state)));
}

void EventLog::push(std::string line) {
  {
    const std::scoped_lock lock(state_->mutex);
    if (state_->waiting.size() >= limits::event_lines_max) {
      ++state_->status.lost;
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
  state_->changed.wait(lock, [this] { return state_->waiting.empty() && !state_->writing; });
}

}  // namespace scree
