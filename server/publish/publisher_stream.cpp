// Publisher's streaming: what a client lacks, within its budgets and the room of its link.
#include <algorithm>

#include "server/publish/chunk_part.h"
#include "server/publish/publisher.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Chunks or pieces in one list to stream; the budget of bytes ends the streaming much earlier.
constexpr size_t stream_batch = 64;
static_assert(stream_batch <= limits::kept_chunks_max);

/// Tells of a session its view, or null while it gets nothing.
template <typename Clients>
auto readers(Clients& clients, const std::function<Backlog(uint64_t)>& backlog) {
  return [&](uint64_t session) -> ClientView* {
    auto& client = clients.at(session);
    const bool reads_along = !client.stopped && backlog(session).reads_along();
    return reads_along && client.takes_more() ? &client.view : nullptr;
  };
}

}  // namespace

void Publisher::stream_chunks(Client& client, const TickChanges& changes, Part& part) {
  client.chunk_credit_bytes =
      std::min(client.chunk_credit_bytes + limits::chunk_bytes_per_tick, limits::chunk_bytes_per_tick);
  if (!client.offer.ready() || client.chunk_credit_bytes <= 0 || client.view.wanted_chunks() == 0) return;
  KeptMessage kept;
  size_t read_ahead = 0;
  for (const ChunkCoord coord : client.view.next_chunks(changes, stream_batch)) {
    if (client.chunk_credit_bytes <= 0 || client.room_bytes <= 0) break;
    const PublishedChunk& chunk = state_.chunks().at(coord);
    if (client.offer.answers(coord, chunk.hash)) {
      client.view.sent_chunk(coord);
      kept.chunks.push_back(coord);
      kept.hashes.push_back(chunk.hash);
      continue;
    }
    if (!chunk.is_whole()) {
      if (++read_ahead > limits::chunks_read_ahead) break;
      part.paged.push_back(coord);
      continue;
    }
    part.used.push_back(coord);
    const SharedBytes bytes =
        client.is_slow ? next_part(client, coord, chunk) : whole_chunk(client, coord, chunk);
    client.chunk_credit_bytes -= size_of(bytes);
    part.stats.chunk_bytes += bytes->size();
    send(client, bytes, part);
  }
  if (!kept.chunks.empty()) send_kept(client, kept, part);
  if (client.view.wanted_chunks() == 0) client.offer.forget();
}

SharedBytes Publisher::whole_chunk(Client& client, ChunkCoord coord, const PublishedChunk& chunk) {
  client.view.sent_chunk(coord);
  return cache_.chunk(coord, chunk);
}

/// As much of the chunk as there is room for, and one brick at least.
SharedBytes Publisher::next_part(Client& client, ChunkCoord coord, const PublishedChunk& chunk) {
  CHECK(client.room_bytes > 0);
  const uint64_t edited = chunk.edited;
  const ChosenBricks chosen = choose_bricks(client.view.lacks(coord) & edited, client.next_brick,
                                            static_cast<size_t>(client.room_bytes));
  if (chosen.bricks == edited) return whole_chunk(client, coord, chunk);
  client.next_brick = chosen.next;
  const bool more = !client.view.sent_bricks(coord, chosen.bricks, edited);
  return share(part_of_chunk(coord, chunk, chosen.bricks, more));
}

void Publisher::send_kept(Client& client, const KeptMessage& kept, Part& part) {
  const SharedBytes bytes = share(kept);
  client.chunk_credit_bytes -= size_of(bytes);
  part.stats.kept_bytes += bytes->size();
  part.stats.chunks_kept += kept.chunks.size();
  send(client, bytes, part);
}

void Publisher::stream_pieces(Client& client, Part& part) {
  const int64_t budget = limits::piece_bytes_per_tick * config_.ticks_per_transform;
  client.piece_credit_bytes = std::min(client.piece_credit_bytes + budget, budget);
  if (client.piece_credit_bytes <= 0) return;
  for (const PieceId id : client.view.next_pieces(motions_, stream_batch)) {
    if (client.piece_credit_bytes <= 0 || client.room_bytes <= 0) return;
    const PublishedPiece& piece = state_.pieces().at(id);
    const SharedBytes bytes = cache_.piece(id, piece);
    if (bytes->size() > limits::message_bytes_max) continue;  // the client gets its merge as bricks
    client.piece_credit_bytes -= size_of(bytes);
    part.stats.piece_bytes += bytes->size();
    client.view.sent_piece(id, piece.pose);
    send(client, bytes, part);
  }
}

void Publisher::stream_ground(const std::function<Backlog(uint64_t)>& backlog, Part& part) {
  ground_.serve(readers(clients_, backlog), [&](uint64_t session, const SharedBytes& bytes) {
    part.stats.ground_bytes += bytes->size();
    send(clients_.at(session), bytes, part);
    return clients_.at(session).takes_more();
  });
}

/// After the tick's frame, which therefore does not count on them; the next one does.
void Publisher::stream_tiles(const std::function<Backlog(uint64_t)>& backlog, Part& part) {
  tiles_.serve(readers(clients_, backlog), [&](uint64_t session, const SharedBytes& bytes) {
    part.stats.tile_bytes += bytes->size();
    send(clients_.at(session), bytes, part);
    return clients_.at(session).takes_more();
  });
}

}  // namespace scree
