#include "server/publish/tile_stream.h"

#include <algorithm>

#include "proto/limits.h"
#include "server/publish/limits.h"
#include "shared/base/check.h"

namespace scree {

bool TileStream::ask(uint64_t session, uint64_t party, const AskTilesMessage& request, ClientView& view) {
  if (heights_ == nullptr) return true;
  for (const TileKey key : request.held)
    if (heights_->has(key)) view.hold_tile(key);
  if (waiting(session) + request.wanted.size() > limits::tiles_wanted_max) return false;
  for (const TileKey key : request.wanted) {
    if (!heights_->has(key) || view.holds_tile(key)) continue;
    queues_[session].tiles.push_back(key);
    turns_.wait(session, party);
  }
  return true;
}

void TileStream::leave(uint64_t session) {
  queues_.erase(session);
  turns_.leave(session);
}

size_t TileStream::waiting(uint64_t session) const {
  const auto queue = queues_.find(session);
  return queue == queues_.end() ? 0 : queue->second.tiles.size();
}

SharedBytes TileStream::next_tile(Queue& queue) const {
  while (!queue.tiles.empty()) {
    const TileKey key = queue.tiles.front();
    queue.tiles.pop_front();
    if (queue.view->holds_tile(key)) continue;  // asked for twice
    std::vector<uint8_t> packed = heights_->packed(key);
    CHECK(!packed.empty());  // a server's model is complete
    queue.view->hold_tile(key);
    return share(TileMessage{key, std::move(packed)});
  }
  return nullptr;
}

void TileStream::serve(const std::function<ClientView*(uint64_t)>& reader,
                       const std::function<bool(uint64_t, const SharedBytes&)>& send) {
  for (auto& [session, queue] : queues_) {
    queue.credit_bytes =
        std::min(queue.credit_bytes + limits::tile_bytes_per_tick, limits::tile_bytes_per_tick);
    queue.view = reader(session);
  }
  turns_.begin();
  for (int64_t left = limits::tile_bytes_per_tick_all; left > 0 && !turns_.empty();) {
    const uint64_t session = turns_.next();
    Queue& queue = queues_.at(session);
    if (queue.view == nullptr || queue.credit_bytes <= 0) {
      turns_.pass_over();
      continue;
    }
    const SharedBytes bytes = next_tile(queue);
    const int64_t size = bytes ? size_of(bytes) : 0;
    left -= size;
    queue.credit_bytes -= size;
    const bool has_room = !bytes || send(session, bytes);
    turns_.charge(static_cast<uint64_t>(size), queue.tiles.empty() ? FairTurns::Then::leaves
                                               : has_room          ? FairTurns::Then::waits
                                                                   : FairTurns::Then::is_passed_over);
    if (queue.tiles.empty()) queues_.erase(session);
  }
  turns_.end();
}

}  // namespace scree
