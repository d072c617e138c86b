#include "server/work/piece_shares.h"

#include <algorithm>

#include "server/work/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Pieces that several parties together may still add: by number, and by the time that bodies take.
size_t free_pieces(const PieceRoom& room) {
  const size_t left = room.pieces_max - std::min<size_t>(room.alive, room.pieces_max);
  if (!(room.bodies_load > 0.0F)) return left;
  const float by_work = static_cast<float>(room.alive) * (limits::bodies_share / room.bodies_load - 1.0F);
  return static_cast<size_t>(std::clamp(by_work, 0.0F, static_cast<float>(left)));
}

}  // namespace

void PieceShares::add(uint64_t party) {
  ++pieces_[party];
}

void PieceShares::remove(uint64_t party) {
  const auto found = pieces_.find(party);
  CHECK(found != pieces_.end() && found->second > 0);
  if (--found->second == 0) pieces_.erase(found);
}

uint32_t PieceShares::of(uint64_t party) const {
  const auto found = pieces_.find(party);
  return found == pieces_.end() ? 0 : found->second;
}

bool PieceShares::holds_little(uint64_t party) const {
  if (party == 0) return false;
  size_t pieces = 0, parties = of(party) == 0 ? 1 : 0;
  for (const auto& [other, count] : pieces_) {
    if (other == 0) continue;
    pieces += count;
    ++parties;
  }
  return of(party) * parties < pieces;
}

PieceGrant PieceShares::grant(uint64_t party, uint32_t wanted, const PieceRoom& room) const {
  CHECK(wanted > 0);
  const size_t left = room.pieces_max - std::min<size_t>(room.alive, room.pieces_max);
  const uint32_t own = of(party);
  const bool others_have = std::ranges::any_of(
      pieces_, [&](const auto& entry) { return entry.first != party && entry.first != 0; });
  PieceGrant grant;
  grant.contested = party != 0 && (others_have || room.others_wait);
  if (!grant.contested) {
    grant.pieces_most = static_cast<uint32_t>(left);
    if (wanted <= left) grant.pieces = wanted;
    return grant;
  }
  const size_t free = free_pieces(room);
  const size_t share = free > own ? free - own : 0;
  const auto part = static_cast<uint32_t>((share + limits::room_parts - 1) / limits::room_parts);
  grant.pieces_most = std::min(part * limits::seeds_cut_max, room.pieces_max);
  if (wanted <= grant.pieces_most) {
    grant.pieces = std::min(wanted, part);
    return grant;
  }
  const size_t parties = pieces_.size() + (own == 0 ? 1 : 0);
  if (wanted > room.pieces_max) return grant;
  grant.may_wait = own * parties <= room.alive;
  const uint32_t least = (wanted + limits::seeds_cut_max - 1) / limits::seeds_cut_max;
  if (least <= left && own * (parties + 1) < room.pieces_max) grant.pieces_at_last = least;
  return grant;
}

}  // namespace scree
