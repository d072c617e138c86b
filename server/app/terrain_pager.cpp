#include "server/app/terrain_pager.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "server/app/limits.h"
#include "server/app/piece_forecast.h"
#include "server/app/terrain_ahead.h"
#include "server/store/limits.h"
#include "shared/base/check.h"

namespace scree {

/// The server ends when a tick cannot do without a chunk: so a file that is held, or a disk that fails for a
/// moment, is tried again.
Result<ReadChunk> chunk_reader(const std::string& path) {
  auto opened = TRY(WorldFile::open(path));
  return [file = std::make_shared<std::unique_ptr<WorldFile>>(std::move(opened))](ChunkCoord chunk) {
    WorldFile::follow(*file);
    auto bricks = (*file)->read_bricks(chunk);
    for (const double pause_s : limits::needed_chunk_pauses_s) {
      if (bricks || !may_pass(bricks.error())) break;
      std::this_thread::sleep_for(std::chrono::duration<double>(pause_s));
      bricks = (*file)->read_bricks(chunk);
    }
    return bricks;
  };
}

ReadChunk late_chunk_reader(const std::string& path) {
  return [path, file = std::make_shared<std::unique_ptr<WorldFile>>()](
             ChunkCoord chunk) -> Result<std::vector<BrickPatch>> {
    if (*file == nullptr) {
      auto opened = TRY(WorldFile::open(path));
      *file = std::move(opened);
    }
    return (*file)->read_bricks(chunk);
  };
}

TerrainPager::TerrainPager(FieldPaging field, size_t bricks_max, std::shared_ptr<ChunkFetcher> own,
                           std::shared_ptr<ChunkFetcher> clients, std::function<double()> resident_bytes)
    : paging_(field),
      field_(paging_.field()),
      bricks_max_(bricks_max),
      own_(std::move(own)),
      clients_(std::move(clients)),
      resident_bytes_(std::move(resident_bytes)),
      around_(ball_of_chunks(limits::ahead_chunks)) {}

Result<std::unique_ptr<TerrainPager>> TerrainPager::open(const std::string& path, FieldPaging field,
                                                         std::shared_ptr<ChunkFetcher> clients,
                                                         size_t bricks_max,
                                                         std::function<double()> resident_bytes) {
  auto reader = TRY(chunk_reader(path));
  auto own = std::make_shared<ChunkFetcher>();
  for (ChunkFetcher* const fetcher : {own.get(), clients.get()}) TRY(fetcher->start(path));
  field.page_by(std::move(reader));
  return std::unique_ptr<TerrainPager>(
      new TerrainPager(field, bricks_max, std::move(own), std::move(clients), std::move(resident_bytes)));
}

/// A chunk that does not fit came in meanwhile, or was read before its last change was saved.
void TerrainPager::begin_tick() {
  paging_.begin_turn();
  for (const SuppliedChunk& chunk : own_->collect(limits::page_in_per_tick))
    if (field_.is_out(chunk.chunk)) static_cast<void>(paging_.page_in(chunk.chunk, chunk.bricks));
}

void TerrainPager::want(ChunkCoord chunk) {
  if (field_.is_out(chunk))
    own_->ask(chunk);
  else
    paging_.touch(chunk);
}

bool TerrainPager::is_in(const VoxelBox& box) {
  bool all = true;
  for_each_chunk(box, [&](ChunkCoord chunk) {
    want(chunk);
    all = all && !field_.is_out(chunk);
  });
  return all;
}

std::optional<std::string> TerrainPager::unreadable(const VoxelBox& box) const {
  std::optional<std::string> reason;
  for_each_chunk(box, [&](ChunkCoord chunk) {
    if (!reason && field_.is_out(chunk)) reason = own_->unreadable(chunk);
  });
  return reason;
}

void TerrainPager::request_around_eyes(std::span<const glm::vec3> eyes_m) {
  if (eyes_m.empty() || !is_crowded()) return;
  ticks_around_ = eyes_m.size() * around_.size() / limits::pager_chunks_per_tick;
  for (size_t asked = 0; asked < limits::pager_chunks_per_tick; ++asked) {
    const glm::vec3 eye_m = eyes_m[eye_ % eyes_m.size()];
    want(chunk_at(eye_m, field_.source().voxel_size_m) + around_[step_]);
    if (++step_ < around_.size()) continue;
    step_ = 0;
    ++eye_;
  }
}

/// Chunks that nobody needs are looked for when all that were found are gone: there are many to look at.
void TerrainPager::page_out(Tick tick, Tick saved) {
  if (saved != saved_) std::erase_if(unsaved_, [&](const auto& one) { return one.second <= saved; });
  saved_ = saved;
  clients_->saved_up_to(saved);
  clients_->allow_bricks(bricks_allowed_);
  if (field_.bricks_in() <= bricks_allowed_) {
    pressed_ = false;
    return;
  }
  const uint64_t idle = std::max<uint64_t>(limits::pager_idle_ticks, 2 * ticks_around_);
  if (idle_.empty()) {
    if (tick < next_idle_scan_) return;
    next_idle_scan_ = tick + limits::idle_scan_ticks;
    any_went_ = any_unsaved_ = false;
    idle_ = field_.idle_chunks(idle);
    std::ranges::reverse(idle_);
  }
  size_t went = 0;
  while (went < limits::page_out_per_tick && field_.bricks_in() > bricks_allowed_ && !idle_.empty()) {
    const ChunkCoord chunk = idle_.back();
    idle_.pop_back();
    if (!field_.is_idle(chunk, idle)) continue;
    if (unsaved_.contains(chunk)) {
      any_unsaved_ = true;
      continue;
    }
    paging_.page_out(chunk);
    any_went_ = true;
    ++went;
  }
  pressed_ = idle_.empty() && any_unsaved_ && !any_went_;
}

/// What is in RAM beyond the limit is taken from the terrain's share, and given back slowly.
void TerrainPager::count_memory(uint32_t memory_max_mb) {
  double beyond = memory_.beyond_bytes;
  if (resident_bytes_) {
    const double max_bytes = memory_max_mb * bytes_per_mb;
    const double over = resident_bytes_() - max_bytes * (1.0 - limits::resident_margin_share);
    beyond += over > 0.0 ? over : over * limits::beyond_relief;
    beyond = std::clamp(beyond, 0.0, max_bytes * limits::beyond_share_max);
  }
  memory_ = memory_of(field_);
  memory_.beyond_bytes = beyond;
  counted_ = true;
}

void TerrainPager::end_tick(const TickDelta& delta, Tick saved, std::span<const glm::vec3> eyes_m,
                            std::span<const ChunkCoord> soon, uint32_t memory_max_mb) {
  for (const ChunkState& chunk : delta.chunks) unsaved_[chunk.chunk] = delta.tick;
  if (delta.tick % limits::pager_count_ticks == 0 || !counted_) count_memory(memory_max_mb);
  memory_.bricks = field_.bricks_in();
  memory_.chunks_out = field_.chunks_out();
  bricks_allowed_ = bricks_max_ != 0 ? bricks_max_ : bricks_within(memory_max_mb, memory_);
  request_around_eyes(eyes_m);
  if (is_crowded())
    for (const ChunkCoord chunk : soon) want(chunk);
  page_out(delta.tick, saved);
  note_status(memory_max_mb);
}

void TerrainPager::note_status(uint32_t memory_max_mb) {
  PagerStatus now;
  now.chunks_in = static_cast<uint32_t>(field_.chunks_in().size());
  now.chunks_out = static_cast<uint32_t>(field_.chunks_out());
  now.chunks_read = own_->chunks_read() + clients_->chunks_read() + field_.page_waits();
  now.waits = field_.page_waits();
  now.memory_mb = static_cast<uint32_t>(used_bytes(memory_, memory_max_mb) / bytes_per_mb);
  const std::scoped_lock lock(mutex_);
  status_ = now;
}

PagerStatus TerrainPager::status() const {
  const std::scoped_lock lock(mutex_);
  return status_;
}

}  // namespace scree
