#include "proto/restore_layout.h"

#include "proto/operation_codec.h"
#include "shared/operation/limits.h"

namespace scree {

void write_restore(ByteWriter& writer, const RestoreOperation& restore) {
  const std::vector<uint8_t> bricks =
      restore.bricks == nullptr ? std::vector<uint8_t>() : encode_bricks(*restore.bricks);
  writer.varint(bricks.size());
  for (const uint8_t byte : bricks) writer.u8(byte);
  writer.varint(restore.pieces.size());
  for (const PieceId piece : restore.pieces) writer.varint(piece);
}

RestoreOperation read_restore(ByteReader& reader) {
  RestoreOperation restore;
  const auto size =
      static_cast<size_t>(reader.varint("bytes of a restore's bricks", limits::client_message_bytes_max));
  auto bricks = decode_bricks(reader.read_bytes(size, "bricks of a restore"), limits::restored_bricks_max);
  if (!bricks) {
    reader.refuse(bricks.error().message);
    return restore;
  }
  if (!bricks->empty()) restore.bricks = std::make_shared<const std::vector<BrickPatch>>(std::move(*bricks));
  const uint64_t pieces = reader.varint("number of a restore's pieces", limits::restored_pieces_max);
  for (uint64_t i = 0; i < pieces && !reader.failed(); ++i)
    restore.pieces.push_back(static_cast<PieceId>(reader.varint("id of a piece", 0xFFFFFFFFU)));
  return restore;
}

}  // namespace scree
