#include "server/publish/tile_stream.h"

#include <algorithm>

#include "proto/limits.h"
#include "server/publish/limits.h"
#include "shared/base/check.h"

namespace scree {

bool TileStream::ask(uint64_t session, const AskTilesMessage& request, ClientView& view) {
  if (heights_ == nullptr) return true;
  for (const TileKey key : request.held)
    if (heights_->has(key)) view.hold_tile(key);
  if (waiting(session) + request.wanted.size() > limits::tiles_wanted_max) return false;
  for (const TileKey key : request.wanted)
    if (heights_->has(key) && !view.holds_tile(key)) queues_[session].tiles.push_back(key);
  return true;
}

size_t TileStream::waiting(uint64_t session) const {
  const auto queue = queues_.find(session);
  return queue == queues_.end() ? 0 : queue->second.tiles.size();
}

void TileStream::serve(const std::function<ClientView*(uint64_t)>& reader,
                       const std::function<bool(uint64_t, const SharedBytes&)>& send) {
  for (auto& [session, queue] : queues_) {
    queue.credit_bytes =
        std::min(queue.credit_bytes + limits::tile_bytes_per_tick, limits::tile_bytes_per_tick);
    ClientView* const view = reader(session);
    while (view != nullptr && !queue.tiles.empty() && queue.credit_bytes > 0) {
      const TileKey key = queue.tiles.front();
      queue.tiles.pop_front();
      if (view->holds_tile(key)) continue;  // asked for twice
      std::vector<uint8_t> packed = heights_->packed(key);
      CHECK(!packed.empty());  // a server's model is complete
      const SharedBytes bytes = share(TileMessage{key, std::move(packed)});
      queue.credit_bytes -= size_of(bytes);
      view->hold_tile(key);
      if (!send(session, bytes)) break;
    }
  }
  std::erase_if(queues_, [](const auto& entry) { return entry.second.tiles.empty(); });
}

}  // namespace scree
