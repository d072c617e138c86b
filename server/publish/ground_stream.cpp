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

bool GroundStream::ask(uint64_t session, uint64_t party, std::span<const ChunkCoord> chunks) {
  if (waiting(session) + chunks.size() > limits::ground_chunks_max) return false;
  if (chunks.empty()) return true;
  Queue& queue = queues_[session];
  queue.chunks.insert(queue.chunks.end(), chunks.begin(), chunks.end());
  turns_.wait(session, party);
  return true;
}

void GroundStream::leave(uint64_t session) {
  queues_.erase(session);
  turns_.leave(session);
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

void GroundStream::begin_tick(const std::function<const ClientView*(uint64_t)>& reader) {
  for (auto& [session, queue] : queues_) {
    queue.credit_bytes =
        std::min(queue.credit_bytes + limits::ground_bytes_per_tick, limits::ground_bytes_per_tick);
    queue.view = reader(session);
  }
  turns_.begin();
}

void GroundStream::serve(const std::function<const ClientView*(uint64_t)>& reader,
                         const std::function<bool(uint64_t, const SharedBytes&)>& send) {
  begin_tick(reader);
  int work_left = work_per_tick_;
  while (!turns_.empty()) {
    const uint64_t session = turns_.next();
    Queue& queue = queues_.at(session);
    const bool gets_more = queue.view != nullptr && queue.credit_bytes > 0;
    const int work_before = work_left;
    const SharedBytes bytes = gets_more ? answer(queue.chunks.front(), *queue.view, work_left) : nullptr;
    if (!bytes) {
      turns_.pass_over();
      continue;
    }
    queue.chunks.pop_front();
    queue.credit_bytes -= size_of(bytes);
    const bool has_room = send(session, bytes);
    const auto work = static_cast<uint64_t>(work_before - work_left);
    turns_.charge(bytes->size() + work * limits::ground_work_bytes,
                  queue.chunks.empty() ? FairTurns::Then::leaves
                  : has_room           ? FairTurns::Then::waits
                                       : FairTurns::Then::is_passed_over);
    if (queue.chunks.empty()) queues_.erase(session);
  }
  turns_.end();
}

}  // namespace scree
