#include "server/net/encode_cache.h"

#include "proto/codec.h"
#include "proto/motion_codec.h"
#include "proto/transforms.h"
#include "server/net/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

SharedBytes share(std::vector<uint8_t> bytes) {
  return std::make_shared<const std::vector<uint8_t>>(std::move(bytes));
}

/// For CHECK_DEBUG: clients accept the message. An oversized one is not sent.
bool decodes(const SharedBytes& bytes) {
  const auto body = std::span(*bytes).subspan(length_prefix_bytes);
  return body.size() > limits::message_bytes_max || decode_server(body).has_value();
}

/// Equal for equal selections, and hardly ever for others.
uint64_t key_of(const FrameSelection& selection) {
  uint64_t key = selection.check;
  const auto mix = [&key](uint64_t value) { key = (key ^ value) * 0x9E3779B97F4A7C15ULL; };
  for (const uint32_t operation : selection.operations) mix(operation);
  mix(selection.patched.size());
  mix(selection.dropped.size());
  for (const std::vector<PieceId>* ids : {&selection.removed, &selection.steps, &selection.wholes}) {
    mix(ids->size());
    for (const PieceId id : *ids) mix(id);
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
      message.patches.push_back({state->coord, *state->brick, state->paint});
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
}

const EncodeCache::Frame& EncodeCache::frame(FrameSelection selection, const TickChanges& changes) {
  const uint64_t key = key_of(selection);
  const auto [first, last] = frames_.equal_range(key);
  for (auto it = first; it != last; ++it)
    if (it->second->selection == selection) return *it->second;
  const FrameMessage message = frame_of(selection, changes);
  Frame& frame = *frames_.emplace(key, std::make_unique<Frame>())->second;
  frame.selection = std::move(selection);
  frame.transform_bytes = message.transforms.size() + message.motions.size();
  frame.bytes = share(encode(ServerMessage(message)));
  CHECK_DEBUG(decodes(frame.bytes));
  return frame;
}

SharedBytes EncodeCache::chunk(ChunkCoord coord, const PublishedChunk& chunk) {
  if (chunks_.size() >= limits::encoded_chunks_max && !chunks_.contains(coord)) chunks_.clear();
  EncodedChunk& encoded = chunks_[coord];
  if (encoded.bytes && encoded.version == chunk.version && encoded.hash == chunk.hash) return encoded.bytes;
  ChunkMessage message;
  message.chunk = coord;
  message.version = chunk.version;
  message.hash = chunk.hash;
  message.bricks.reserve(chunk.bricks.size());
  for (const auto& [brick, state] : chunk.bricks)
    message.bricks.push_back({brick, *state.brick, state.paint});
  encoded = {chunk.version, chunk.hash, share(encode(ServerMessage(std::move(message))))};
  CHECK(chunks_.size() <= limits::encoded_chunks_max);
  CHECK_DEBUG(decodes(encoded.bytes));
  return encoded.bytes;
}

SharedBytes EncodeCache::piece(PieceId id, const PublishedPiece& piece) {
  SharedBytes& bytes = pieces_[id];
  if (!bytes) bytes = share(encode(ServerMessage(PieceMessage{id, *piece.volume, piece.pose})));
  CHECK_DEBUG(decodes(bytes));
  return bytes;
}

}  // namespace scree
