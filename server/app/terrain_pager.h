// Keeps a world's terrain within its memory: chunks that nobody is near go out to the world's file, and come
// in ahead of eyes, of pieces, and of requests, read by a thread of their own.
//
// Paging changes nothing that the simulation computes: what it needs and nobody foresaw is read at once, and
// counted as a wait. Used between ticks, by the simulation's thread alone, but for status().
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/store/chunk_fetcher.h"
#include "server/work/memory.h"
#include "server/world/tick_delta.h"
#include "shared/field/field_paging.h"

namespace scree {

struct PagerStatus {
  uint32_t chunks_in = 0;
  uint32_t chunks_out = 0;
  uint64_t chunks_read = 0;  ///< since the start, for the simulation and for clients
  uint64_t waits = 0;        ///< times that a tick waited for a chunk
  uint32_t memory_mb = 0;    ///< by the model of server/work/memory.h
};

/// Reads chunks of a world's file at once.
Result<ReadChunk> chunk_reader(const std::string& path);
/// The same by an own connection, which the first read opens: for one other thread.
ReadChunk late_chunk_reader(const std::string& path);

class TerrainPager {
 public:
  /// Opens the world's file, from which the field's chunks can be read again. `bricks_max`: edited bricks in
  /// memory; 0: as many as memory_max_mb allows. `clients`: supplies their copies, on the network thread; it
  /// is started. `resident_bytes` tells what the process has in RAM, by which terrain gives way to what the
  /// model does not know of; null: to nothing.
  static Result<std::unique_ptr<TerrainPager>> open(const std::string& path, FieldPaging field,
                                                    std::shared_ptr<ChunkFetcher> clients, size_t bricks_max,
                                                    std::function<double()> resident_bytes = {});

  /// Puts chunks in that were read, before a tick.
  void begin_tick();
  /// Ends the tick. `saved` is the tick up to which the file has everything. `soon`: chunks that pieces will
  /// touch.
  void end_tick(const TickDelta& delta, Tick saved, std::span<const glm::vec3> eyes_m,
                std::span<const ChunkCoord> soon, uint32_t memory_max_mb);
  /// Chunks that nobody needs would go out if they were saved.
  bool pressed() const { return pressed_; }

  /// Whether all chunks that the box touches are in; asks for those that are not.
  bool is_in(const VoxelBox& box);
  /// Why one of them cannot be read; nothing if all can, as far as it is known.
  std::optional<std::string> unreadable(const VoxelBox& box) const;
  const TerrainMemory& memory() const { return memory_; }

  PagerStatus status() const;

 private:
  TerrainPager(FieldPaging field, size_t bricks_max, std::shared_ptr<ChunkFetcher> own,
               std::shared_ptr<ChunkFetcher> clients, std::function<double()> resident_bytes);
  void want(ChunkCoord chunk);
  void request_around_eyes(std::span<const glm::vec3> eyes_m);
  void page_out(Tick tick, Tick saved);
  /// Whether chunks are out, or may soon have to go.
  bool is_crowded() const { return field_.chunks_out() > 0 || field_.bricks_in() > bricks_allowed_ / 2; }
  void count_memory(uint32_t memory_max_mb);
  void note_status(uint32_t memory_max_mb);

  FieldPaging paging_;
  const Field& field_;       ///< of paging_
  const size_t bricks_max_;  ///< 0: by memory
  std::shared_ptr<ChunkFetcher> own_;
  std::shared_ptr<ChunkFetcher> clients_;
  const std::function<double()> resident_bytes_;  ///< null: nobody knows
  std::vector<ChunkCoord> around_;                ///< an eye, nearest first
  size_t eye_ = 0, step_ = 0;                     ///< where the next look begins
  uint64_t ticks_around_ = 0;                     ///< until all eyes have been looked at
  size_t bricks_allowed_ = 0;
  std::unordered_map<ChunkCoord, Tick, CoordHash> unsaved_;  ///< chunks that changed since, and when
  Tick saved_ = 0;
  TerrainMemory memory_;
  bool counted_ = false;  ///< memory_ is of this field

  std::vector<ChunkCoord> idle_;  ///< that nobody needed at the last look, the longest idle last
  Tick next_idle_scan_ = 0;       ///< for idle chunks, not before
  bool any_went_ = false, any_unsaved_ = false;  ///< since the last look
  bool pressed_ = false;

  mutable std::mutex mutex_;  ///< guards the member below
  PagerStatus status_;
};

}  // namespace scree
