// Reads chunks of a world's file on a thread of its own, for users that do not hold them in memory.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "server/store/world_file.h"
#include "server/world/chunk_supply.h"

namespace scree {

class ChunkFetcher final : public ChunkSupply {
 public:
  ChunkFetcher();
  ~ChunkFetcher() override;
  /// Begins to read from a world's file, which another object writes meanwhile. Once; what is asked for
  /// earlier waits.
  Result<void> start(const std::string& path);

  size_t bricks_max() override { return bricks_max_.load(std::memory_order_relaxed); }
  Tick saved_tick() override { return saved_.load(std::memory_order_acquire); }
  bool has_room() override;
  /// A chunk that could not be read is not asked for again for limits::unreadable_retry_s.
  void ask(ChunkCoord chunk) override;
  std::vector<SuppliedChunk> collect(size_t chunks_max) override;

  /// From any thread.
  void allow_bricks(size_t bricks) { bricks_max_.store(bricks, std::memory_order_relaxed); }
  void saved_up_to(Tick tick) { saved_.store(tick, std::memory_order_release); }
  uint64_t chunks_read() const { return read_.load(std::memory_order_relaxed); }
  /// Whether the chunk could not be read lately, and why; from the thread that calls ask().
  std::optional<std::string> unreadable(ChunkCoord chunk) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::atomic<size_t> bricks_max_{SIZE_MAX};
  std::atomic<Tick> saved_{0};
  std::atomic<uint64_t> read_{0};
};

}  // namespace scree
