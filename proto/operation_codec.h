// Operations, bricks and volumes as packed bytes, in messages and in recordings.
// proto/scree.proto specifies the layouts (Frame.changes, Frame.patches, Piece.volume).
//
// Decoders check everything, and refuse remaining bytes. Pure functions, safe to call from any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "proto/limits.h"
#include "proto/messages.h"
#include "shared/base/result.h"
#include "shared/operation/operation.h"

namespace scree {

/// Appends one operation; a sequence of them is their bytes in order.
void append_operation(std::vector<uint8_t>& bytes, const Operation& operation);

std::vector<uint8_t> encode_operation(const Operation& operation);
std::vector<uint8_t> encode_operations(std::span<const Operation> operations);
/// Decodes exactly one operation.
Result<Operation> decode_operation(std::span<const uint8_t> bytes);
/// Decodes at most limits::operations_per_frame_max operations.
Result<std::vector<Operation>> decode_operations(std::span<const uint8_t> bytes);

/// Size of the encoded operation within a frame, bytes.
size_t operation_bytes(const Operation& operation);

/// A brick by reference.
struct BrickView {
  BrickCoord coord;
  const Brick* brick = nullptr;
  BrickMaterials materials{};
};

/// Coordinates, then all codes compressed as one. Any number of bricks; none gives no bytes.
std::vector<uint8_t> encode_bricks(std::span<const BrickView> bricks);
std::vector<uint8_t> encode_bricks(std::span<const BrickPatch> bricks);
/// Refuses more than `count_max` bricks, and a brick that comes twice.
Result<std::vector<BrickPatch>> decode_bricks(std::span<const uint8_t> bytes,
                                              size_t count_max = limits::bricks_per_message_max);

std::vector<uint8_t> encode_volume(const Volume& volume);
Result<Volume> decode_volume(std::span<const uint8_t> bytes);
/// The box of a volume, whose other bytes are not looked at.
Result<VoxelBox> decode_volume_box(std::span<const uint8_t> bytes);

}  // namespace scree
