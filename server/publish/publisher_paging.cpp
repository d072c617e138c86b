// Publisher's chunks that are out of memory: they are read when a client wants them, and go when nobody does.
#include <algorithm>

#include "server/publish/limits.h"
#include "server/publish/publisher.h"

namespace scree {

/// Chunks that came are streamed from this tick on. One that does not fit is older or newer than the state,
/// or damaged: it is asked for again while somebody wants it.
void Publisher::take_chunks() {
  if (config_.chunks == nullptr) return;
  for (const SuppliedChunk& chunk : config_.chunks->take(limits::chunks_taken_per_tick)) {
    const auto known = state_.chunks().find(chunk.chunk);
    if (known == state_.chunks().end() || known->second.is_whole()) continue;
    static_cast<void>(state_.page_in(chunk.chunk, chunk.bricks));
  }
}

void Publisher::page_out() {
  if (config_.chunks == nullptr) return;
  ChunkSupply& supply = *config_.chunks;
  for (const ChunkCoord chunk : std::exchange(paged_, {})) supply.ask(chunk);
  const size_t bricks_max = supply.bricks_max();
  if (state_.bricks_in() <= bricks_max) return;
  const Tick saved = supply.saved_tick();
  std::vector<std::pair<Tick, ChunkCoord>> old;
  for (const ChunkCoord coord : state_.chunks_in()) {
    const PublishedChunk& chunk = state_.chunks().at(coord);
    if (chunk.version <= saved && chunk.used < state_.tick()) old.emplace_back(chunk.used, coord);
  }
  std::ranges::sort(old);
  const size_t bricks_wanted = bricks_max - bricks_max / limits::page_out_parts;
  for (const auto& [used, coord] : old) {
    if (state_.bricks_in() <= bricks_wanted) return;
    state_.page_out(coord);
    cache_.forget(coord);
  }
}

}  // namespace scree
