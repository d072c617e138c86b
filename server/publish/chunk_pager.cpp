#include "server/publish/chunk_pager.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "server/publish/limits.h"

namespace scree {

/// A chunk that does not fit is older or newer than the state, or damaged: it is asked for again while
/// somebody wants it.
void ChunkPager::page_in(PublishedState& state) {
  if (supply_ == nullptr) return;
  for (const SuppliedChunk& chunk : supply_->collect(limits::chunks_taken_per_tick)) {
    const auto known = state.chunks().find(chunk.chunk);
    if (known == state.chunks().end() || known->second.is_whole()) continue;
    static_cast<void>(state.page_in(chunk.chunk, chunk.bricks));
  }
}

void ChunkPager::want(std::span<const WantedChunk> chunks) {
  for (const WantedChunk& one : chunks) {
    wanted_[one.session].push_back(one.chunk);
    turns_.wait(one.session, one.party);
  }
}

/// What finds no room is wanted again in the next tick.
void ChunkPager::ask() {
  turns_.begin();
  while (!turns_.empty() && supply_->has_room()) {
    std::deque<ChunkCoord>& chunks = wanted_.at(turns_.next());
    supply_->ask(chunks.front());
    chunks.pop_front();
    turns_.charge(1, chunks.empty() ? FairTurns::Then::leaves : FairTurns::Then::waits);
  }
  turns_.end();
  for (const auto& [session, chunks] : wanted_) turns_.leave(session);
  wanted_.clear();
}

void ChunkPager::page(PublishedState& state, EncodeCache& cache) {
  if (supply_ == nullptr) return;
  ask();
  const size_t bricks_max = supply_->bricks_max();
  if (state.bricks_in() <= bricks_max) return;
  const Tick saved = supply_->saved_tick();
  std::vector<std::pair<Tick, ChunkCoord>> old;
  for (const ChunkCoord coord : state.chunks_in()) {
    const PublishedChunk& chunk = state.chunks().at(coord);
    if (chunk.version <= saved && chunk.used < state.tick()) old.emplace_back(chunk.used, coord);
  }
  std::ranges::sort(old);
  const size_t bricks_wanted = bricks_max - bricks_max / limits::page_out_parts;
  for (const auto& [used, coord] : old) {
    if (state.bricks_in() <= bricks_wanted) return;
    state.page_out(coord);
    cache.forget(coord);
  }
}

}  // namespace scree
