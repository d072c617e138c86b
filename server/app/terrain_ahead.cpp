#include "server/app/terrain_ahead.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "server/app/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

int square_of(ChunkCoord v) {
  return v.x * v.x + v.y * v.y + v.z * v.z;
}

}  // namespace

std::vector<ChunkCoord> ball_of_chunks(int radius) {
  std::vector<ChunkCoord> ball;
  for (int x = -radius; x <= radius; ++x)
    for (int y = -radius; y <= radius; ++y)
      for (int z = -radius; z <= radius; ++z)
        if (square_of({x, y, z}) <= radius * radius) ball.push_back({x, y, z});
  std::ranges::stable_sort(ball, {}, square_of);
  return ball;
}

TerrainAhead::TerrainAhead(const TerrainSource& source)
    : source_(source), around_(ball_of_chunks(limits::ahead_chunks)), thread_([this] { run(); }) {}

TerrainAhead::~TerrainAhead() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void TerrainAhead::serve(const Field& field, std::span<const glm::vec3> eyes_m) {
  std::vector<Ready> ready;
  bool idle = false;
  {
    const std::scoped_lock lock(mutex_);
    ready.swap(ready_);
    idle = wanted_.empty();
  }
  for (Ready& each : ready) {
    coming_.erase(each.coord);
    field.adopt_generated(each.coord, std::move(each.chunk));
  }
  if (!idle || eyes_m.empty()) return;
  std::vector<ChunkCoord> wanted = missing_around(field, eyes_m);
  if (wanted.empty()) return;
  const size_t chunk_bytes = field.generated_bytes() / std::max<size_t>(1, field.generated_chunks());
  if (round_.size() * chunk_bytes > field.generated_bytes_max() / 2) return;
  std::ranges::reverse(wanted);
  const std::scoped_lock lock(mutex_);
  wanted_ = std::move(wanted);
  wake_.notify_all();
}

bool TerrainAhead::has(const Field& field, const VoxelBox& box) {
  std::vector<ChunkCoord> chunks;
  for_each_chunk(box, [&](ChunkCoord chunk) { chunks.push_back(chunk); });
  return has(field, chunks);
}

bool TerrainAhead::has(const Field& field, std::span<const ChunkCoord> chunks) {
  std::vector<ChunkCoord> lacking;
  for (const ChunkCoord chunk : chunks)
    if (!field.touch_generated(chunk)) lacking.push_back(chunk);
  if (lacking.empty()) return true;
  const std::scoped_lock lock(mutex_);
  for (const ChunkCoord chunk : lacking)
    if (coming_.size() < limits::ahead_asked_max && coming_.insert(chunk).second) asked_.push_back(chunk);
  wake_.notify_all();
  return false;
}

/// Those of the next limits::ahead_chunks_per_tick chunks around an eye that the field lacks.
std::vector<ChunkCoord> TerrainAhead::missing_around(const Field& field, std::span<const glm::vec3> eyes_m) {
  if (step_ >= around_.size()) {
    step_ = 0;
    if (++eye_ % eyes_m.size() == 0) round_.clear();
  }
  const glm::vec3 world{limits::world_half_width_m, limits::world_half_height_m, limits::world_half_width_m};
  const glm::vec3 eye = glm::clamp(eyes_m[eye_ % eyes_m.size()], -world, world) / source_.voxel_size_m;
  const ChunkCoord middle =
      chunk_of(VoxelCoord{floor_to_int(eye.x), floor_to_int(eye.y), floor_to_int(eye.z)});
  std::vector<ChunkCoord> lacking;
  const size_t end = std::min(step_ + limits::ahead_chunks_per_tick, around_.size());
  for (; step_ < end; ++step_) {
    const ChunkCoord chunk = middle + around_[step_];
    round_.insert(chunk);
    if (!field.touch_generated(chunk)) lacking.push_back(chunk);
  }
  return lacking;
}

void TerrainAhead::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stopping_ || !asked_.empty() || !wanted_.empty(); });
    if (stopping_) return;
    const bool was_asked = !asked_.empty();
    const ChunkCoord coord = was_asked ? asked_.front() : wanted_.back();
    lock.unlock();
    GeneratedChunk chunk = generate_chunk(source_, coord);
    lock.lock();
    if (was_asked) {
      asked_.pop_front();
    } else {
      // Kept until now: serve() requests chunks only while none is wanted.
      CHECK(!wanted_.empty() && wanted_.back() == coord);
      wanted_.pop_back();
    }
    ready_.push_back({coord, std::move(chunk)});
  }
}

}  // namespace scree
