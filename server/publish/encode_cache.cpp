#include "server/publish/encode_cache.h"

#include <numeric>

#include "proto/codec.h"
#include "proto/motion_codec.h"
#include "proto/transforms.h"
#include "server/publish/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// For CHECK_DEBUG: clients accept the message. An oversized one is not sent.
bool decodes(const SharedBytes& bytes) {
  const auto body = std::span(*bytes).subspan(length_prefix_bytes);
  return body.size() > limits::message_bytes_max || decode_server(body).has_value();
}

/// Equal for equal selections, and seldom for others. Sums, which are quick: there are as many pieces to sum
/// up as to send, for every client, and a mistake costs a comparison.
uint64_t key_of(const FrameSelection& selection) {
  uint64_t key = selection.check;
  const auto mix = [&key](uint64_t value) { key = (key ^ value) * 0x9E3779B97F4A7C15ULL; };
  for (const uint32_t operation : selection.operations) mix(operation);
  mix(selection.patched.size());
  mix(selection.dropped.size());
  for (const std::vector<PieceId>* ids : {&selection.removed, &selection.steps, &selection.wholes}) {
    mix(ids->size());
    mix(std::accumulate(ids->begin(), ids->end(), uint64_t{0}));
    if (!ids->empty()) mix(uint64_t{ids->front()} << 32U | ids->back());
  }
  mix(selection.moved.size());
  return key;
}

std::vector<uint8_t> motions_of(const FrameSelection& selection, const Motions& motions) {
  std::vector<WholeMotion> wholes;
  std::vector<MotionStep> steps;
  wholes.reserve(selection.wholes.size());
  steps.reserve(selection.steps.size());
  auto piece = motions.all().begin();
  for (const PieceId id : selection.steps) {
    while (piece->id < id) ++piece;
    steps.push_back({id, &piece->before, piece->before_check, &piece->correction});
  }
  piece = motions.all().begin();
  for (const PieceId id : selection.wholes) {
    while (piece->id < id) ++piece;
    wholes.push_back({id, piece->motion});
  }
  return encode_motions(wholes, steps);
}

FrameMessage frame_of(const FrameSelection& selection, const TickChanges& changes) {
  FrameMessage message;
  message.tick = changes.delta.tick;
  for (const uint32_t index : selection.operations)
    message.operations.push_back(changes.delta.operations[index].operation);
  for (const ChunkCoord chunk : selection.patched)
    for (const BrickState* state : changes.bricks.at(chunk))
      message.patches.push_back({state->coord, *state->brick, state->materials});
  message.dropped_chunks = selection.dropped;
  message.removed_pieces = selection.removed;
  message.transforms = pack_transforms(selection.moved);
  message.motions = motions_of(selection, changes.motions);
  message.has_check = selection.has_check;
  message.check = selection.check;
  return message;
}

}  // namespace

void EncodeCache::start_tick() {
  frames_.clear();
  pieces_.clear();
  if (chunk_bytes_ <= limits::encoded_chunk_bytes_max) return;
  chunks_.clear();
  chunk_bytes_ = 0;
}

void EncodeCache::forget(ChunkCoord chunk) {
  const auto known = chunks_.find(chunk);
  if (known == chunks_.end()) return;
  chunk_bytes_ -= known->second.encoded->size();
  chunks_.erase(known);
}

/// Selections are long: those that others have made are compared without the lock.
EncodeCache::EncodedFrame& EncodeCache::entry_of(FrameSelection selection) {
  const uint64_t key = key_of(selection);
  size_t compared = 0;
  std::vector<EncodedFrame*> others;
  while (true) {
    {
      const std::scoped_lock lock(mutex_);
      const auto [first, last] = frames_.equal_range(key);
      others.clear();
      for (auto it = first; it != last; ++it) others.push_back(it->second.get());
      if (others.size() == compared) {
        EncodedFrame& made = *frames_.emplace(key, std::make_unique<EncodedFrame>())->second;
        made.frame.selection = std::move(selection);
        return made;
      }
    }
    for (EncodedFrame* other : others)
      if (other->frame.selection == selection) return *other;
    compared = others.size();
  }
}

const EncodeCache::Frame& EncodeCache::frame(FrameSelection selection, const TickChanges& changes) {
  EncodedFrame& entry = entry_of(std::move(selection));
  std::call_once(entry.once, [&] {
    const FrameMessage message = frame_of(entry.frame.selection, changes);
    entry.frame.transform_bytes = message.transforms.size() + message.motions.size();
    entry.frame.bytes = share(message);
    CHECK_DEBUG(decodes(entry.frame.bytes));
  });
  return entry.frame;
}

std::shared_ptr<EncodeCache::Encoded> EncodeCache::entry_of(ChunkCoord coord, const PublishedChunk& chunk) {
  const std::scoped_lock lock(mutex_);
  EncodedChunk& known = chunks_[coord];
  if (known.encoded && known.version == chunk.version && known.hash == chunk.hash) return known.encoded;
  if (known.encoded) chunk_bytes_ -= known.encoded->size();  // of a tick before: nobody encodes it now
  known = {chunk.version, chunk.hash, std::make_shared<Encoded>()};
  return known.encoded;
}

SharedBytes EncodeCache::chunk(ChunkCoord coord, const PublishedChunk& chunk) {
  const std::shared_ptr<Encoded> entry = entry_of(coord, chunk);
  std::call_once(entry->once, [&] {
    ChunkMessage message;
    message.chunk = coord;
    message.version = chunk.version;
    message.hash = chunk.hash;
    message.bricks.reserve(chunk.bricks.size());
    for (const auto& [brick, state] : chunk.bricks)
      message.bricks.push_back({brick, *state.brick, state.materials});
    entry->bytes = share(std::move(message));
    chunk_bytes_ += entry->size();
    CHECK_DEBUG(decodes(entry->bytes));
  });
  return entry->bytes;
}

template <typename Make>
SharedBytes EncodeCache::whole(PieceId id, const Make& make) {
  Encoded* entry = nullptr;
  {
    const std::scoped_lock lock(mutex_);
    entry = &pieces_[id];
  }
  std::call_once(entry->once, [&] {
    entry->bytes = share(make());
    CHECK_DEBUG(decodes(entry->bytes));
  });
  return entry->bytes;
}

SharedBytes EncodeCache::piece(PieceId id, const PublishedPiece& piece) {
  return whole(id, [&] { return PieceMessage{id, *piece.volume, piece.pose}; });
}

SharedBytes EncodeCache::prop(PieceId id, const PublishedProp& prop) {
  return whole(id, [&] { return PropMessage{id, *prop.prop, prop.pose}; });
}

SharedBytes EncodeCache::stone(const SettledStone& stone) {
  return whole(stone.id, [&] { return StoneMessage{{stone.id, *stone.volume, stone.pose}, stone.lies}; });
}

}  // namespace scree
