#include "server/publish/kept_stream.h"

#include <algorithm>
#include <iterator>

#include "proto/limits.h"

namespace scree {

namespace {

/// What is in the one list and not in the other; as much as a message takes.
std::vector<PieceId> without(const std::vector<PieceId>& from, const std::vector<PieceId>& other) {
  std::vector<PieceId> rest;
  std::ranges::set_difference(from, other, std::back_inserter(rest));
  if (rest.size() > limits::kept_pieces_max) rest.resize(limits::kept_pieces_max);
  return rest;
}

}  // namespace

/// What a message does not take is found again after the next poses.
void KeptStream::serve(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part) {
  const std::vector<PieceId>& all = tick.changes.state.kept();
  if (all.empty() && told_.empty()) return;
  const auto is_unknown = [&](PieceId id) { return !view.knows(id); };
  std::erase_if(told_, is_unknown);
  std::vector<PieceId> kept = all;
  std::erase_if(kept, is_unknown);
  const KeptPiecesMessage message{without(kept, told_), without(told_, kept)};
  if (message.empty() || outlet.room_bytes() <= 0) return;
  std::vector<PieceId> still, now;
  std::ranges::set_difference(told_, message.released, std::back_inserter(still));
  std::ranges::set_union(still, message.kept, std::back_inserter(now));
  told_ = std::move(now);
  outlet.send(share(message), part);
}

}  // namespace scree
