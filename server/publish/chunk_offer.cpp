#include "server/publish/chunk_offer.h"

#include <algorithm>

namespace scree {

void ChunkOffer::accept(OfferMessage offer, uint32_t ticks) {
  offer_ = std::move(offer);
  answered_.assign(offer_.chunks.size(), false);
  ticks_to_wait_ = 0;
  ticks_to_live_ = ticks;
}

void ChunkOffer::forget() {
  offer_ = {};  // with its memory
  answered_ = {};
}

bool ChunkOffer::ready() {
  if (ticks_to_live_ > 0 && --ticks_to_live_ == 0) forget();
  if (ticks_to_wait_ == 0) return true;
  --ticks_to_wait_;
  return false;
}

bool ChunkOffer::answers(ChunkCoord chunk, uint64_t hash) {
  const auto found = std::ranges::lower_bound(offer_.chunks, chunk);
  if (found == offer_.chunks.end() || *found != chunk) return false;
  const auto index = static_cast<size_t>(found - offer_.chunks.begin());
  if (answered_[index]) return false;
  answered_[index] = true;
  return offer_.hashes[index] == short_hash(hash);
}

}  // namespace scree
