#include "server/publish/chunk_stream.h"

#include <algorithm>

#include "proto/limits.h"
#include "server/publish/chunk_part.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Chunks in one list to stream; the budget of bytes ends the streaming much earlier.
constexpr size_t chunk_batch = 64;
static_assert(chunk_batch <= limits::kept_chunks_max);

}  // namespace

void ChunkStream::serve(const ServedTick& tick, ClientView& view, Outlet& outlet, ServedPart& part) {
  followed_.clear();
  credit_bytes_ = std::min(credit_bytes_ + limits::chunk_bytes_per_tick, limits::chunk_bytes_per_tick);
  if (!offer_.ready() || credit_bytes_ <= 0 || outlet.room_bytes() <= 0 || view.wanted_chunks() == 0) return;
  UnchangedChunksMessage unchanged;
  size_t read_ahead = 0;
  for (const ChunkCoord coord : view.next_chunks(tick.changes, chunk_batch)) {
    if (credit_bytes_ <= 0 || outlet.room_bytes() <= 0) break;
    const PublishedChunk& chunk = tick.changes.state.chunks().at(coord);
    if (offer_.answers(coord, chunk.hash)) {
      view.sent_chunk(coord);
      followed_.push_back(coord);
      unchanged.chunks.push_back(coord);
      unchanged.hashes.push_back(chunk.hash);
      continue;
    }
    if (!chunk.is_whole()) {
      if (++read_ahead > limits::chunks_read_ahead) break;
      part.paged.push_back({outlet.session(), outlet.party(), coord});
      continue;
    }
    part.used.push_back(coord);
    const SharedBytes bytes =
        outlet.is_slow() ? next_part(tick, view, outlet, coord, chunk) : whole(tick, view, coord, chunk);
    if (view.held().contains(coord)) followed_.push_back(coord);
    credit_bytes_ -= size_of(bytes);
    part.stats.chunk_bytes += bytes->size();
    outlet.send(bytes, part);
  }
  if (!unchanged.chunks.empty()) send_unchanged(unchanged, outlet, part);
  if (view.wanted_chunks() == 0) offer_.forget();
}

SharedBytes ChunkStream::whole(const ServedTick& tick, ClientView& view, ChunkCoord coord,
                               const PublishedChunk& chunk) const {
  view.sent_chunk(coord);
  return tick.cache.chunk(coord, chunk);
}

/// As much of the chunk as there is room for, and one brick at least.
SharedBytes ChunkStream::next_part(const ServedTick& tick, ClientView& view, const Outlet& outlet,
                                   ChunkCoord coord, const PublishedChunk& chunk) {
  CHECK(outlet.room_bytes() > 0);
  const uint64_t edited = chunk.edited;
  const ChosenBricks chosen =
      choose_bricks(view.lacks(coord) & edited, next_brick_, static_cast<size_t>(outlet.room_bytes()));
  if (chosen.bricks == edited) return whole(tick, view, coord, chunk);
  next_brick_ = chosen.next;
  const bool more = !view.sent_bricks(coord, chosen.bricks, edited);
  return share(part_of_chunk(coord, chunk, chosen.bricks, more));
}

void ChunkStream::send_unchanged(const UnchangedChunksMessage& unchanged, Outlet& outlet, ServedPart& part) {
  const SharedBytes bytes = share(unchanged);
  credit_bytes_ -= size_of(bytes);
  part.stats.kept_bytes += bytes->size();
  part.stats.chunks_kept += unchanged.chunks.size();
  outlet.send(bytes, part);
}

}  // namespace scree
