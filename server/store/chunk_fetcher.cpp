#include "server/store/chunk_fetcher.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "server/log/log.h"
#include "server/store/limits.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

struct ChunkFetcher::State {
  void run(std::atomic<uint64_t>& read);

  struct Failure {
    std::string reason;
    double until_s = 0.0;
  };
  struct Came {
    SuppliedChunk chunk;
    std::string error;  ///< empty: there is none
  };

  std::unique_ptr<WorldFile> file;  ///< of the thread

  // Members of the asking thread.
  std::unordered_set<ChunkCoord, CoordHash> asked;
  std::unordered_map<ChunkCoord, Failure, CoordHash> failed;

  std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::deque<ChunkCoord> queue;
  std::deque<Came> came;
  bool stopping = false;
  std::thread thread;
};

void ChunkFetcher::State::run(std::atomic<uint64_t>& read) {
  for (;;) {
    ChunkCoord next;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return stopping || !queue.empty(); });
      if (stopping) return;
      next = queue.front();
      queue.pop_front();
    }
    Came one{{next, {}}, {}};
    WorldFile::follow(file);
    if (auto chunk = file->read_chunk(next); !chunk)
      one.error = chunk.error().message;
    else if (!chunk->has_value())
      one.error = file->path() + " does not have the chunk any more";
    else
      one.chunk.bricks = std::move((*chunk)->bricks);
    read.fetch_add(1, std::memory_order_relaxed);
    const std::scoped_lock lock(mutex);
    came.push_back(std::move(one));
  }
}

ChunkFetcher::ChunkFetcher() : state_(std::make_unique<State>()) {}

ChunkFetcher::~ChunkFetcher() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (state_->thread.joinable()) state_->thread.join();
}

Result<void> ChunkFetcher::start(const std::string& path) {
  CHECK(!state_->thread.joinable());
  auto file = TRY(WorldFile::open(path));
  state_->file = std::move(file);
  state_->thread = std::thread([this] { state_->run(read_); });
  return {};
}

bool ChunkFetcher::has_room() {
  return state_->asked.size() < limits::chunks_asked_max;
}

void ChunkFetcher::ask(ChunkCoord chunk) {
  State& s = *state_;
  if (!has_room() || s.asked.contains(chunk)) return;
  if (const auto failure = s.failed.find(chunk); failure != s.failed.end()) {
    if (steady_now_s() < failure->second.until_s) return;
    s.failed.erase(failure);
  }
  s.asked.insert(chunk);
  {
    const std::scoped_lock lock(s.mutex);
    s.queue.push_back(chunk);
  }
  s.changed.notify_all();
}

std::vector<SuppliedChunk> ChunkFetcher::collect(size_t chunks_max) {
  State& s = *state_;
  std::vector<State::Came> came;
  {
    const std::scoped_lock lock(s.mutex);
    while (!s.came.empty() && came.size() < chunks_max) {
      came.push_back(std::move(s.came.front()));
      s.came.pop_front();
    }
  }
  std::vector<SuppliedChunk> chunks;
  for (State::Came& one : came) {
    s.asked.erase(one.chunk.chunk);
    if (one.error.empty()) {
      chunks.push_back(std::move(one.chunk));
      continue;
    }
    if (s.failed.empty()) log_of(LogPart::store).error("a part of the world cannot be read: {}", one.error);
    if (s.failed.size() >= limits::chunks_asked_max) s.failed.clear();
    s.failed[one.chunk.chunk] = {one.error, steady_now_s() + limits::unreadable_retry_s};
  }
  return chunks;
}

std::optional<std::string> ChunkFetcher::unreadable(ChunkCoord chunk) const {
  const auto failure = state_->failed.find(chunk);
  if (failure == state_->failed.end()) return std::nullopt;
  return failure->second.reason;
}

}  // namespace scree
