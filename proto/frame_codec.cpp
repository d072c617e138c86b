#include "proto/frame_codec.h"

#include "proto/byte_stream.h"
#include "proto/codec.h"
#include "proto/operation_codec.h"
#include "proto/transforms.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

std::string pack_ids(const std::vector<PieceId>& ids) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  PieceId before = 0;
  for (const PieceId id : ids) {
    writer.zigzag(int64_t{id} - before);
    before = id;
  }
  return to_string(bytes);
}

std::vector<PieceId> unpack_ids(const std::string& packed, FieldChecker& check) {
  std::vector<PieceId> ids;
  ByteReader reader(as_span(packed), "removed pieces");
  int64_t id = 0;
  while (!reader.at_end()) {
    if (ids.size() == limits::entries_per_frame_max) reader.refuse("too many");
    id += reader.zigzag("piece id", 0xFFFFFFFFLL);
    if (id < 0 || id > 0xFFFFFFFFLL) reader.refuse("a piece id is beyond 32 bits");
    ids.push_back(static_cast<PieceId>(id));
  }
  if (reader.failed()) check.refuse(reader.error().message);
  return ids;
}

std::vector<uint8_t> pack_changes(const FrameMessage& frame) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  writer.varint((frame.tick << 1U) | (frame.has_check ? 1U : 0U));
  if (frame.has_check) writer.u32(frame.check);
  for (const Operation& operation : frame.operations) append_operation(bytes, operation);
  return bytes;
}

void unpack_changes(const std::string& packed, FrameMessage& frame, FieldChecker& check) {
  ByteReader reader(as_span(packed), "changes of a frame");
  const uint64_t head = reader.varint("tick");
  frame.tick = head >> 1U;
  frame.has_check = (head & 1U) != 0;
  if (frame.has_check) frame.check = reader.u32("check");
  const std::span<const uint8_t> operations = reader.rest();
  if (reader.failed()) return check.refuse(reader.error().message);
  frame.operations = check.value_or_refuse(decode_operations(operations));
}

}  // namespace

void write(wire::Frame& to, const FrameMessage& from) {
  to.set_changes(to_string(pack_changes(from)));
  to.set_patches(to_string(encode_bricks(from.patches)));
  to.set_dropped_chunks(pack_chunks(from.dropped_chunks));
  to.set_removed_pieces(pack_ids(from.removed_pieces));
  to.set_transforms(to_string(from.transforms));
  to.set_motions(to_string(from.motions));
}

FrameMessage read(const wire::Frame& from, FieldChecker& check) {
  FrameMessage frame;
  unpack_changes(from.changes(), frame, check);
  frame.patches = check.value_or_refuse(decode_bricks(as_span(from.patches())));
  frame.dropped_chunks = check.chunks(from.dropped_chunks(), limits::entries_per_frame_max, "dropped chunks");
  frame.removed_pieces = unpack_ids(from.removed_pieces(), check);
  frame.transforms.assign(from.transforms().begin(), from.transforms().end());
  check.value_or_refuse(unpack_transforms(frame.transforms));
  frame.motions.assign(from.motions().begin(), from.motions().end());
  return frame;
}

}  // namespace scree
