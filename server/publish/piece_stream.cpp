#include "server/publish/piece_stream.h"

#include <algorithm>

#include "proto/limits.h"

namespace scree {

namespace {

/// Pieces in one list to stream; the budget of bytes ends the streaming much earlier.
constexpr size_t piece_batch = 64;

}  // namespace

void PieceStream::serve(const ServedTick& tick, ClientView& view, Outlet& outlet, ServedPart& part) {
  const int64_t budget = limits::piece_bytes_per_tick * tick.rates.ticks_per_transform;
  credit_bytes_ = std::min(credit_bytes_ + budget, budget);
  if (credit_bytes_ <= 0) return;
  for (const PieceId id : view.next_pieces(tick.changes.motions, piece_batch)) {
    if (credit_bytes_ <= 0 || outlet.room_bytes() <= 0) return;
    const PublishedState& state = tick.changes.state;
    const auto prop = state.props().find(id);
    const bool is_prop = prop != state.props().end();
    const SharedBytes bytes =
        is_prop ? tick.cache.prop(id, prop->second) : tick.cache.piece(id, state.pieces().at(id));
    if (bytes->size() > limits::message_bytes_max) continue;  // the client gets its merge as bricks
    credit_bytes_ -= size_of(bytes);
    part.stats.piece_bytes += bytes->size();
    view.sent_piece(id, is_prop ? prop->second.pose : state.pieces().at(id).pose);
    outlet.send(bytes, part);
  }
}

}  // namespace scree
