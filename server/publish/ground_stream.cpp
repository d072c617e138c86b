#include "server/publish/ground_stream.h"

#include <algorithm>
#include <vector>

#include "proto/limits.h"
#include "server/publish/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int chunk_brick_count = chunk_bricks * chunk_bricks * chunk_bricks;

GroundMessage ground_of(const TerrainSource& source, ChunkCoord chunk) {
  const GeneratedChunk generated = generate_chunk(source, chunk);
  GroundMessage message;
  message.chunk = chunk;
  for (int i = 0; i < chunk_brick_count; ++i) {
    const BrickCoord coord = brick_in_chunk(chunk, i);
    const Brick* const brick = generated.bricks[static_cast<size_t>(i)];
    message.hash += brick_hash(coord, *brick);
    if (brick == &solid_brick())
      message.rock |= uint64_t{1} << i;
    else if (brick != &air_brick())
      message.bricks.push_back({coord, *brick});
  }
  return message;
}

}  // namespace

bool GroundStream::ask(uint64_t session, std::span<const ChunkCoord> chunks) {
  if (waiting(session) + chunks.size() > limits::ground_chunks_max) return false;
  if (chunks.empty()) return true;
  Queue& queue = queues_[session];
  queue.chunks.insert(queue.chunks.end(), chunks.begin(), chunks.end());
  return true;
}

size_t GroundStream::waiting(uint64_t session) const {
  const auto queue = queues_.find(session);
  return queue == queues_.end() ? 0 : queue->second.chunks.size();
}

SharedBytes GroundStream::generated(ChunkCoord chunk, int& work_left) {
  if (const auto found = encoded_.find(chunk); found != encoded_.end()) return found->second;
  if (work_left <= 0) return nullptr;
  const GroundMessage message = ground_of(source_, chunk);
  work_left -= message.bricks.empty() ? 1 : 8;
  SharedBytes bytes = share(message);
  if (encoded_bytes_ > limits::ground_cache_bytes_max) {
    encoded_.clear();
    encoded_bytes_ = 0;
  }
  encoded_.emplace(chunk, bytes);
  constexpr size_t entry_bytes = 128;  // of the map, and the vector's own
  encoded_bytes_ += bytes->size() + entry_bytes;
  return bytes;
}

SharedBytes GroundStream::answer(ChunkCoord chunk, const ClientView& view, int& work_left) {
  if (view.may_see(chunk, source_.voxel_size_m)) return generated(chunk, work_left);
  GroundMessage beyond;
  beyond.chunk = chunk;
  beyond.beyond = true;
  return share(beyond);
}

void GroundStream::serve(const std::function<const ClientView*(uint64_t)>& reader,
                         const std::function<bool(uint64_t, const SharedBytes&)>& send) {
  struct Turn {
    uint64_t session;
    Queue* queue;
    const ClientView* view;
  };
  std::vector<Turn> turns;
  for (auto& [session, queue] : queues_) {
    queue.credit_bytes =
        std::min(queue.credit_bytes + limits::ground_bytes_per_tick, limits::ground_bytes_per_tick);
    if (const ClientView* const view = reader(session)) turns.push_back({session, &queue, view});
  }
  const auto after = [this](const Turn& turn) { return turn.session > served_last_; };
  std::stable_partition(turns.begin(), turns.end(), after);  // clang 14 does not compile that of std::ranges
  int work_left = limits::ground_work_per_tick;
  while (!turns.empty()) {
    std::erase_if(turns, [&](Turn& turn) {
      if (turn.queue->chunks.empty() || turn.queue->credit_bytes <= 0) return true;
      const int work_before = work_left;
      const SharedBytes bytes = answer(turn.queue->chunks.front(), *turn.view, work_left);
      if (!bytes) return true;
      if (work_left != work_before) served_last_ = turn.session;
      turn.queue->chunks.pop_front();
      turn.queue->credit_bytes -= static_cast<int64_t>(bytes->size());
      return !send(turn.session, bytes);
    });
  }
  std::erase_if(queues_, [](const auto& entry) { return entry.second.chunks.empty(); });
}

}  // namespace scree
